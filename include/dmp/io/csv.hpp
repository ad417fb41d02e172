#pragma once
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/io/detail/file.hpp>

namespace dmp::io {

/// A column of a table, printed as "front [m]".
struct Column {
  std::string name;
  std::string unit;  ///< "-" for a plain number
};

/// A table of numbers that grows row by row: one line of column names, then comma-separated numbers in the shortest form that reads
/// back as the same double ("nan", "inf" where they are not finite). Each row reaches the file at once, so a run can be watched.
///   CsvTable table(results / "front.csv", {{"time", "s"}, {"front", "m"}});   table.row({0.1, 1.02});
class CsvTable {
 public:
  CsvTable(std::filesystem::path path, const std::vector<Column>& columns) : columns_(columns.size()), file_(std::move(path)) {
    if (columns.empty()) throw ParameterError("io::CsvTable: " + detail::quoted(file_.path()) + " must have at least one column");
    std::string line;
    for (const Column& column : columns) {
      if (column.name.empty() || column.unit.empty())
        throw ParameterError("io::CsvTable: each column of " + detail::quoted(file_.path()) + " must have a name and a unit, got '" +
                             column.name + " [" + column.unit + "]'");
      line += (line.empty() ? "" : ",") + escaped(column.name + " [" + column.unit + "]");
    }
    write(line);
  }

  void row(std::span<const double> values) {
    if (values.size() != columns_)
      throw ParameterError("io::CsvTable: a row of " + detail::quoted(file_.path()) + " must hold " + std::to_string(columns_) +
                           " values, got " + std::to_string(values.size()));
    std::string line;
    for (std::size_t i = 0; i < values.size(); ++i) line += (i == 0 ? "" : ",") + to_text(values[i]);
    write(line);
  }
  void row(std::initializer_list<double> values) { row(std::span<const double>(values.begin(), values.size())); }

 private:
  /// As RFC 4180 has it: quotes around a text with a comma, quote or line end; inner quotes doubled.
  static std::string escaped(std::string_view text) {
    if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
    std::string result = "\"";
    for (const char letter : text) result += letter == '"' ? std::string("\"\"") : std::string(1, letter);
    return result + "\"";
  }
  void write(const std::string& line) {
    file_.write(line + "\n");
    file_.flush();
  }

  std::size_t columns_;
  detail::OutputFile file_;
};

}  // namespace dmp::io
