// What the pages of docs/ show is what is compiled: code from the tests of this folder, quotations from the files they name, links to
// files that exist.
#include <map>
#include <set>
#include <string>
#include <doctest/doctest.h>

#include "docs/pages.hpp"

namespace {

/// All code that the tests of this folder hold for the pages.
std::map<std::string, std::string> compiled_code() {
  std::map<std::string, std::string> all;
  for (const auto& test : docs::files(docs::repository() / "tests/docs", "_test.cpp"))
    for (const auto& region : docs::regions_of(test)) {
      INFO("two tests hold a region called ", region.first);
      CHECK(all.insert(region).second);
    }
  return all;
}

/// A text without white space, and without the quotes between the parts of a long message.
std::string words_of(const std::string& text) {
  std::string words;
  for (const char letter : text)
    if (std::string(" \n\t").find(letter) == std::string::npos) words += letter;
  for (std::size_t at = words.find("\"\""); at != std::string::npos; at = words.find("\"\"", at)) words.erase(at, 2);
  return words;
}

}  // namespace

TEST_CASE("every C++ block of the pages is compiled by a test, and shown as it is compiled") {
  const auto code = compiled_code();
  std::set<std::string> shown;
  CHECK(code.size() > 20);
  for (const auto& page : docs::files(docs::repository() / "docs", ".md"))
    for (const auto& block : docs::blocks_of(page)) {
      CAPTURE(page.filename().string());
      CAPTURE(block.line);
      if (block.language == "cpp" && page.filename() != "architecture.md") {
        INFO("a C++ block needs <!-- code: name --> or <!-- text of: path --> above it");
        CHECK(block.code.empty() == !block.quoted_file.empty());
      }
      if (block.code.empty()) continue;
      CAPTURE(block.code);
      const auto found = code.find(block.code);
      CHECK(found != code.end());
      if (found != code.end()) CHECK(block.text == found->second);
      shown.insert(block.code);
    }
  for (const auto& region : code) {
    INFO("no page shows the region ", region.first);
    CHECK(shown.count(region.first) == 1);
  }
}

TEST_CASE("what the pages quote stands in the file that they name") {
  for (const auto& page : docs::files(docs::repository() / "docs", ".md"))
    for (const auto& block : docs::blocks_of(page)) {
      if (block.quoted_file.empty()) continue;
      CAPTURE(page.filename().string());
      CAPTURE(block.line);
      CHECK(words_of(docs::text_of(docs::repository() / block.quoted_file)).find(words_of(block.text)) != std::string::npos);
    }
}

TEST_CASE("links of the pages lead to files of the repository") {
  int links = 0;
  for (const auto& page : docs::files(docs::repository() / "docs", ".md")) {
    std::string text = docs::text_of(page);
    for (const auto& block : docs::blocks_of(page)) text.erase(text.find(block.text), block.text.size());  // code has no links
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 2)) {
      const std::string target = text.substr(at + 2, text.find_first_of(")#\n", at + 2) - at - 2);
      if (target.empty() || target.find("://") != std::string::npos || target.find(' ') != std::string::npos) continue;
      CAPTURE(page.filename().string());
      CAPTURE(target);
      CHECK(std::filesystem::exists(page.parent_path() / target));
      ++links;
    }
  }
  CHECK(links > 30);
}

TEST_CASE("the reader of pages notices what it must: blocks, margins, lines that are only shown") {
  const auto regions = docs::regions_of(docs::repository() / "tests/docs/bond_law_test.cpp");
  CHECK(regions.at("bond-header").starts_with("#pragma once\n#include <dmp/core/math.hpp>\n"));
  CHECK(regions.at("bond-test").starts_with("#include \"bond/laws.hpp\"\n"));
  const auto blocks = docs::blocks_of(docs::repository() / "docs/write-a-law.md");
  CHECK(blocks.size() > 5);
  CHECK(docs::between("<!-- code: x -->", "<!-- code: ", " -->") == "x");
  CHECK(docs::between("<!-- code: x", "<!-- code: ", " -->").empty());
  CHECK(words_of("a long \"\n      \"message") == "alongmessage");
}
