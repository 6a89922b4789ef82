// The header of a measured run: which column holds what, in which unit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compare/measured/record.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub {

// What the fields of a line are parted by: a tab where the header has one, else a semicolon, else a comma.
char separator_of(std::string_view header);

// The fields of a line, without blanks and double quotes around them. A separator in quotes is none.
std::vector<std::string> csv_fields(std::string_view line, char separator);

struct HeaderColumn {
  std::string text;                  // as in the file
  const Measurable* what = nullptr;  // null: the time, or a column that is left out
  bool is_time = false;
  double factor = 1.0;  // SI = value * factor
  bool read() const { return is_time || what; }
};

struct MeasuredHeader {
  std::vector<HeaderColumn> columns;
  bool has_units = false;
};

// Appends to `wrong` what is wrong with it.
MeasuredHeader read_header(const std::vector<std::string>& fields, const std::string& file, int line,
                           std::vector<scene::Diagnostic>& wrong);

}  // namespace rotorub
