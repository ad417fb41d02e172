#include <doctest/doctest.h>
#include <dmp/io/output_folder.hpp>
#include "io/temporary_folder.hpp"

using dmp::io::OutputFolder;

namespace {
std::string complaint_about_path(const std::filesystem::path& path) {
  return test::error_of<dmp::ParameterError>([&] { const OutputFolder folder(path); });
}
}  // namespace

TEST_CASE("output folder: is made with its parents, holds nothing at first, may exist already, and names files in it") {
  const test::TemporaryFolder temporary;
  const OutputFolder folder(temporary / "a/b c/d");
  CHECK(std::filesystem::is_directory(temporary / "a/b c/d"));
  CHECK(std::filesystem::is_empty(folder.path()));
  CHECK(folder / "front.csv" == temporary.path() / "a/b c/d/front.csv");
  test::write_bytes(folder / "front.csv", "kept");
  const OutputFolder again(temporary / "a/b c/d/");
  CHECK(test::read_bytes(again / "front.csv") == "kept");
}

TEST_CASE("output folder: one that cannot be made is refused with its path and the system's reason") {
  const test::TemporaryFolder temporary;
  const auto file = temporary / "file";
  test::write_bytes(file, "a regular file");
  CHECK(complaint_about_path(file / "below") == "io::OutputFolder: cannot create '" + (file / "below").string() + "': Not a directory");
  CHECK(complaint_about_path(file) == "io::OutputFolder: cannot create '" + file.string() + "': Not a directory");
  CHECK(complaint_about_path("") == "io::OutputFolder: the path must not be empty");
  CHECK(test::read_bytes(file) == "a regular file");
}

TEST_CASE("output folder: one that cannot be written into is refused (of file systems that refuse even root: /proc)") {
  if (!std::filesystem::is_directory("/proc/self/fd")) return;
  const std::string complaint = complaint_about_path("/proc/self/fd");
  CHECK(test::contains(complaint, "io::OutputFolder: cannot write into '/proc/self/fd': "));
}
