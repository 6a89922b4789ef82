#include "mjcf/xml.h"

#include <cassert>
#include <stdexcept>

namespace rotorub {

std::string xml_escape(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size() + text.size() / 8);
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\n':
        escaped += "&#10;";
        break;
      case '\t':
        escaped += "&#9;";
        break;
      case '\r':
        escaped += "&#13;";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20) {
          throw std::invalid_argument("control character " + std::to_string(static_cast<int>(c)) +
                                      " cannot be written in XML");
        }
        escaped += c;
    }
  }
  return escaped;
}

void XmlWriter::line(std::string_view text) {
  text_.append(2 * static_cast<std::size_t>(depth_), ' ');
  text_ += text;
  text_ += '\n';
}

void XmlWriter::open(std::string_view element) {
  line(element);
  ++depth_;
}

void XmlWriter::close(std::string_view name) {
  assert(depth_ > 0);
  --depth_;
  line("</" + std::string(name) + ">");
}

}  // namespace rotorub
