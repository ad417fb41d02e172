// docs/laws.md lists every law of the library, once, with its type, formula and source.
#include <set>
#include <string>
#include <doctest/doctest.h>

#include "docs/pages.hpp"

namespace {

/// Folders of include/dmp that hold no laws. A folder that is not named here is a family of laws.
const std::set<std::string> no_laws{"app", "core", "coupling", "distributed", "geometry", "grid", "io", "lattice_spring", "measure",
                                    "neighbours", "particles", "simulation", "sweep"};

/// The laws of the library, as links from docs/.
std::set<std::string> law_links() {
  std::set<std::string> links;
  const auto include = docs::repository() / "include/dmp";
  for (const auto& folder : std::filesystem::directory_iterator(include)) {
    const std::string family = folder.path().filename().string();
    if (!folder.is_directory() || no_laws.count(family) == 1) continue;
    for (const auto& header : docs::files(folder.path(), ".hpp"))
      if (header.filename() != "concept.hpp") links.insert("../include/dmp/" + family + "/" + header.filename().string());
  }
  return links;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  for (std::size_t from = 1; from < row.size();) {
    const std::size_t to = row.find('|', from);
    if (to == std::string::npos) break;
    const std::string cell = row.substr(from, to - from);
    const std::size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
    from = to + 1;
  }
  return cells;
}

}  // namespace

TEST_CASE("docs/laws.md: every law has a row with family, type, formula and source") {
  const auto laws = law_links();
  CHECK(laws.size() > 25);
  std::multiset<std::string> listed;
  for (const auto& row : docs::lines_of(docs::repository() / "docs/laws.md")) {
    const std::size_t at = row.find("(../include/dmp/");
    if (!row.starts_with("|") || at == std::string::npos) continue;
    CAPTURE(row);
    const std::string link = row.substr(at + 1, row.find(')', at) - at - 1);
    listed.insert(link);
    const auto cells = cells_of(row);  // family, type, formula, source
    CHECK(cells.size() == 4);
    if (cells.size() != 4) continue;
    for (const auto& cell : cells) CHECK(!cell.empty());

    // The type of the row is declared in the header that the row links to, in the namespace of the family.
    const std::string type = docs::between(cells[1].substr(0, cells[1].find("](")), "[`", "`");
    const std::size_t colons = type.find("::");
    CHECK(colons != std::string::npos);
    CHECK(type.substr(0, colons) == cells[0]);
    if (!std::filesystem::exists(docs::repository() / "docs" / link)) continue;  // the list below says so
    const std::string header = docs::text_of(docs::repository() / "docs" / link);
    const std::string bare = type.substr(colons + 2, type.find('<') - colons - 2);
    CHECK((header.find("struct " + bare) != std::string::npos || header.find("using " + bare + " = ") != std::string::npos));
    CHECK(header.find("namespace dmp::" + cells[0]) != std::string::npos);
  }
  for (const auto& law : laws) {
    INFO("docs/laws.md lacks a row with the link ", law);
    CHECK(listed.count(law) >= 1);  // a header with two types has two rows
  }
  for (const auto& link : listed) {
    INFO("docs/laws.md links to what is no law header: ", link);
    CHECK(laws.count(link) == 1);
  }
}
