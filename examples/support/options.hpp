#pragma once
#include <string>
#include <vector>

namespace example {

/// How large a run is: `quick` is what the tests run, `full` the published resolution.
enum class Size { quick, normal, full };

/// What every example can be asked for on the command line.
struct Options {
  Size size = Size::normal;
  std::string output;    ///< folder for all files
  int resolution = 0;    ///< particles across the scene, of the examples that offer it; 0: those of `size`
  double support = 0.0;  ///< support radius over spacing, of the examples that offer it; 0: the example's own
  double safety = 0.0;   ///< fraction of the bounds of the time step, of the examples that offer it; 0: the example's own step
  bool true_contact = false;  ///< plates that nothing gets behind, of the examples that offer it

  /// The resolution asked for alone, or those of the size.
  [[nodiscard]] std::vector<int> resolutions(std::vector<int> quick, std::vector<int> normal, std::vector<int> full) const {
    if (resolution > 0) return {resolution};
    return size == Size::quick ? quick : size == Size::normal ? normal : full;
  }
};

/// What an example offers beside what all of them do.
struct Offered {
  int least_resolution = 0;      ///< > 0: --resolution N, N at least that
  double largest_support = 0.0;  ///< > 0: --support RATIO, at most that
  bool safety = false;           ///< --safety FRACTION
  bool contact = false;          ///< --contact true|penalty
};

/// Reads --quick, --full, --threads N, --output DIR and --help, and sets the number of threads; also what is `offered`. Leaves
/// the program with status 0 (help) or not 0 (anything that is not an option) after a message.
[[nodiscard]] Options options(int argc, char** argv, const std::string& name, const std::string& what, const Offered& offered = {});

}  // namespace example
