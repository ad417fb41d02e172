// docs/stability.md: each bound that is not sharp says why, and each extreme has a test that exists.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>
#include <doctest/doctest.h>

#include "docs/pages.hpp"

namespace {

const std::filesystem::path page = docs::repository() / "docs/stability.md";

/// The cells of each row below the line `head`, without the line of dashes.
std::vector<std::vector<std::string>> rows_below(const std::string& head) {
  std::vector<std::vector<std::string>> rows;
  bool inside = false;
  for (const auto& line : docs::lines_of(page)) {
    if (inside && !line.starts_with("|")) inside = false;
    if (inside && !line.starts_with("|---")) {
      std::vector<std::string> cells;
      std::size_t at = 1;
      for (std::size_t end = line.find('|', at); end != std::string::npos; at = end + 1, end = line.find('|', at))
        cells.push_back(line.substr(at, end - at));
      rows.push_back(cells);
    }
    if (line == head) inside = true;
  }
  return rows;
}

}  // namespace

TEST_CASE("stability.md: a bound from which the blow-up is farther than 1.5 times says why; none lies below its bound") {
  const auto rows =
      rows_below("| law | scene | bound [s] | whose | blow-up [s] | blow-up / bound | stopped by an error at | why not sharp |");
  CHECK(rows.size() > 30);
  for (const auto& row : rows) {
    REQUIRE(row.size() == 8);
    CAPTURE(row[0]);
    CAPTURE(row[1]);
    const double ratio = std::stod(row[5]);
    CHECK(ratio > 0.99);
    CHECK(ratio == doctest::Approx(std::stod(row[4]) / std::stod(row[2])).epsilon(0.01));
    CHECK((ratio > 1.5) == (row[7].find_first_not_of(' ') != std::string::npos));
  }
}

TEST_CASE("stability.md: every extreme names a test or an example that is there") {
  const auto rows = rows_below("| extreme | what is asked | what dmp does | test |");
  CHECK(rows.size() > 15);
  for (const auto& row : rows) {
    REQUIRE(row.size() == 4);
    CAPTURE(row[0]);
    int files = 0;
    for (std::size_t at = row[3].find("](../"); at != std::string::npos; at = row[3].find("](../", at + 1), ++files) {
      const std::string path = row[3].substr(at + 5, row[3].find(')', at) - at - 5);
      CHECK_MESSAGE(std::filesystem::exists(docs::repository() / path), path);
    }
    CHECK((files > 0 || row[3].find("the tests of each law") != std::string::npos));
  }
}
