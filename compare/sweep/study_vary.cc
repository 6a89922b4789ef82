#include "compare/sweep/study_vary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/sweep/study_reader.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::sweep {
namespace {

using scene::TomlNode;
using Kind = TomlNode::Kind;

// The value as it would be written after `key =`.
std::string toml_text(const TomlNode& value) {
  TomlNode table;
  table.entries.emplace_back("v", value);
  std::string text = scene::write_toml(table);
  text.erase(0, text.find('=') + 2);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

// Why a value cannot be written in a field of a row and after `key =`; empty if it can.
std::string unfit(const TomlNode& node) {
  if (node.kind == Kind::kTable)
    return "expected a value, got a table; give a [[vary]] for each of its keys";
  if (node.kind == Kind::kDate) return "expected a value of a scene, got a date or time";
  const bool broken = std::any_of(node.text.begin(), node.text.end(),
                                  [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (broken) return "expected a text on one line, without control characters";
  for (const TomlNode& item : node.items) {
    if (std::string reason = unfit(item); !reason.empty()) return reason;
  }
  return {};
}

Value value_of(const StudyTable& table, const TomlNode& node, const std::string& name,
               const std::string& path, const scene::Key* key) {
  // A user's own law may take a text.
  const bool text = key != nullptr && key->name.empty() && node.kind == Kind::kString;
  const bool number = !text && ((takes_number(path, key) && node.kind != Kind::kArray) ||
                                (key != nullptr && key->type == scene::ValueType::kWhole));
  if (!number && key != nullptr && !key->words.empty())
    say_old_word(table.path_of(name), node.text);
  if (!number) return {node.kind == Kind::kString ? node.text : toml_text(node), std::nullopt};
  const auto value = table.number(node, name, key->quantity);
  return {value ? number_text(*value) : "", value};
}

void read_values(const StudyTable& table, const TomlNode& node, const scene::Key* key, Vary& vary) {
  for (const char* other : {"from", "to", "count", "spacing"}) {
    if (!table.has(other)) continue;
    table.fail(other, "cannot be given together with `values`; remove one of them");
  }
  if (node.kind != Kind::kArray || node.items.empty()) {
    table.fail("values", "expected a list with at least one value");
    return;
  }
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const std::string name = "values[" + std::to_string(i) + "]";
    if (const std::string reason = unfit(node.items[i]); !reason.empty())
      table.fail("values", name + ": " + reason);
    vary.values.push_back(value_of(table, node.items[i], name, vary.key, key));
  }
  vary.count = static_cast<std::int64_t>(vary.values.size());
}

// Whole numbers: in a grid all of them, or `count` evenly spaced ones.
void read_whole_range(const StudyTable& table, SampleKind kind, Vary& vary) {
  constexpr auto kMost = static_cast<std::int64_t>(1) << 53;
  for (const char* end : {"from", "to"})
    if (!table.has(end)) table.missing(end, "a whole number, or `values`");
  for (const char* other : {"spacing", "distribution"})
    if (table.has(other))
      table.fail(other,
                 "does not apply to whole numbers, of which `from` and `to` give all; remove it");
  const auto from = table.whole("from", -kMost, kMost), to = table.whole("to", -kMost, kMost);
  vary.whole = true;
  if (!from || !to) return;
  vary.from = static_cast<double>(*from);
  vary.to = static_cast<double>(*to);
  if (*to < *from) return table.fail("to", "expected a whole number no less than `from`");
  if (kind != SampleKind::kGrid) return;
  vary.count = table.whole("count", 1, kMostPoints).value_or(*to - *from + 1);
  if (vary.count > 1 ? (*to - *from) % (vary.count - 1) != 0 || *to == *from : *to != *from) {
    table.fail("count", fmt::format("{} evenly spaced values from {} to {} are not all whole; "
                                    "change `count`, or leave it out for every whole number",
                                    vary.count, *from, *to));
  }
}

void read_range(const StudyTable& table, const scene::Key* key, SampleKind kind, Vary& vary) {
  if (kind != SampleKind::kGrid && table.has("count"))
    table.fail("count", "is only for a grid. With random points, set [sample] runs.");
  if (key != nullptr && key->type == scene::ValueType::kWhole)
    return read_whole_range(table, kind, vary);
  if (!takes_number(vary.key, key)) {
    table.missing("values", "a list of values, because " + vary.key +
                                " is not a single number and has no range from `from` to `to`");
    return;
  }
  if (table.has("distribution")) {
    if (kind == SampleKind::kGrid)
      return table.fail(
          "distribution",
          "belongs to drawn points, not to a grid; remove it, or change the kind of [sample]");
    if (table.has("spacing"))
      table.fail("spacing", "cannot be given together with `distribution`; remove one of them");
    vary.distribution = read_distribution(table, key->quantity);
    return;
  }
  for (const char* end : {"from", "to"}) {
    if (!table.has(end)) table.missing(end, std::string(key->quantity.name) + ", or `values`");
  }
  const auto from = table.number("from", key->quantity), to = table.number("to", key->quantity);
  vary.spacing = table.word<Spacing>("spacing", {"linear", "log"}).value_or(Spacing::kLinear);
  if (from && to) {
    vary.from = *from;
    vary.to = *to;
    if (vary.spacing == Spacing::kLog && !(vary.from > 0.0 && vary.to > 0.0)) {
      table.fail("spacing", "\"log\" needs `from` and `to` above 0");
    }
    if (!std::isfinite(vary.to - vary.from)) table.fail("to", "is too far from `from`");
    vary.start = table.number("start", key->quantity);
    if (vary.start && !(*vary.start >= vary.from && *vary.start <= vary.to))
      table.fail("start", "expected a value between `from` and `to`");
  }
  if (kind == SampleKind::kGrid) {
    if (!table.has("count")) table.missing("count", "the number of values, 1 or more");
    vary.count = table.whole("count", 1, kMostPoints).value_or(1);
  }
}

void read_also(const StudyTable& table, Vary& vary) {
  const TomlNode* also = table.find("also");
  if (also == nullptr) return;
  if (also->kind != Kind::kArray) return table.fail("also", "expected a list of keys");
  for (const TomlNode& item : also->items) {
    std::string reason =
        item.kind == Kind::kString ? "" : "expected a key in quotes, for example \"drive.speed\"";
    if (reason.empty()) scene_key(item.text, reason);
    if (reason.empty() && item.text == vary.key)
      reason = "`" + vary.key + "` is the varied key itself; remove it here";
    if (!reason.empty()) table.fail("also", reason);
    vary.also.push_back(item.text);
  }
}

// Reads the values from the list's file.
void read_column(const StudyTable& table, const PointsFile& points, const scene::Key* key,
                 Vary& vary) {
  const std::string name = table.text("column").value_or(vary.key);
  const auto found = std::find(points.names.begin(), points.names.end(), name);
  if (found == points.names.end()) {
    const std::vector<std::string_view> known(points.names.begin(), points.names.end());
    table.fail(table.has("column") ? "column" : "key",
               fmt::format("{} has no column `{}`{}", points.file.string(), scene::printable(name),
                           scene::suggestion(name, known)));
    return;
  }
  const auto k = static_cast<std::size_t>(found - points.names.begin());
  TomlNode node;
  node.kind = Kind::kString;
  node.file = points.file.string();
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    node.line = points.lines[i];
    node.text = points.points[i][k] + (points.units[k].empty() ? "" : " " + points.units[k]);
    vary.values.push_back(value_of(table, node, vary.key, vary.key, key));
  }
  vary.count = static_cast<std::int64_t>(vary.values.size());
}

}  // namespace

PointsFile read_points(const std::filesystem::path& file) {
  PointsFile points{file, scene::file_text(file), {}, {}, {}, {}};
  const auto refuse = [&](int line, std::string reason) {
    throw scene::SceneError({{file.string(), line, "", std::move(reason)}});
  };
  TableText table(points.text);
  for (const std::string& field : table.header()) {
    // A key may itself contain brackets, as in force[0].amplitude; the unit is the last pair.
    const std::size_t open = field.rfind(" [");
    const bool unit = open != std::string::npos && field.ends_with(']');
    points.names.emplace_back(scene::trimmed(field.substr(0, unit ? open : field.size())));
    points.units.push_back(unit ? field.substr(open + 2, field.size() - open - 3) : "");
  }
  while (table.next()) {
    if (const std::string fault = table.row_fault(); !fault.empty()) refuse(table.line(), fault);
    points.points.push_back(table.row());
    points.lines.push_back(table.line());
  }
  if (points.points.empty()) refuse(0, "no points: expected a header and a line a point");
  return points;
}

Vary read_vary(TomlNode& node, const std::string& path, SampleKind kind, const PointsFile& points,
               std::vector<scene::Diagnostic>& diagnostics) {
  const StudyTable table(
      node, path,
      {"key", "also", "values", "from", "to", "count", "spacing", "column", "distribution", "mean",
       "deviation", "median", "log_deviation", "mode", "scale", "shape", "start"},
      diagnostics);
  Vary vary;
  const auto name = table.text("key");
  if (!name) {
    if (!table.has("key")) table.missing("key", "a key of the scene, as contact.friction");
    return vary;
  }
  vary.key = *name;
  std::string reason;
  const scene::Key* key = scene_key(vary.key, reason);
  if (!reason.empty()) {
    table.fail("key", reason);
    return vary;
  }
  if (key != nullptr && key->quantity.unit != "1") vary.unit = key->quantity.unit;
  read_also(table, vary);
  const TomlNode* values = table.find("values");
  if (table.has("column") && (points.points.empty() || values != nullptr))
    table.fail("column",
               points.points.empty() ? "needs the points' file: [sample] file" : "beside `values`");
  if (!table.has("distribution")) refuse_parameters(table);
  if (values == nullptr && !points.points.empty()) {
    read_column(table, points, key, vary);
  } else if (kind == SampleKind::kList && values == nullptr) {
    table.missing("values", "a list: in a list of points each [[vary]] gives all its values");
  } else if (values != nullptr) {
    read_values(table, *values, key, vary);
  } else {
    read_range(table, key, kind, vary);
  }
  return vary;
}

}  // namespace rotorub::sweep
