#pragma once
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// The pages of docs/ and the code that the tests of this folder compile for them.
///   page     <!-- code: name -->      above a fenced block: it stands between `// doc: name` and `// end` in a test of this folder
///            <!-- text of: path -->   above a fenced block: its lines stand, side by side, in that file of the repository
///   test     // shown: text           a line of the page that this test cannot hold itself, such as an include of the page's own header
namespace docs {

[[nodiscard]] inline std::filesystem::path repository() {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
}

[[nodiscard]] inline std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}
[[nodiscard]] inline std::string text_of(const std::filesystem::path& path) {
  std::string text;
  for (const auto& line : lines_of(path)) text += line + "\n";
  return text;
}

/// The files of a folder whose names end so, in alphabetical order.
[[nodiscard]] inline std::vector<std::filesystem::path> files(const std::filesystem::path& folder, std::string_view ending) {
  std::vector<std::filesystem::path> result;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().string().ends_with(ending)) result.push_back(entry.path());
  std::sort(result.begin(), result.end());
  return result;
}

/// What stands between `before` and `after` in a line; empty if the line is not of that form.
[[nodiscard]] inline std::string between(std::string_view line, std::string_view before, std::string_view after) {
  if (!line.starts_with(before) || !line.ends_with(after) || line.size() < before.size() + after.size()) return {};
  return std::string(line.substr(before.size(), line.size() - before.size() - after.size()));
}

/// A fenced block of a page.
struct Block {
  std::string language, code, quoted_file, text;  ///< `code` or `quoted_file` from the comment above it; both empty without one
  std::size_t line;                               ///< of the fence
};

[[nodiscard]] inline std::vector<Block> blocks_of(const std::filesystem::path& page) {
  std::vector<Block> blocks;
  const auto lines = lines_of(page);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    if (!lines[n].starts_with("```")) continue;
    const std::string above = n > 0 ? lines[n - 1] : "";
    Block block{lines[n].substr(3), between(above, "<!-- code: ", " -->"), between(above, "<!-- text of: ", " -->"), "", n + 1};
    for (++n; n < lines.size() && lines[n] != "```"; ++n) block.text += lines[n] + "\n";
    blocks.push_back(block);
  }
  return blocks;
}

/// The code of a test by name, moved to the left margin.
[[nodiscard]] inline std::map<std::string, std::string> regions_of(const std::filesystem::path& test) {
  std::map<std::string, std::string> regions;
  std::string name;
  std::vector<std::string> code;
  for (std::string line : lines_of(test)) {
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    const std::string_view bare = std::string_view(line).substr(indent);
    if (name.empty()) {
      if (bare.starts_with("// doc: ")) name = bare.substr(8);
    } else if (bare == "// end") {
      std::size_t margin = 1000;
      for (const auto& each : code)
        if (!each.empty()) margin = std::min(margin, each.find_first_not_of(' '));
      std::string text;
      for (const auto& each : code) text += (each.empty() ? "" : each.substr(margin)) + "\n";
      if (!regions.emplace(name, text).second) throw std::runtime_error(test.string() + ": two regions are called " + name);
      name.clear();
      code.clear();
    } else {
      if (bare.starts_with("// shown: ")) line = line.substr(0, indent) + std::string(bare.substr(10));
      code.push_back(line);
    }
  }
  if (!name.empty()) throw std::runtime_error(test.string() + ": region " + name + " has no // end");
  return regions;
}

}  // namespace docs
