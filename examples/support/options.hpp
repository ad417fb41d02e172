#pragma once
#include <string>

namespace example {

/// How large a run is: `quick` is what the tests run, `full` the published resolution.
enum class Size { quick, normal, full };

/// What every example can be asked for on the command line.
struct Options {
  Size size = Size::normal;
  std::string output;  ///< folder for all files
};

/// Reads --quick, --full, --threads N, --output DIR and --help, and sets the number of threads. Leaves the program with status 0 (help)
/// or not 0 (anything that is not an option) after a message.
[[nodiscard]] Options options(int argc, char** argv, const std::string& name, const std::string& what);

}  // namespace example
