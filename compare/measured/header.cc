#include "compare/measured/header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "native_model/scene/printable.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

using scene::Diagnostic;
using scene::printable;

constexpr std::string_view kTime = "t";

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// "rotor_x [um]" is a name and a unit; without brackets a name alone.
struct NameAndUnit {
  std::string_view name, unit;
  bool has_unit = false;
  bool closed = true;  // the bracket, and nothing stands behind it
};

NameAndUnit parted(std::string_view field) {
  const std::size_t open = field.find_first_of("[(");
  if (open == std::string_view::npos) return {field, {}, false};
  const char close = field[open] == '[' ? ']' : ')';
  std::string_view unit = field.substr(open + 1);
  const bool closed = !unit.empty() && unit.find(close) == unit.size() - 1;
  if (closed) unit.remove_suffix(1);
  return {trimmed(field.substr(0, open)), trimmed(unit), true, closed};
}

const Measurable* measurable(std::string_view name) {
  for (const Measurable& m : measurables()) {
    if (name == m.name || (!m.other.empty() && name == m.other)) return &m;
  }
  return nullptr;
}

// Of the product's own series: by its name, or numbered from 1 ("x_2"). What a law shows of itself ("control_<name>")
// counts too.
bool is_own_column(std::string_view name) {
  for (const ColumnMeaning& c : series_columns()) {
    const std::string_view own = c.name;
    if (name == own) return true;
    const std::size_t variable = own.find('<');
    if (variable == std::string_view::npos || !name.starts_with(own.substr(0, variable))) continue;
    const std::string_view rest = name.substr(variable);
    const bool number = std::all_of(rest.begin(), rest.end(), [](char d) { return d >= '0' && d <= '9'; });
    if (!rest.empty() && (own.substr(variable) != "<n>" || number)) return true;
  }
  return false;
}

std::string accepted_names() {
  std::string all(kTime);
  for (const Measurable& m : measurables()) all += fmt::format(", {}", m.name);
  return all;
}

std::string unknown_reason(std::string_view name) {
  std::vector<std::string_view> names{kTime};
  for (const Measurable& m : measurables()) names.push_back(m.name);
  const std::string_view near = scene::nearest(name, names);
  return fmt::format("no such column{}; accepted are {}, each with its unit in [ ]",
                     near.empty() ? "" : fmt::format(", did you mean {}?", near), accepted_names());
}

// What one unit of the column is in SI, or why there is none.
std::string read_unit(const NameAndUnit& part, const scene::Quantity& quantity, double& factor) {
  if (!part.has_unit) return {};
  if (!part.closed) return "its bracket is not closed behind the unit; accepted is a header as rotor_x [um]";
  if (part.unit.empty()) return fmt::format("its brackets hold no unit; accepted are {}", quantity.examples);
  const scene::ParsedQuantity one = scene::parse_quantity(fmt::format("1 {}", part.unit), quantity);
  if (!one.error.empty()) return one.error;
  factor = one.value;
  return factor > 0.0 && std::isfinite(factor) ? std::string() : std::string("its unit is none to measure in");
}

}  // namespace

char separator_of(std::string_view header) {
  std::string bare;  // what stands in quotes parts nothing
  bool quoted = false;
  for (const char c : header) {
    if (c == '"') quoted = !quoted;
    if (!quoted) bare += c;
  }
  for (const char separator : {'\t', ';'}) {
    if (bare.find(separator) != std::string::npos) return separator;
  }
  return ',';
}

std::vector<std::string> csv_fields(std::string_view line, char separator) {
  std::vector<std::string> fields;
  std::size_t from = 0;
  bool quoted = false;
  for (std::size_t at = 0; at <= line.size(); ++at) {
    if (at < line.size() && line[at] == '"') quoted = !quoted;
    if (at < line.size() && (quoted || line[at] != separator)) continue;
    std::string_view field = trimmed(line.substr(from, at - from));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
      field = trimmed(field.substr(1, field.size() - 2));
    }
    fields.emplace_back(field);
    from = at + 1;
  }
  return fields;
}

MeasuredHeader read_header(const std::vector<std::string>& fields, const std::string& file, int line,
                           std::vector<Diagnostic>& wrong) {
  MeasuredHeader header;
  const auto refuse = [&](const std::string& key, std::string reason) {
    wrong.push_back({file, line, printable(key), std::move(reason)});
  };
  for (const std::string& field : fields) header.has_units = header.has_units || parted(field).has_unit;
  bool has_time = false, has_value = false;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const NameAndUnit part = parted(fields[k]);
    const std::string name = part.name.empty() ? fmt::format("column {}", k + 1) : std::string(part.name);
    HeaderColumn column{fields[k]};
    column.is_time = part.name == kTime;
    column.what = measurable(part.name);
    const bool again = column.read() && std::any_of(header.columns.begin(), header.columns.end(), [&](const auto& c) {
                         return column.is_time ? c.is_time : c.what == column.what;
                       });
    if (part.name.empty()) {
      refuse(name, "has no name; accepted are " + accepted_names());
    } else if (again) {
      refuse(name, "stands twice in the header; accepted is once");
    } else if (!column.read() && !is_own_column(part.name)) {
      refuse(name, unknown_reason(part.name));
    } else if (column.read()) {
      const scene::Quantity& quantity = column.is_time ? scene::kTime : column.what->quantity;
      if (header.has_units && !part.has_unit) {
        refuse(name, fmt::format("has no unit, which other columns have; accepted is {} [{}] with any of {}", name,
                                 quantity.unit, quantity.examples));
      } else if (const std::string reason = read_unit(part, quantity, column.factor); !reason.empty()) {
        refuse(name, reason);
      }
    }
    has_time = has_time || column.is_time;
    has_value = has_value || column.what;
    header.columns.push_back(std::move(column));
  }
  if (!has_time) refuse("t", "no such column in the header: a record needs its times, as t [ms]");
  if (!has_value && wrong.empty()) {
    refuse("", "nothing measured beside t; accepted are " + accepted_names());
  }
  return header;
}

}  // namespace rotorub
