#pragma once
#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace test {

struct Element {
  std::string name, parent;
  std::map<std::string, std::string> attributes;
};

/// The elements of an XML text in order; throws std::runtime_error where the text is not well formed (of XML, what our writers use:
/// a declaration, elements, attributes in double quotes, the five entities).
class Xml {
 public:
  explicit Xml(std::string given) : text_(std::move(given)) {
    expect("<?xml version=\"1.0\"?>");
    while (skip_to_tag()) {
      if (text_.compare(at_, 2, "</") == 0) {
        at_ += 2;
        if (open_.empty() || word() != open_.back()) fail("an end tag that closes nothing");
        open_.pop_back();
        expect(">");
      } else {
        start_tag();
      }
    }
    if (!open_.empty() || elements.empty()) fail("an element that is not closed");
  }
  /// The elements of that name.
  [[nodiscard]] std::vector<Element> all(const std::string& name) const {
    std::vector<Element> result;
    for (const Element& element : elements)
      if (element.name == name) result.push_back(element);
    return result;
  }
  std::vector<Element> elements;

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("not well formed at byte " + std::to_string(at_) + ": " + what);
  }
  void expect(const std::string& wanted) {
    if (text_.compare(at_, wanted.size(), wanted) != 0) fail("expected " + wanted);
    at_ += wanted.size();
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool skip_to_tag() {
    skip_blanks();
    if (at_ < text_.size() && text_[at_] != '<') fail("text outside tags");
    if (at_ < text_.size() && open_.empty() && !elements.empty()) fail("a second root");
    return at_ < text_.size();
  }
  std::string word() {
    std::string result;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) result += text_[at_++];
    if (result.empty()) fail("expected a name");
    return result;
  }
  void start_tag() {
    expect("<");
    Element element{.name = word(), .parent = open_.empty() ? "" : open_.back(), .attributes = {}};
    for (skip_blanks(); text_.compare(at_, 1, ">") != 0 && text_.compare(at_, 2, "/>") != 0; skip_blanks()) {
      const std::string name = word();
      expect("=\"");
      if (!element.attributes.emplace(name, value()).second) fail("an attribute given twice");
    }
    elements.push_back(element);
    if (text_[at_] == '/') expect("/>");
    else {
      expect(">");
      open_.push_back(element.name);
    }
  }
  std::string value() {
    static const std::map<std::string, char> entities{{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
    std::string result;
    for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '<' || static_cast<unsigned char>(text_[at_]) < 0x20) fail("a character that must not be there");
      if (text_[at_] != '&') {
        result += text_[at_];
        continue;
      }
      const std::size_t end = text_.find(';', at_);
      const auto entity = end == std::string::npos ? entities.end() : entities.find(text_.substr(at_ + 1, end - at_ - 1));
      if (entity == entities.end()) fail("an unknown entity");
      result += entity->second;
      at_ = end;
    }
    expect("\"");
    return result;
  }

  std::string text_;
  std::size_t at_ = 0;
  std::vector<std::string> open_;
};

}  // namespace test
