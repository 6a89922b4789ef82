#include "compare/measured/column_head.h"

#include <fmt/format.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

using scene::printable;

const Measurable* measurable(std::string_view name) {
  for (const Measurable& m : measurables()) {
    if (name == m.name || (!m.other.empty() && name == m.other)) return &m;
  }
  return nullptr;
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> all{ColumnHead::kTime};
  for (const Measurable& m : measurables()) all.push_back(m.name);
  return all;
}

// An example of --measured-column for a column with a logger's own name. A name that ends in y,
// such as CH1 Y, becomes rotor_y.
std::string example_of(std::string_view name, std::string_view unit) {
  const std::string_view plain = counted_unit(unit).empty() ? unit : counted_unit(unit);
  const bool is_length =
      !plain.empty() &&
      scene::parse_quantity("1 " + std::string(plain), scene::kLength).error.empty();
  return fmt::format("--measured-column \"{} = {} [{}]\"", printable(std::string(name)),
                     boost::iends_with(name, "y") ? "rotor_y" : "rotor_x",
                     is_length ? plain : std::string_view("um"));
}

}  // namespace

ColumnHead::ColumnHead(const std::string& field) : text(field), name(field) {
  if (const std::size_t open = field.find_first_of("[("); open != std::string::npos) {
    has_unit = true;
    name = boost::trim_copy(field.substr(0, open));
    unit = field.substr(open + 1);
    closed = !unit.empty() && unit.find(field[open] == '[' ? ']' : ')') == unit.size() - 1;
    if (closed) unit.pop_back();
    boost::trim(unit);
  }
  if (boost::iequals(name, "time")) name = kTime;
  what = measurable(name);
}

bool is_own_column(std::string_view name) {
  constexpr std::string_view kLaw = "control_";
  const std::string_view plain = contact_of_column(name).second;
  const bool of_a_law = plain.starts_with(kLaw) && plain.size() > kLaw.size();
  return of_a_law || series_column(name).name != "control_<name>";
}

std::string accepted_names() { return fmt::format("{}", fmt::join(names(), ", ")); }

std::string_view counted_unit(std::string_view unit) {
  constexpr std::string_view kCounts[] = {"pp",       "p-p",  "pk-pk", "peak-peak", "peak to peak",
                                          "pk to pk", "0-pk", "0-p",   "pk",        "rms"};
  for (const std::string_view count : kCounts) {
    if (boost::iends_with(unit, " " + std::string(count)))
      return scene::trimmed(unit.substr(0, unit.size() - count.size()));
  }
  return {};
}

std::string unknown_reason(std::string_view name) {
  const std::string_view near = scene::nearest(name, names());
  return fmt::format("no such column{}; choose from {}, each with its unit in [ ]",
                     near.empty() ? "" : fmt::format(", did you mean {}?", near), accepted_names());
}

std::string foreign_reason(std::string_view name, std::string_view unit) {
  return fmt::format("{}; to read a column that has another name, give for example {}",
                     unknown_reason(name), example_of(name, unit));
}

}  // namespace rotorub
