// What stands in the files of a run: name, unit, meaning and sign of every column. The recorder
// takes its units from here, columns.json beside the data is made of it, and so is the reference in
// compare/study/README.md.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace rotorub {

struct ColumnMeaning {
  std::string_view
      name;  // "torsion_<n>": numbered from 1; "control_<name>": as the controller's law calls it
  std::string_view unit;     // SI; "": none
  std::string_view meaning;  // with its sign
  std::string_view present;  // where it stands; "": always
};

std::span<const ColumnMeaning> series_columns();  // in the order of the file
// Where there are several contacts the last tells which.
std::span<const ColumnMeaning> impact_columns(bool several = true);
std::span<const ColumnMeaning> event_columns(bool several = true);

// The column of one of several contacts, from 0: that of the first as it is, "gap" of the second
// "contact2_gap".
std::string column_of_contact(std::size_t contact, std::string_view name);
std::pair<std::size_t, std::string_view> contact_of_column(std::string_view name);

// Of a column of a series by the name in its header ("x_2"). Every name has one: what no other row
// names is a law's own output.
const ColumnMeaning& series_column(std::string_view name);

}  // namespace rotorub
