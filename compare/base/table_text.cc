#include "compare/base/table_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <boost/tokenizer.hpp>

namespace rotorub {
namespace {

Fields fields_of(std::string_view line, char separator) {
  using Separator = boost::escaped_list_separator<char>;
  const std::string text(line);
  const Separator parts("", std::string(1, separator), "\"");
  Fields fields;
  for (const std::string& field : boost::tokenizer<Separator>(text, parts)) {
    fields.push_back(boost::trim_copy(field));
  }
  return fields;
}

char separator_of(std::string_view header) {
  for (const char separator : {'\t', ';'}) {
    if (fields_of(header, separator).size() > 1) return separator;
  }
  return ',';
}

}  // namespace

TableText::TableText(std::string_view text, const std::function<bool(const Fields&)>& is_header)
    : rest_(text) {
  constexpr int kMostBefore = 200;  // lines before the header
  std::string_view line;
  while (is_header && next_line(line) && line_ <= kMostBefore) {
    separator_ = separator_of(line);
    header_ = fields_of(line, separator_);
    if (is_header(header_)) return;
  }
  rest_ = text;
  line_ = 0;
  header_.clear();
  if (!next_line(line)) return;
  separator_ = separator_of(line);
  header_ = fields_of(line, separator_);
}

bool TableText::next() {
  std::string_view line;
  if (!next_line(line)) return false;
  row_ = fields_of(line, separator_);
  // Some programs end each row with a separator.
  if (row_.size() == header_.size() + 1 && row_.back().empty()) row_.pop_back();
  return true;
}

std::string TableText::row_fault() const {
  if (row_.size() == header_.size()) return {};
  return fmt::format("the line has {} fields, but the header has {}", row_.size(), header_.size());
}

bool TableText::next_line(std::string_view& line) {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin != std::string_view::npos && line[begin] != '#') return true;
  }
  return false;
}

}  // namespace rotorub
