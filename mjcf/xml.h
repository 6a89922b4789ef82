// Writing of XML: escaped attributes and indented elements.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace rotorub {

// Escapes text for an attribute in double quotes: & < > " and the white space that a parser would
// normalise (line break &#10;, tab &#9;, carriage return &#13;). Throws std::invalid_argument for
// other control characters, which XML 1.0 does not allow.
std::string xml_escape(std::string_view text);

// Thrown for an attribute with an infinite number or NaN.
class NotFinite : public std::range_error {
  using std::range_error::range_error;
};

// Collects lines, indented by two spaces for each open element.
class XmlWriter {
 public:
  // Adds a whole element or a comment. Throws NotFinite if an attribute contains such a number.
  void line(std::string_view text);
  void open(std::string_view element);  // "<body name=...>", indents the following lines
  void close(std::string_view name);    // "</name>"
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  int depth_ = 0;
};

}  // namespace rotorub
