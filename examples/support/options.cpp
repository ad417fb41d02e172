#include "support/options.hpp"

#include <cstdlib>
#include <CLI/CLI.hpp>
#include <dmp/core/threads.hpp>

namespace example {

Options options(int argc, char** argv, const std::string& name, const std::string& what, const Offered& offered) {
  CLI::App parser(what, name);
  Options result;
  result.output = "output/" + name;
  bool quick = false, full = false;
  int threads = dmp::available_threads();
  auto* const quick_flag = parser.add_flag("--quick", quick, "coarse run of a few seconds, as in the tests");
  parser.add_flag("--full", full, "published resolution; may take long")->excludes(quick_flag);
  parser.add_option("--threads", threads, "threads to use")->check(CLI::PositiveNumber)->capture_default_str();
  parser.add_option("--output", result.output, "folder for all output")->capture_default_str();
  if (offered.least_resolution > 0)
    parser.add_option("--resolution", result.resolution, "this resolution alone, instead of those of the size")
        ->check(CLI::Range(offered.least_resolution, 1000000))
        ->excludes(quick_flag);
  if (offered.largest_support > 0.0)
    parser.add_option("--support", result.support, "support radius over spacing, instead of the example's own")
        ->check(CLI::Range(1.5, offered.largest_support));
  if (offered.safety)
    parser.add_option("--safety", result.safety, "fraction of the bounds of the time step, instead of the example's own step")
        ->check(CLI::Range(0.01, 1.0));
  std::string contact = "penalty";
  if (offered.contact)
    parser.add_option("--contact", contact, "plates push back what is behind them (penalty), or nothing gets behind them (true)")
        ->check(CLI::IsMember({"penalty", "true"}))
        ->capture_default_str();
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    std::exit(parser.exit(stop));
  }
  dmp::use_threads(threads);
  if (quick) result.size = Size::quick;
  if (full) result.size = Size::full;
  result.true_contact = contact == "true";
  return result;
}

}  // namespace example
