#pragma once
#include <string>
#include <vector>

namespace example {

/// How large a run is: `quick` is what the tests run, `full` the published resolution.
enum class Size { quick, normal, full };

/// What every example can be asked for on the command line.
struct Options {
  Size size = Size::normal;
  std::string output;  ///< folder for all files
  int resolution = 0;  ///< particles across the scene, of the examples that offer it; 0: those of `size`

  /// The resolution asked for alone, or those of the size.
  [[nodiscard]] std::vector<int> resolutions(std::vector<int> quick, std::vector<int> normal, std::vector<int> full) const {
    if (resolution > 0) return {resolution};
    return size == Size::quick ? quick : size == Size::normal ? normal : full;
  }
};

/// Reads --quick, --full, --threads N, --output DIR and --help, and sets the number of threads; `least_resolution` > 0: also
/// --resolution N, N at least that. Leaves the program with status 0 (help) or not 0 (anything that is not an option) after a message.
[[nodiscard]] Options options(int argc, char** argv, const std::string& name, const std::string& what, int least_resolution = 0);

}  // namespace example
