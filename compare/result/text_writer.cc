#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/result/result.h"

namespace rotorub::result {
namespace {

std::string padded(const std::string& text, int width) {
  const int size = std::abs(width);
  return width < 0 ? fmt::format("{:<{}}", text, size) : fmt::format("{:>{}}", text, size);
}

// A line of items, of which those of columns for JSON alone are left out.
std::string line_of(const Table& table, const std::vector<Item>& items, std::string lead,
                    const Palette& palette) {
  std::string text;
  for (std::size_t k = 0; k < std::min(items.size(), table.columns.size()); ++k) {
    const Column& column = table.columns[k];
    if (!(column.seen & kTerminal)) continue;
    const std::string cell = text_of(items[k]);
    const Tone tone = items[k].beside.empty() ? items[k].tone : Tone::kPlain;
    text += palette.paint_first(tone, padded(lead + cell, column.width), cell);
    lead.clear();
  }
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

class TextWriter {
 public:
  TextWriter(const Palette& palette, Units units) : palette_(palette), units_(units) {}

  std::string operator()(const Data&) const { return ""; }

  std::string operator()(const Sentence& s) const {
    if (!(s.seen & kTerminal)) return "";
    const std::string words = in_units(s.text, units_);
    std::string text = s.wraps ? wrapped(s.lead, words, s.indent) : s.lead + words;
    if (!text.ends_with('\n')) text += '\n';
    return palette_.paint_first(s.tone, std::move(text), s.toned.empty() ? s.lead : s.toned);
  }

  std::string operator()(const Table& table) const {
    if (!(table.seen & kTerminal)) return "";
    std::vector<Item> headings;
    for (const Column& c : table.columns) headings.push_back({.text = label(c.heading)});
    std::string text;
    if (std::ranges::any_of(table.columns, [](const Column& c) { return !c.heading.empty(); }))
      text += line_of(table, headings, table.lead, palette_);
    for (const Row& row : table.rows) {
      if (!(row.seen & kTerminal)) continue;
      text += line_of(table, shown(table, row), row.lead.empty() ? table.lead : row.lead, palette_);
      if (!row.note.text.empty()) text += (*this)(row.note);
    }
    return text;
  }

  std::string operator()(const Section& section) const {
    std::string text;
    if (!(section.seen & kTerminal)) return text;
    for (const Part& part : section.parts) text += std::visit(*this, part);
    return text;
  }

 private:
  // A label or heading with its unit.
  std::string label(const std::string& text) const {
    const UnitChange* change = unit_change(text, units_);
    if (!change) return text;
    return text.substr(0, text.size() - change->from.size()) + std::string(change->to);
  }

  // The items of a row. The unit of a number stands at the end of the row's first item or of its
  // column's heading.
  std::vector<Item> shown(const Table& table, const Row& row) const {
    std::vector<Item> items = row.items;
    if (units_ == Units::kAsWritten || items.empty()) return items;
    const UnitChange* of_row = unit_change(text_of(items[0]), units_);
    for (std::size_t k = 0; k < std::min(items.size(), table.columns.size()); ++k) {
      const UnitChange* of_column = unit_change(table.columns[k].heading, units_);
      const UnitChange* change = of_column ? of_column : of_row;
      const std::string text = text_of(items[k]);
      items[k].text = change ? label(times(text, change->factor)) : in_units(text, units_);
    }
    return items;
  }

  Palette palette_;
  Units units_;
};

}  // namespace

std::string text_of(const Item& item) {
  const nlohmann::json& value = item.value;
  if (!item.text.empty() || value.is_discarded()) return item.text;
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return value.is_number() ? short_number(value.get<double>()) : "–";
}

Item number(const std::optional<double>& value, int digits, double factor) {
  nlohmann::json written = number_or_null(value);
  std::string text = written.is_null() ? "-" : fmt::format("{:.{}g}", factor * *value, digits);
  return {std::move(written), std::move(text)};
}

Sentence line(std::string text, Role role) {
  return {.text = std::move(text), .wraps = false, .role = role};
}

void Section::add(std::vector<Part> more) { std::ranges::move(more, std::back_inserter(parts)); }

std::string text_of(const Section& result, const Palette& palette, Units units) {
  return TextWriter(palette, units)(result);
}

void print(const Section& result, const Printing& how) {
  if (how.json) {
    std::cout << json_text(json_of(result));
  } else if (!how.quiet) {
    std::cout << text_of(result, how.palette, how.units);
  }
}

}  // namespace rotorub::result
