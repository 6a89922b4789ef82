// Lines of fields with separators, as written by spreadsheets and instruments.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rotorub {

// The fields without surrounding blanks and double quotes. A separator within quotes does not
// count.
std::vector<std::string> fields_of(std::string_view line, char separator);

// A tab or semicolon if the header contains one, otherwise a comma.
char separator_of(std::string_view header);

}  // namespace rotorub
