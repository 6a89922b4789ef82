#include "compare/report/what_if.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "compare/base/module_file.h"
#include "compare/report/plot_points.h"
#include "native_model/control/library_file.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub {

namespace {

using nlohmann::json;
using scene::Key;
using scene::Table;
using scene::TomlNode;

constexpr const char* kNativeModule = "rotorub_native.wasm.gz";

// The keys that are offered, in the page's order, if the scene sets them as numbers; for a
// controller also keys at their defaults.
struct Offer {
  std::string_view table;
  std::vector<std::string_view> keys;
};
const std::vector<Offer>& offers() {
  static const std::vector<std::string_view> gains = {
      "preload", "gap_time", "bandwidth", "switching_gain", "stiffness", "damping", "feedback"};
  static const std::vector<Offer> all = {
      {"contact", {"friction", "clearance", "restitution"}},
      {"rotor", {"speed"}},
      {"rotor.disc", {"eccentricity", "unbalance"}},
      {"force", {"amplitude"}},
      {"controller", gains},
      {"contact.controller", gains},
      {"magnetic_bearing.control", {"stiffness", "damping"}},
  };
  return all;
}

// A table of the scene and its path: "rotor.disc[1]".
struct Place {
  std::string path;
  const TomlNode* node;
};
std::vector<Place> places_of(const TomlNode& root, std::string_view table) {
  std::vector<Place> places = {{"", &root}};
  while (!table.empty()) {
    const std::string name(table.substr(0, table.find('.')));
    table.remove_prefix(std::min(table.size(), name.size() + 1));
    std::vector<Place> next;
    for (const Place& place : places) {
      const TomlNode* found = place.node->find(name);
      if (!found) continue;
      const std::string path = place.path.empty() ? name : place.path + "." + name;
      if (found->kind == TomlNode::Kind::kTable) next.push_back({path, found});
      for (std::size_t k = 0; k < found->items.size(); ++k)
        next.push_back({scene::list_element(path, k), &found->items[k]});
    }
    places = std::move(next);
  }
  return places;
}

// SI; empty if it is not a single number.
std::optional<double> number_of(const TomlNode& node, const scene::Quantity& quantity) {
  switch (node.kind) {
    case TomlNode::Kind::kFloat:
      return node.number;
    case TomlNode::Kind::kInteger:
      return static_cast<double>(node.integer);
    case TomlNode::Kind::kString: {
      const scene::ParsedQuantity parsed = scene::parse_quantity(node.text, quantity);
      return parsed.error.empty() ? std::optional(parsed.value) : std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

std::optional<double> number_at(const Place& place, const Key& key) {
  for (const std::string_view name : {key.name, key.also}) {
    const TomlNode* node = name.empty() ? nullptr : place.node->find(name);
    if (node) return number_of(*node, key.quantity);
  }
  const bool law = place.path.ends_with("controller");
  if (!law || key.type != scene::ValueType::kNumber || key.standard.empty()) return std::nullopt;
  return std::strtod(key.standard.c_str(), nullptr);
}

// The unit for people; empty if dimensionless.
std::string unit_of(const scene::Quantity& quantity, double value) {
  const std::string_view si = quantity.unit;
  if (si == "1") return "";
  if (si == "m") return std::abs(value) < 1e-4 ? "um" : "mm";
  if (si == "rad/s") return "rpm";
  return si == "s" ? "ms" : std::string(si);
}

// Other keys that hold the rotor's speed: the drive's, and frequencies of forces that follow the
// speed.
json keeping_step(const TomlNode& root, double speed) {
  json also = json::array();
  const std::vector<Offer> of = {{"drive", {"speed", "synchronous_speed"}},
                                 {"force", {"frequency"}}};
  for (const auto& [path, keys] : of) {
    for (const Place& place : places_of(root, path)) {
      for (const std::string_view name : keys) {
        const TomlNode* node = place.node->find(name);
        if (node && number_of(*node, scene::kSpin) == speed)
          also.push_back(place.path + "." + std::string(name));
      }
    }
  }
  return also;
}

json slider(const TomlNode& root, const Place& place, const Key& key, double value) {
  const std::string unit = unit_of(key.quantity, value);
  const double factor = 1.0 / scene::parse_quantity("1 " + unit, key.quantity).value;
  const bool bounded = std::isfinite(key.range.low) && std::isfinite(key.range.high);
  const bool from_zero = key.range.low == 0.0 && !key.range.low_open;
  const double low = bounded ? key.range.low : from_zero ? 0.0 : 0.25 * value;
  const double high = bounded ? key.range.high : 2.0 * value;
  const std::string path = place.path + "." + std::string(key.name);
  return {{"key", path},
          {"also", path == "rotor.speed" ? keeping_step(root, value) : json::array()},
          {"unit", unit},
          {"value", factor * value},
          {"low", factor * std::min(low, high)},
          {"high", factor * std::max(low, high)},
          {"meaning", key.meaning}};
}

json all_sliders(const TomlNode& root) {
  json sliders = json::array();
  for (const Offer& offer : offers()) {
    const Table* table = scene::find_table(offer.table);
    for (const Place& place : places_of(root, offer.table)) {
      const TomlNode* kind = place.node->find("kind");
      for (const std::string_view name : offer.keys) {
        const Key* key = table ? table->find(name) : nullptr;
        if (!key || !key->is_for(kind ? kind->text : "")) continue;
        const std::optional<double> value = number_at(place, *key);
        // A value of 0 without a range of its own cannot have a slider.
        const bool ranged = std::isfinite(key->range.high);
        if (value && (*value != 0.0 || ranged))
          sliders.push_back(slider(root, place, *key, *value));
      }
    }
  }
  return sliders;
}

}  // namespace

std::string native_module() { return base64(scene::regular_file_text(module_file(kNativeModule))); }

json sliders_of(const scene::Scene& scene) {
  std::vector<scene::Diagnostic> diagnostics;
  if (scene.text.empty() || !libraries_of(scene).empty()) return json::array();
  const std::optional<TomlNode> root = scene::parse_toml(scene.text, scene.name, diagnostics);
  return root && diagnostics.empty() ? shortened(all_sliders(*root)) : json::array();
}

json what_if_data(const scene::Scene& scene) {
  if (module_file(kNativeModule).empty()) return nullptr;
  const json sliders = sliders_of(scene);
  if (sliders.empty()) return nullptr;
  return {{"name", scene.name + ".toml"}, {"sliders", sliders}};
}

}  // namespace rotorub
