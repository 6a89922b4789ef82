// Text that XML takes: attributes and indented elements.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace rotorub {

// For an attribute in double quotes: & < > " and the white space that a parser would normalise
// (line break &#10;, tab &#9;, carriage return &#13;). Other control characters cannot stand in
// XML 1.0: throws std::invalid_argument.
std::string xml_escape(std::string_view text);

// A number of an element that is infinite or none.
class NotFinite : public std::range_error {
  using std::range_error::range_error;
};

// Collects lines, two blanks of indentation for each open element.
class XmlWriter {
 public:
  // One whole element, or a comment. Throws NotFinite for an attribute with such a number in it.
  void line(std::string_view text);
  void open(std::string_view element);  // "<body name=...>", indents what follows
  void close(std::string_view name);    // "</name>"
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  int depth_ = 0;
};

}  // namespace rotorub
