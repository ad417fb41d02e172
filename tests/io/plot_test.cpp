#include <doctest/doctest.h>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <dmp/io/plot.hpp>
#include "io/temporary_folder.hpp"

namespace {

/// PATH as given while it lives.
class Path {
 public:
  explicit Path(const std::string& value) : former_(std::getenv("PATH")) { ::setenv("PATH", value.c_str(), 1); }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;
  ~Path() { ::setenv("PATH", former_.c_str(), 1); }

 private:
  std::string former_;
};

bool has_gnuplot() { return std::system("command -v gnuplot >/dev/null 2>&1") == 0; }

}  // namespace

TEST_CASE("plot: the script stays in the folder, draws by relative names and can be run again by hand") {
  const test::TemporaryFolder temporary;
  const dmp::io::OutputFolder folder(temporary / "it's a folder; with $(odd) name");
  test::write_bytes(folder / "line.csv", "x,y\n0,0\n1,1\n");
  const bool drawn = dmp::io::plot(folder, "front_1", "set datafile separator ','\nplot 'line.csv' using 1:2 with lines");
  CHECK(drawn == has_gnuplot());
  CHECK(std::filesystem::exists(folder / "front_1.png") == drawn);
  const std::string script = test::read_bytes(folder / "front_1.gp");
  CHECK(test::contains(script, "set terminal pngcairo"));
  CHECK(test::contains(script, "set output 'front_1.png'\n"));
  CHECK(test::contains(script, "plot 'line.csv' using 1:2 with lines\n"));
  CHECK_FALSE(test::contains(script, temporary.path().string()));
  if (drawn) {
    CHECK(test::read_bytes(folder / "front_1.png").substr(1, 3) == "PNG");
    std::filesystem::remove(folder / "front_1.png");
    const auto here = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    CHECK(std::system("gnuplot front_1.gp") == 0);
    std::filesystem::current_path(here);
    CHECK(std::filesystem::exists(folder / "front_1.png"));
  }
}

TEST_CASE("plot: without gnuplot the script is written, there is no picture, and that is no error") {
  const test::TemporaryFolder temporary;
  const dmp::io::OutputFolder folder(temporary.path());
  const Path nothing_on_path(temporary.path().string());
  CHECK_FALSE(dmp::io::plot(folder, "front", "plot x"));
  CHECK(std::filesystem::exists(folder / "front.gp"));
  CHECK_FALSE(std::filesystem::exists(folder / "front.png"));
}

TEST_CASE("plot: a script that gnuplot refuses makes no picture, and none that an earlier run left passes for it") {
  const test::TemporaryFolder temporary;
  const dmp::io::OutputFolder folder(temporary.path());
  test::write_bytes(folder / "front.png", "of an earlier run");
  test::write_bytes(temporary / "gnuplot", "#!/bin/sh\nexit 1\n");
  std::filesystem::permissions(temporary / "gnuplot", std::filesystem::perms::owner_all);
  const Path refusing(temporary.path().string());
  CHECK_FALSE(dmp::io::plot(folder, "front", "plot nonsense("));
  CHECK_FALSE(std::filesystem::exists(folder / "front.png"));
}

TEST_CASE("plot: a name that is no plain file name is refused") {
  const test::TemporaryFolder temporary;
  const dmp::io::OutputFolder folder(temporary.path());
  for (const std::string name : {"", "a/b", "../a", "-a", "a b", "a'b", "a;b"}) {
    CAPTURE(name);
    CHECK(test::error_of<dmp::ParameterError>([&] { dmp::io::plot(folder, name, "plot x"); }) ==
          "io::plot: a name must consist of letters, digits, '_', '-' and '.', and begin with none of the last two, got '" + name + "'");
  }
  CHECK(std::filesystem::is_empty(folder.path()));
}
