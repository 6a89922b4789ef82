#include "mjcf/xml.h"

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace rotorub {
namespace {

bool is_finite_word(std::string_view word) {
  if (word.starts_with('-')) word.remove_prefix(1);
  return word != "inf" && word != "nan";
}

// These attributes may contain any words; all others are numbers.
bool is_text(std::string_view attribute) {
  return attribute == "name" || attribute == "data" || attribute == "model";
}

void refuse_not_finite(std::string_view element) {
  for (std::size_t at = element.find("=\""); at != std::string_view::npos;
       at = element.find("=\"", at)) {
    const std::size_t begin = element.find_last_of(" <", at) + 1, end = element.find('"', at + 2);
    const std::string_view name = element.substr(begin, at - begin);
    std::string_view rest = element.substr(at + 2, end - at - 2);
    at = end;
    while (!is_text(name) && !rest.empty()) {
      const std::string_view word = rest.substr(0, rest.find(' '));
      if (!is_finite_word(word)) {
        throw NotFinite(std::string(name) + "=\"" + std::string(word) + "\" in " +
                        std::string(element.substr(0, element.find(' '))) + ">");
      }
      rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    }
    if (end == std::string_view::npos) return;
  }
}

}  // namespace

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
  refuse_not_finite(text);
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
