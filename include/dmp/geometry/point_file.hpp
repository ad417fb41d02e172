#pragma once
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/geometry/fill.hpp>

namespace dmp::geometry {

namespace detail {

/// A place in a point file, for error texts.
struct Line {
  std::string_view path, text;
  std::size_t number;

  [[noreturn]] void reject(const std::string& rule) const {
    throw ParameterError("geometry::read_points: '" + std::string(path) + "', line " + std::to_string(number) + ": " + rule + ", got " +
                         quoted(text));
  }
  /// As much as can be shown of something that is perhaps no text at all.
  [[nodiscard]] static std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 120;
    std::string result(text.substr(0, longest));
    for (char& letter : result)
      if (static_cast<unsigned char>(letter) < 0x20 && letter != '\t') letter = '?';
    return "'" + result + (text.size() > longest ? "...'" : "'");
  }
};

[[nodiscard]] inline double number_from(std::string_view word, const Line& line) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';  // from_chars knows no '+'
  const char* const begin = word.data() + (plus ? 1 : 0);
  const char* const end = word.data() + word.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  const bool number = error != std::errc::invalid_argument && stop == end;
  if (!number) line.reject(Line::quoted(word) + " is not a number");
  if (error != std::errc{} || !(value - value == 0.0)) line.reject(Line::quoted(word) + " is not a finite double");
  return value;
}

}  // namespace detail

/// Points from a text file: Dim numbers [m] per line, separated by blanks, tabs or one comma; '#' starts a comment; empty lines count
/// for nothing. Spacing and volume stay unknown (0): give the mass of the particles yourself. Whatever does not fit this is an error.
template <int Dim>
[[nodiscard]] Points<Dim> read_points(const std::string& path) {
  constexpr std::string_view blanks = " \t\r", ends = " \t\r,";
  const std::string where = "geometry::read_points: '" + path + "': ";
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw ParameterError(where + "cannot open: " + std::generic_category().message(errno));

  Points<Dim> points;
  std::string text;
  for (std::size_t number = 1; std::getline(file, text); ++number) {
    if (text.ends_with('\r')) text.pop_back();
    const detail::Line line{.path = path, .text = text, .number = number};
    std::string_view rest = std::string_view(text).substr(0, text.find('#'));
    const auto skip_blanks = [&] { rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size())); };

    Vector<Dim> position;
    int columns = 0;
    bool comma_before = false;
    for (skip_blanks(); !rest.empty() || comma_before; skip_blanks()) {
      const std::string_view word = rest.substr(0, rest.find_first_of(ends));
      if (word.empty()) line.reject("a number must stand before and after each comma");
      const double value = detail::number_from(word, line);
      if (columns < Dim) position[columns] = value;
      ++columns;
      rest.remove_prefix(word.size());
      skip_blanks();
      comma_before = rest.starts_with(',');
      if (comma_before) rest.remove_prefix(1);
    }
    if (columns == 0) continue;
    if (columns != Dim) line.reject("must hold " + std::to_string(Dim) + " numbers, not " + std::to_string(columns));
    points.positions.push_back(position);
  }
  if (file.bad()) throw ParameterError(where + "cannot read: " + std::generic_category().message(errno));
  if (points.positions.empty()) throw ParameterError(where + "holds no point");
  return points;
}

}  // namespace dmp::geometry
