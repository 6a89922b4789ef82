#include "compare/base/separated.h"

#include <boost/algorithm/string/trim.hpp>
#include <boost/tokenizer.hpp>

namespace rotorub {

std::vector<std::string> fields_of(std::string_view line, char separator) {
  using Separator = boost::escaped_list_separator<char>;
  const std::string text(line);
  const Separator parts("", std::string(1, separator), "\"");
  std::vector<std::string> fields;
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

}  // namespace rotorub
