#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <dmp/core/require.hpp>
#include <dmp/io/detail/file.hpp>
#include <dmp/io/output_folder.hpp>

namespace dmp::io {

namespace detail {
/// One word for the shell, whatever is in it.
[[nodiscard]] inline std::string shell_word(std::string_view text) {
  std::string result = "'";
  for (const char letter : text) result += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return result + "'";
}
}  // namespace detail

/// Writes the gnuplot script <name>.gp into the folder and, if gnuplot is installed, draws <name>.png there; returns whether that
/// picture was made. gnuplot runs in the folder: name data files without their path. By hand: cd <folder> && gnuplot <name>.gp
///   plot(results, "front", "set datafile separator ','\nplot 'front.csv' using 1:2 with lines");
inline bool plot(const OutputFolder& folder, const std::string& name, std::string_view gnuplot_commands) {
  constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  if (name.empty() || name.find_first_not_of(allowed) != std::string::npos || name[0] == '-' || name[0] == '.')
    throw ParameterError("io::plot: a name must consist of letters, digits, '_', '-' and '.', and begin with none of the last two, got '" +
                         name + "'");
  const std::string script = name + ".gp", picture = name + ".png";
  detail::WholeFile file(folder / script);
  file.write("# Draws " + picture + ". Run in this folder: gnuplot " + script + "\n");
  file.write("set terminal pngcairo size 1200,800\nset output '" + picture + "'\n");
  file.write(gnuplot_commands);
  file.write("\n");
  file.commit();

  std::error_code error;
  std::filesystem::remove(folder / picture, error);
  const std::string absolute_folder = std::filesystem::absolute(folder.path()).string();
  const std::string command =
      "cd " + detail::shell_word(absolute_folder) + " && command -v gnuplot >/dev/null 2>&1 && gnuplot " + script + " </dev/null";
  const bool succeeded = std::system(command.c_str()) == 0;
  return succeeded && std::filesystem::file_size(folder / picture, error) > 0 && !error;
}

}  // namespace dmp::io
