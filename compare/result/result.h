// The result of a command as parts: sentences, tables, data and sections of these. A command builds
// it once; json_of() writes it as JSON, text_of() for a terminal, page_json() for a page. None of
// them knows the command.
#pragma once

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "compare/base/palette.h"
#include "compare/result/shown_units.h"

namespace rotorub::result {

// A place is a path of keys in the JSON of its section, "timing/median". "#" in it is a new element
// of a list, "remarks/#", and a number is the element that has it, from 0: "remarks/0/why". A part
// without a place is for people alone.

// Who sees a part. People read the terminal and the page.
enum Audience {
  kJson = 1,
  kTerminal = 2,
  kPage = 4,
  kNotPage = kJson | kTerminal,
  kNotTerminal = kJson | kPage,
  kPeople = kTerminal | kPage,
  kAll = kJson | kPeople
};

// A cell of a table: its value in JSON (SI), and its text.
struct Item {
  // By default the cell is absent from the JSON. A number that is not finite becomes null.
  nlohmann::json value = nlohmann::json::value_t::discarded;
  // Written instead of the value. If it is empty, a string is written as it is, a number by
  // short_number(), and null as "–".
  std::string text{};
  Tone tone = Tone::kPlain;  // of the text, or of `beside`
  std::string note{};        // on a page, why the cell has this text
  std::string beside{};      // on a page, words below the text: a difference from another value
};
// The text of an item for people.
std::string text_of(const Item& item);

// A number: its value in SI, and for people `factor` times it with that many significant digits.
// null and "-" if it is missing or not finite.
Item number(const std::optional<double>& value, int digits, double factor = 1.0);

// The place of a sentence on a page. On a terminal all sentences are written alike.
enum class Role {
  kText,
  kHeading,  // begins a part of the page
  kCaption   // belongs to the next table
};

// Words for people. An empty sentence is an empty line.
struct Sentence {
  std::string text{};
  std::string lead{};                   // before the text, "  note: "
  std::optional<std::size_t> indent{};  // of the lines after the first; by default the lead's width
  bool wraps = true;                    // see line()
  Tone tone = Tone::kPlain;
  std::string toned{};  // the words that have the tone, at their first place; empty: the lead
  std::string place{};  // the text stands here in JSON
  Audience seen = kAll;
  Role role = Role::kText;
};

// Writes text of one or several lines unchanged. A line break is added if the end has none.
Sentence line(std::string text, Role role = Role::kText);

struct Column {
  std::string key{};      // in JSON, or a place: "runs/cone"; empty: for people alone
  std::string heading{};  // for people
  // Width of the text with the blanks between columns. A negative width aligns it to the left. A
  // longer text is not cut. On a page, numbers have a positive width.
  int width = 0;
  Audience seen = kAll;
  std::string title{};  // on a page instead of the heading
};

struct Row {
  std::string key{};          // replaces {row} in the table's place; empty: none
  std::vector<Item> items{};  // in the order of the columns; missing ones at the end are empty
  std::string lead{};         // a mark before the first item instead of the table's lead: "* "
  Sentence note{};            // below the row, for people; empty: none
  nlohmann::json data{};      // JSON alone: an object whose keys join those of the columns
  Audience seen = kAll;
};

// In JSON each cell of a column with a key stands at the place of the table, in which {row} and
// {column} are their keys and "#" is one element for each row:
//   levels/#/{column}                a list of objects
//   speeds/#                         a list of values, of the one column with a key
//   figures/{row}/{column}           an object of objects
//   errors/{row}                     an object of values, of the one column with a key
//   differences/{column}/figures/{row}   one value, or one object, for each cell
// Without rows, the list or the object of the rows is empty.
// For people, a line of headings, unless all are empty, and a line for each row. The lead counts as
// a part of the first item. Blanks at the end of a line are left out. A page has no table without
// rows.
struct Table {
  std::string place{};
  std::vector<Column> columns{};
  std::vector<Row> rows{};
  std::string lead = "  ";
  Audience seen = kAll;
};

// A function add(column, item) that adds a column with item(element) for each element, one in a
// row.
template <class Elements>
auto column_adder(Table& table, const Elements& elements) {
  return [&](Column column, const auto& item) {
    table.columns.push_back(std::move(column));
    table.rows.resize(std::max(table.rows.size(), static_cast<std::size_t>(elements.size())));
    for (std::size_t k = 0; const auto& element : elements)
      table.rows[k++].items.push_back(item(element));
  };
}

// JSON alone. At the empty place, the keys of an object join those of the section.
struct Data {
  std::string place{};
  nlohmann::json value{};
};

struct Part;

// An object in JSON, of the parts within it; at the empty place, their keys join those of the
// section around it. The place of the outermost section is not used.
struct Section {
  std::string place{};
  std::vector<Part> parts{};
  Audience seen = kAll;
  std::string title{};  // of a section of the page; without one it belongs to the section around it
  std::string id{};     // of that section; by default its place, "scenes-1" for "scenes/#"

  void add(std::vector<Part> more);
};

struct Part : std::variant<Sentence, Table, Data, Section> {
  using variant::variant;
};

// The keys in alphabetical order, or as the parts set them.
nlohmann::json json_of(const Section& result);
nlohmann::ordered_json ordered_json_of(const Section& result);
// Sentences are at most 80 columns wide.
std::string text_of(const Section& result, const Palette& palette = Palette(),
                    Units units = Units::kAsWritten);
// A list of what a page lays out (report/page/layout.js):
//   {"heading": text}
//   {"text", "mark", "tone", "toned": the words that have the tone}, or {"lines": text of several
//   lines}
//   {"caption", "columns": [{"text", "number": true}], "rows": [{"cells": [text or {"text",
//   "beside", "tone", "note"}], "mark", "note"}]}
//   {"id", "title", "parts": a list as this one}
// A mark is a lead without letters, "*".
// Keys without a value are absent. Tones: "good", "part", "bad". Blanks that align texts on a
// terminal are left out.
nlohmann::json page_json(const Section& result);

struct Printing {
  bool json = false, quiet = false;
  Palette palette{};
  Units units = Units::kAsWritten;  // of the text
};
// Prints the result to standard output: as JSON and nothing else, as text, or not at all.
void print(const Section& result, const Printing& how);

}  // namespace rotorub::result
