// The head of a column of a measured run: its name and unit, and why it is refused.
#pragma once

#include <string>
#include <string_view>

#include "compare/measured/record.h"
#include "native_model/scene/units.h"

namespace rotorub {

// "rotor_x [um]" is a name and a unit; without brackets it is a name.
struct ColumnHead {
  static constexpr std::string_view kTime = "t";

  std::string text, name, unit;
  bool has_unit = false;
  bool closed = true;                // the bracket is closed and nothing follows it
  const Measurable* what = nullptr;  // null: the time, or an ignored column
  double factor = 1.0;               // SI = value * factor
  bool is_time() const { return name == kTime; }
  bool read() const { return is_time() || what; }
  const scene::Quantity& quantity() const { return is_time() ? scene::kTime : what->quantity; }

  explicit ColumnHead(const std::string& field);
};

// True for the columns of the program's own series, including numbered ones ("x_2") and the outputs
// of a law ("control_<name>").
bool is_own_column(std::string_view name);

// "t, rotor_x, rotor_y, ..."
std::string accepted_names();
// Why a name is refused, and what is accepted.
std::string unknown_reason(std::string_view name);
// The same for a column of the file, whose name is mostly a logger's own.
std::string foreign_reason(std::string_view name, std::string_view unit);

// "mil" from "mil pp", a unit followed by a word for the kind of amplitude; otherwise empty.
std::string_view counted_unit(std::string_view unit);

}  // namespace rotorub
