#include "compare/report/template.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

namespace rotorub {
namespace {

using nlohmann::json;
using Context = std::vector<const json*>;  // innermost last

struct Tag {
  char kind = ' ';  // # ^ / > { or a space for a plain value
  std::string_view name;
  std::size_t begin = 0;  // of the braces
  std::size_t end = 0;    // after them
};

[[noreturn]] void fail(const std::string& what, std::string_view name) {
  throw std::logic_error("template: " + what + " {{" + std::string(name) + "}}");
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// The next tag at or after `from`; begin is npos where there is none.
Tag next_tag(std::string_view text, std::size_t from) {
  Tag tag;
  tag.begin = text.find("{{", from);
  if (tag.begin == std::string_view::npos) return tag;
  const bool raw = text.substr(tag.begin, 3) == "{{{";
  const std::string_view close = raw ? "}}}" : "}}";
  const std::size_t end = text.find(close, tag.begin);
  if (end == std::string_view::npos) fail("not closed:", text.substr(tag.begin, 30));
  std::string_view body = text.substr(tag.begin + close.size(), end - tag.begin - close.size());
  tag.end = end + close.size();
  if (raw) {
    tag.kind = '{';
  } else if (!body.empty() &&
             std::string_view("#^/>").find(body.front()) != std::string_view::npos) {
    tag.kind = body.front();
    body.remove_prefix(1);
  }
  tag.name = trimmed(body);
  return tag;
}

// The tag that closes the section `open`.
Tag closing_tag(std::string_view text, const Tag& open) {
  int depth = 1;
  std::size_t at = open.end;
  while (true) {
    const Tag tag = next_tag(text, at);
    if (tag.begin == std::string_view::npos) fail("section not closed:", open.name);
    at = tag.end;
    if (tag.name != open.name) continue;
    if (tag.kind == '#' || tag.kind == '^') ++depth;
    if (tag.kind == '/' && --depth == 0) return tag;
  }
}

const json* member(const json& value, std::string_view name) {
  if (!value.is_object()) return nullptr;
  const auto found = value.find(std::string(name));
  return found == value.end() ? nullptr : &*found;
}

const json& look_up(const Context& context, std::string_view name) {
  if (name == ".") return *context.back();
  const std::size_t dot = name.find('.');
  const std::string_view head = name.substr(0, dot);
  for (auto level = context.rbegin(); level != context.rend(); ++level) {
    const json* value = member(**level, head);
    if (!value) continue;
    if (dot == std::string_view::npos) return *value;
    return look_up({value}, name.substr(dot + 1));
  }
  fail("no value for", name);
}

bool shows(const json& value) {
  if (value.is_null()) return false;
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return !value.get_ref<const std::string&>().empty();
  if (value.is_array()) return !value.empty();
  return true;
}

std::string text_of(const json& value, std::string_view name) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.dump();
  fail("neither text nor number:", name);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

class Filler {
 public:
  Filler(const json& values, const Partials& partials) : partials_(partials), context_{&values} {}

  void fill(std::string_view text, std::string& out);

 private:
  void fill_section(std::string_view body, const json& value, std::string& out);
  std::string_view partial(std::string_view name) const;

  const Partials& partials_;
  Context context_;
};

std::string_view Filler::partial(std::string_view name) const {
  const auto found = partials_.find(name);
  if (found == partials_.end()) fail("no partial", name);
  return found->second;
}

void Filler::fill_section(std::string_view body, const json& value, std::string& out) {
  if (!value.is_array()) {
    context_.push_back(&value);
    fill(body, out);
    context_.pop_back();
    return;
  }
  for (const json& element : value) {
    context_.push_back(&element);
    fill(body, out);
    context_.pop_back();
  }
}

void Filler::fill(std::string_view text, std::string& out) {
  std::size_t at = 0;
  while (true) {
    const Tag tag = next_tag(text, at);
    out += text.substr(at, std::min(tag.begin, text.size()) - at);
    if (tag.begin == std::string_view::npos) return;
    at = tag.end;
    if (tag.kind == '/') fail("section closed but not opened:", tag.name);
    if (tag.kind == '>') {
      fill(partial(tag.name), out);
      continue;
    }
    const json& value = look_up(context_, tag.name);
    if (tag.kind == '{') {
      out += text_of(value, tag.name);
    } else if (tag.kind == ' ') {
      out += escaped(text_of(value, tag.name));
    } else {
      const Tag close = closing_tag(text, tag);
      const std::string_view body = text.substr(tag.end, close.begin - tag.end);
      if (tag.kind == '#' && shows(value)) fill_section(body, value, out);
      if (tag.kind == '^' && !shows(value)) fill(body, out);
      at = close.end;
    }
  }
}

}  // namespace

std::string fill_template(std::string_view text, const json& values, const Partials& partials) {
  std::string out;
  out.reserve(2 * text.size());
  Filler(values, partials).fill(text, out);
  return out;
}

}  // namespace rotorub
