#include <doctest/doctest.h>
#include <limits>
#include <string>
#include <vector>
#include <dmp/geometry/point_file.hpp>
#include "io/temporary_folder.hpp"

using dmp::Vector;
using dmp::geometry::read_points;

namespace {

/// Reads `text` from a file; errors have the file's path replaced by FILE.
template <int Dim>
std::string complaint_about_file(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "points.txt").string();
  test::write_bytes(path, text);
  std::string complaint = test::error_of<dmp::ParameterError>([&] { static_cast<void>(read_points<Dim>(path)); });
  if (const auto at = complaint.find(path); at != std::string::npos) complaint.replace(at, path.size(), "FILE");
  return complaint;
}

}  // namespace

TEST_CASE("point file: blanks, tabs and commas separate, '#' comments, line ends of any system, empty lines count for nothing") {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "points.txt").string();
  test::write_bytes(path,
                    "# two numbers\n1 2\n  3\t4 # comment\n5,6\r\n\n7 , 8\n  # only a comment\n+9\t-1e-3   \n"
                    "0.1,1e300\n4.9e-324 -0\n\t\n.5 5.");
  const auto points = read_points<2>(path);
  const double smallest = std::numeric_limits<double>::denorm_min();
  const std::vector<Vector<2>> expected{{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, -1e-3}, {0.1, 1e300}, {smallest, 0}, {0.5, 5}};
  CHECK(points.positions == expected);
  CHECK(points.spacing == 0.0);
  CHECK(points.volume == 0.0);
}

TEST_CASE("point file: one and three columns") {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "points.txt").string();
  test::write_bytes(path, "1\n2\n");
  CHECK(read_points<1>(path).positions.size() == 2);
  test::write_bytes(path, "1 2 3\n");
  CHECK(read_points<3>(path).positions[0] == Vector<3>{1, 2, 3});
}

TEST_CASE("point file: whatever is not Dim finite numbers is refused with file, line number and line") {
  const std::string start = "geometry::read_points: 'FILE', line ";
  CHECK(complaint_about_file<2>("1 2\n1 2 3\n") == start + "2: must hold 2 numbers, not 3, got '1 2 3'");
  CHECK(complaint_about_file<3>("# head\n\n1 2\n") == start + "3: must hold 3 numbers, not 2, got '1 2'");
  CHECK(complaint_about_file<2>("1 x2\n") == start + "1: 'x2' is not a number, got '1 x2'");
  CHECK(complaint_about_file<2>("1 2x # note\r\n") == start + "1: '2x' is not a number, got '1 2x # note'");
  CHECK(complaint_about_file<2>("1 +-2\n") == start + "1: '+-2' is not a number, got '1 +-2'");
  CHECK(complaint_about_file<2>("1 +\n") == start + "1: '+' is not a number, got '1 +'");
  CHECK(complaint_about_file<2>("1;2\n") == start + "1: '1;2' is not a number, got '1;2'");
  CHECK(complaint_about_file<2>("1 nan\n") == start + "1: 'nan' is not a finite double, got '1 nan'");
  CHECK(complaint_about_file<2>("-inf 1\n") == start + "1: '-inf' is not a finite double, got '-inf 1'");
  CHECK(complaint_about_file<2>("1 1e999\n") == start + "1: '1e999' is not a finite double, got '1 1e999'");
  for (const std::string text : {"1,,2", ",1 2", "1,2,", ","}) {
    CAPTURE(text);
    CHECK(complaint_about_file<2>(text + "\n") == start + "1: a number must stand before and after each comma, got '" + text + "'");
  }
  const std::string longest = "'" + std::string(120, '7') + "...'";
  CHECK(complaint_about_file<1>(std::string(200, '7') + "x") == start + "1: " + longest + " is not a number, got " + longest);
  CHECK(complaint_about_file<1>(std::string("\0PNG\a 7", 7)) == start + "1: '?PNG?' is not a number, got '?PNG? 7'");
}

TEST_CASE("point file: a file that is missing, empty or a folder is refused by name") {
  const test::TemporaryFolder folder;
  const auto complaint = [](const std::string& path) {
    return test::error_of<dmp::ParameterError>([&] { static_cast<void>(read_points<2>(path)); });
  };
  const std::string missing = (folder / "missing.txt").string();
  CHECK(complaint(missing) == "geometry::read_points: '" + missing + "': cannot open: No such file or directory");
  CHECK(complaint(folder.path().string()) == "geometry::read_points: '" + folder.path().string() + "': cannot read: Is a directory");
  CHECK(complaint_about_file<2>("# nothing\n\n") == "geometry::read_points: 'FILE': holds no point");
  CHECK(complaint_about_file<2>("") == "geometry::read_points: 'FILE': holds no point");
}
