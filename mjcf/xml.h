// Text that XML takes: attributes and indented elements.
#pragma once

#include <string>
#include <string_view>

namespace rotorub {

// For an attribute in double quotes: & < > " and the white space that a parser would normalise
// (line break &#10;, tab &#9;, carriage return &#13;). Other control characters cannot stand in
// XML 1.0: throws std::invalid_argument.
std::string xml_escape(std::string_view text);

// Collects lines, two blanks of indentation for each open element.
class XmlWriter {
 public:
  void line(std::string_view text);     // one whole element, or a comment
  void open(std::string_view element);  // "<body name=...>", indents what follows
  void close(std::string_view name);    // "</name>"
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  int depth_ = 0;
};

}  // namespace rotorub
