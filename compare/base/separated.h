// Lines of fields with separators between them, as spreadsheets and instruments write them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rotorub {

// Without blanks and double quotes around them. A separator in quotes is none.
std::vector<std::string> fields_of(std::string_view line, char separator);

// Tab or semicolon where the header has one, else the comma.
char separator_of(std::string_view header);

}  // namespace rotorub
