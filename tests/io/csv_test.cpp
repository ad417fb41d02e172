#include <doctest/doctest.h>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>
#include <dmp/io/csv.hpp>
#include "io/temporary_folder.hpp"

using dmp::io::Column;
using dmp::io::CsvTable;

static_assert(std::is_move_constructible_v<CsvTable> && !std::is_copy_constructible_v<CsvTable>, "one file, one writer");

TEST_CASE("csv: every finite double comes back bit for bit, and so do infinities; NaN comes back as NaN") {
  const test::TemporaryFolder folder;
  std::mt19937_64 random(7);
  std::vector<double> written{0.0, -0.0, 0.1, 1.0 / 3.0, 5e-324, 2.2250738585072014e-308, std::numeric_limits<double>::max(),
                              std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), std::nan("")};
  while (written.size() < 2000) written.push_back(std::bit_cast<double>(random()));  // any bits at all
  {
    CsvTable table(folder / "table.csv", {{"first", "m"}, {"second", "-"}});
    for (std::size_t i = 0; i < written.size(); i += 2) table.row({written[i], written[i + 1]});
  }
  std::istringstream text(test::read_bytes(folder / "table.csv"));
  std::string line;
  std::getline(text, line);
  CHECK(line == "first [m],second [-]");
  std::size_t i = 0;
  for (; std::getline(text, line); i += 2) {
    const char* begin = line.c_str();
    char* end = nullptr;
    for (std::size_t column = 0; column < 2; ++column) {
      const double read = std::strtod(begin, &end);
      REQUIRE(*end == (column == 0 ? ',' : '\0'));
      begin = end + 1;
      const double expected = written[i + column];
      CHECK((std::isnan(expected) ? std::isnan(read) : std::bit_cast<std::uint64_t>(read) == std::bit_cast<std::uint64_t>(expected)));
    }
  }
  CHECK(i == written.size());
}

TEST_CASE("csv: each row is in the file as soon as it is written; a former table is replaced") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "table.csv", "a former, longer table\n1\n2\n3\n");
  CsvTable table(folder / "table.csv", {{"time", "s"}, {"front", "m"}});
  CHECK(test::read_bytes(folder / "table.csv") == "time [s],front [m]\n");
  table.row({0.1, 1.0});
  CHECK(test::read_bytes(folder / "table.csv") == "time [s],front [m]\n0.1,1\n");
  table.row(std::vector<double>{0.2, 1e-30});
  CHECK(test::read_bytes(folder / "table.csv") == "time [s],front [m]\n0.1,1\n0.2,1e-30\n");
}

TEST_CASE("csv: a column name with comma, quote or line end is quoted as RFC 4180 has it") {
  const test::TemporaryFolder folder;
  const CsvTable table(folder / "table.csv", {{"p, q", "m"}, {"the \"front\"", "m"}, {"plain", "kg m^2/s^3"}});
  CHECK(test::read_bytes(folder / "table.csv") == "\"p, q [m]\",\"the \"\"front\"\" [m]\",plain [kg m^2/s^3]\n");
}

TEST_CASE("csv: a row of the wrong length is refused and not written; so are tables without columns, columns without name or unit") {
  const test::TemporaryFolder folder;
  const auto path = folder / "table.csv";
  {
    CsvTable table(path, {{"time", "s"}, {"front", "m"}});
    const std::string start = "io::CsvTable: a row of '" + path.string() + "' must hold 2 values, got ";
    CHECK(test::error_of<dmp::ParameterError>([&] { table.row({1.0}); }) == start + "1");
    CHECK(test::error_of<dmp::ParameterError>([&] { table.row({}); }) == start + "0");
    CHECK(test::error_of<dmp::ParameterError>([&] { table.row({1.0, 2.0, 3.0}); }) == start + "3");
  }
  CHECK(test::read_bytes(path) == "time [s],front [m]\n");
  CHECK(test::error_of<dmp::ParameterError>([&] { const CsvTable table(path, {}); }) ==
        "io::CsvTable: '" + path.string() + "' must have at least one column");
  CHECK(test::error_of<dmp::ParameterError>([&] { const CsvTable table(path, {{"time", ""}}); }) ==
        "io::CsvTable: each column of '" + path.string() + "' must have a name and a unit, got 'time []'");
}

TEST_CASE("csv: a file that cannot be written, or a full disk, is an error that names the file and the reason") {
  const test::TemporaryFolder folder;
  const auto path = folder / "missing/table.csv";
  CHECK(test::error_of<std::runtime_error>([&] { const CsvTable table(path, {{"time", "s"}}); }) ==
        "io: cannot write '" + path.string() + "': No such file or directory");
  if (std::filesystem::exists("/dev/full"))
    CHECK(test::error_of<std::runtime_error>([&] { const CsvTable table("/dev/full", {{"time", "s"}}); }) ==
          "io: cannot write '/dev/full': No space left on device");
}
