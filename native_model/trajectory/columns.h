// What stands in the files of a run: name, unit, meaning and sign of every column. The recorder takes its units
// from here, columns.json beside the data is made of it, and so is the reference in compare/study/README.md.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rotorub {

struct ColumnMeaning {
  std::string_view name;     // "torsion_<n>": numbered from 1; "control_<name>": as the controller's law calls it
  std::string_view unit;     // SI; "": none
  std::string_view meaning;  // with its sign
  std::string_view present;  // where it stands; "": always
};

std::span<const ColumnMeaning> series_columns();  // in the order of the file
std::span<const ColumnMeaning> impact_columns();
std::span<const ColumnMeaning> event_columns();

// Of a column of a series by the name in its header ("x_2"). Every name has one: what no other row names is a
// law's own output.
const ColumnMeaning& series_column(std::string_view name);

}  // namespace rotorub
