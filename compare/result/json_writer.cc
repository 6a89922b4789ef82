#include <algorithm>
#include <string>
#include <string_view>
#include <variant>

#include "compare/result/result.h"

namespace rotorub::result {
namespace {

// The keys that replace {row} and {column} in a place. next: "#" adds an element to its list;
// otherwise it is the last element.
struct Names {
  std::string_view row{}, column{};
  bool next = true;
};

// The node at a place; it is made, as null, if it is missing.
template <class Json>
Json& node_at(Json& from, std::string_view place, const Names& names = {}) {
  Json* node = &from;
  while (!place.empty()) {
    const std::string_view step = place.substr(0, place.find('/'));
    place.remove_prefix(std::min(place.size(), step.size() + 1));
    if (step == "#") {
      if (node->is_null()) *node = Json::array();
      if (names.next || node->empty()) node->push_back(Json());
      node = &node->back();
    } else if (step == "{column}") {
      node = &node_at(*node, names.column);
    } else {
      const std::string key(step == "{row}" ? names.row : step);
      node = node->is_array() ? &node->at(std::stoul(key)) : &(*node)[key];
    }
  }
  return *node;
}

bool is_written(const Column& column) { return column.seen & kJson && !column.key.empty(); }

// Writes parts into the JSON of a section.
template <class Json>
class JsonWriter {
 public:
  explicit JsonWriter(Json& section) : section_(section) {}

  void operator()(const Data& data) const {
    if (data.place.empty()) {
      section_.update(Json(data.value));
    } else {
      node_at(section_, data.place) = data.value;
    }
  }

  void operator()(const Sentence& sentence) const {
    if (!(sentence.seen & kJson) || sentence.place.empty()) return;
    node_at(section_, sentence.place) = sentence.text;
  }

  void operator()(const Table& table) const {
    if (!(table.seen & kJson) || table.place.empty()) return;
    for (const Column& column : table.columns) {
      if (is_written(column)) begin(table, column);
    }
    for (const Row& row : table.rows) {
      if (row.seen & kJson) write(table, row);
    }
  }

  void operator()(const Section& section) const {
    if (!(section.seen & kJson)) return;
    Json& node = node_at(section_, section.place);
    if (node.is_null()) node = Json::object();
    for (const Part& part : section.parts) std::visit(JsonWriter(node), part);
  }

 private:
  // The empty list or object of the rows.
  void begin(const Table& table, const Column& column) const {
    const std::size_t hash = table.place.find('#');
    const std::size_t rows = std::min(hash, table.place.find("{row}"));
    if (rows == std::string::npos) return;
    Json& node =
        node_at(section_, std::string_view(table.place).substr(0, rows), {.column = column.key});
    if (node.is_null()) node = hash == rows ? Json::array() : Json::object();
  }

  void write(const Table& table, const Row& row) const {
    if (row.key.empty() && table.place.find("{row}") != std::string::npos) return;
    // Each column has a list of its own, or there is one list for all of them.
    const bool has_lists = table.place.find("{column}") < table.place.find('#');
    bool next = true;
    for (std::size_t k = 0; k < std::min(row.items.size(), table.columns.size()); ++k) {
      const Column& column = table.columns[k];
      if (!is_written(column) || row.items[k].value.is_discarded()) continue;
      node_at(section_, table.place, {row.key, column.key, next || has_lists}) = row.items[k].value;
      next = false;
    }
    if (row.data.is_null()) return;
    const std::string_view keys = std::string_view(table.place).substr(0, table.place.rfind('/'));
    node_at(section_, keys, {row.key, "", next}).update(Json(row.data));
  }

  Json& section_;
};

template <class Json>
Json written(const Section& result) {
  Json all = Json::object();
  for (const Part& part : result.parts) std::visit(JsonWriter<Json>(all), part);
  return all;
}

}  // namespace

nlohmann::json json_of(const Section& result) { return written<nlohmann::json>(result); }

nlohmann::ordered_json ordered_json_of(const Section& result) {
  return written<nlohmann::ordered_json>(result);
}

}  // namespace rotorub::result
