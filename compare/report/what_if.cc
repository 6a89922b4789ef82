#include "compare/report/what_if.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compare/base/json.h"
#include "compare/base/module_file.h"
#include "compare/base/plot_points.h"
#include "native_model/control/library_file.h"
#include "native_model/scene/adjustable.h"
#include "native_model/scene/reader.h"

namespace rotorub {

namespace {

using nlohmann::json;
using scene::Adjustable;
using scene::TomlNode;

constexpr const char* kNativeModule = "rotorub_native.wasm.gz";

// Other keys that hold the rotor's speed: the drive's, and frequencies of forces that follow the
// speed.
json keeping_step(const TomlNode& root, double speed) {
  json also = json::array();
  for (const Adjustable& other : scene::speeds_beside_the_rotors(root)) {
    if (other.value == speed) also.push_back(other.path);
  }
  return also;
}

json slider(const TomlNode& root, const Adjustable& of) {
  const scene::Range& range = of.key->range;
  return {{"key", of.path},
          {"also", of.path == "rotor.speed" ? keeping_step(root, of.value) : json::array()},
          {"unit", of.key->quantity.unit},
          {"value", of.value},
          {"low", number_or_null(range.low)},
          {"low_open", range.low_open},
          {"high", number_or_null(range.high)},
          {"meaning", of.key->meaning}};
}

json all_sliders(const TomlNode& root) {
  json sliders = json::array();
  for (const Adjustable& number : scene::adjustable_numbers(root)) {
    // A value of 0 without a range of its own cannot have a slider, nor can a part of a vector.
    if (number.part != Adjustable::Part::kWhole) continue;
    if (number.value != 0.0 || std::isfinite(number.key->range.high))
      sliders.push_back(slider(root, number));
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
