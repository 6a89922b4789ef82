#include "compare/tune/setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string_view>

#include "compare/base/format.h"
#include "compare/engine/engine.h"
#include "native_model/scene/overrides.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub::tune {
namespace {

using scene::ContactModel;
using scene::MujocoIntegrator;
using scene::MujocoSolver;
using scene::trimmed;

// 1/s^2. The values that MuJoCo's contact gets from steps of 200 us and 20 us.
constexpr double kStiffnesses[] = {1e6, 1e8};
// 1/s. With K = 1e8, damping ratios of 0.1 and 1, whatever the scene's restitution.
constexpr double kDampings[] = {2e3, 2e4};
constexpr double kDampedStiffness = 1e8;
// 1/s. One value below the first limit of theory.md (where the curvature of the ring closes the
// contact), and values on both sides of it.
constexpr double kFrictionReferences[] = {1.0, 10.0, 100.0};

std::string override_of(const KeyValue& v) {
  return fmt::format("{}.{}={}", v.table, v.key, v.value.empty() ? "none" : v.value);
}

bool is_soft(const Setting& setting) { return setting.contact != ContactModel::kRigid; }

using Lines = std::vector<std::string>;

std::string joined(const Lines& lines) {
  return lines.empty() ? "" : fmt::format("{}\n", fmt::join(lines, "\n"));
}

// The places of a table and of a key in it: numbers of lines from 1, 0 if absent. end: the last
// line of the table's last key, or its header.
struct Place {
  std::size_t table = 0, key = 0, end = 0;
};
Place place_of(const Lines& lines, const KeyValue& entry) {
  std::vector<scene::Diagnostic> none;
  const auto root = scene::parse_toml(joined(lines), "", none);
  const scene::TomlNode* table = root ? root->find(entry.table) : nullptr;
  if (!table) return {};
  const auto line = [](const scene::TomlNode* node) {
    return node ? static_cast<std::size_t>(node->line) : 0;
  };
  Place place{line(table), line(table->find(entry.key)), line(table)};
  for (const auto& [name, value] : table->entries) place.end = std::max(place.end, line(&value));
  // A value may continue on further lines.
  const auto is_value = [](std::string_view text) {
    return !text.empty() && text.front() != '#' && text.front() != '[';
  };
  while (place.end < lines.size() && is_value(trimmed(lines[place.end]))) ++place.end;
  return place;
}

void put(Lines& lines, const KeyValue& entry) {
  const std::string text = entry.key + " = " + entry.value;
  const bool wanted = !entry.is_default && !entry.value.empty();
  const Place place = place_of(lines, entry);
  const auto at = [&](std::size_t k) { return lines.begin() + static_cast<std::ptrdiff_t>(k); };
  if (place.key > 0 && entry.value.empty()) {
    lines.erase(at(place.key - 1));
  } else if (place.key > 0) {
    // No value of these keys contains a #.
    std::string& line = lines[place.key - 1];
    const std::size_t comment = line.find('#');
    line = text + (comment == std::string::npos ? "" : "  " + line.substr(comment));
  } else if (wanted && place.table > 0) {
    lines.insert(at(place.end), text);
  } else if (wanted) {
    if (!lines.empty() && !trimmed(lines.back()).empty()) lines.emplace_back();
    lines.insert(lines.end(), {"[" + entry.table + "]", text});
  }
}

bool reads_as(const std::string& toml, const std::string& name, const Setting& setting) {
  try {
    const scene::Scene scene = scene::parse_scene(toml, name);
    return scene.run.step == setting.step && scene.mujoco.contact == setting.contact &&
           scene.run.integrator == scene::Integrator::kEvent &&
           scene.mujoco.integrator == setting.integrator &&
           (!is_soft(setting) || (scene.mujoco.solver == setting.solver &&
                                  scene.mujoco.solref_stiffness == setting.stiffness));
  } catch (const scene::SceneError&) {
    return false;
  }
}

// As TOML values, including run.step.
std::vector<KeyValue> key_values(const Setting& s) {
  const Setting plain;
  const auto word = [](const char* name) { return fmt::format("\"{}\"", name); };
  std::vector<KeyValue> all{
      {"run", "step", fmt::format("{}", s.step)},
      {"mujoco", "contact", word(scene::to_string(s.contact))},
      {"mujoco", "integrator", word(to_string(s.integrator)), s.integrator == plain.integrator}};
  if (!is_soft(s)) return all;
  all.push_back({"mujoco", "solver", word(to_string(s.solver)), s.solver == plain.solver});
  const auto number = [&](const char* key, double value) {
    all.push_back(
        {"mujoco", key, value > 0.0 ? fmt::format("{:.17g}", value) : std::string(), value == 0.0});
  };
  number("solref_stiffness", s.stiffness);
  number("solref_damping", s.damping);
  if (s.contact == ContactModel::kCone) number("friction_reference", s.friction_reference);
  return all;
}

}  // namespace

const char* to_string(MujocoIntegrator integrator) {
  constexpr const char* kWords[] = {"euler", "implicit", "rk4"};
  return kWords[static_cast<int>(integrator)];
}

const char* to_string(MujocoSolver solver) {
  constexpr const char* kWords[] = {"newton", "cg", "pgs"};
  return kWords[static_cast<int>(solver)];
}

std::string text(const Setting& s) {
  const Setting plain;
  std::string text = scene::to_string(s.contact);
  if (s.integrator != plain.integrator) text += fmt::format(", {}", to_string(s.integrator));
  if (s.solver != plain.solver) text += fmt::format(", {}", to_string(s.solver));
  if (s.stiffness > 0.0) text += fmt::format(", K {:g}", s.stiffness);
  if (s.damping > 0.0) text += fmt::format(", B {:g}", s.damping);
  if (s.friction_reference > 0.0) text += fmt::format(", B_t {:g}", s.friction_reference);
  if (s.step > 0.0) text += ", " + time_text(s.step);
  return text;
}

std::vector<std::string> overrides(const Setting& setting) {
  std::vector<std::string> all;
  for (const KeyValue& entry : key_values(setting)) {
    if (entry.table == "run") continue;
    all.push_back(override_of(entry));
  }
  return all;
}

std::vector<Setting> variants(const scene::Mujoco& own) {
  std::vector<Setting> all;
  const auto add = [&](const Setting& setting) {
    if (std::find(all.begin(), all.end(), setting) == all.end()) all.push_back(setting);
  };
  add({ContactModel::kRigid});
  add({ContactModel::kRigid, MujocoIntegrator::kImplicit});
  for (const auto& [contact, word] : scene::kContactModels) {
    if (!is_soft({contact})) continue;
    add({contact});
    add({contact, MujocoIntegrator::kImplicit});
    add({contact, MujocoIntegrator::kEuler, MujocoSolver::kCg});
    add({contact, MujocoIntegrator::kEuler, MujocoSolver::kPgs});
    for (const double stiffness : kStiffnesses) {
      add({contact, MujocoIntegrator::kEuler, MujocoSolver::kNewton, stiffness});
    }
    for (const double damping : kDampings) {
      add({.contact = contact, .stiffness = kDampedStiffness, .damping = damping});
    }
  }
  for (const double reference : kFrictionReferences) {
    add({.contact = ContactModel::kCone, .friction_reference = reference});
  }
  Setting scenes{own.contact, own.integrator,    own.solver, own.solref_stiffness,
                 0.0,         own.solref_damping};
  if (own.contact == ContactModel::kCone) scenes.friction_reference = own.friction_reference;
  if (!is_soft(scenes)) scenes = {own.contact, own.integrator};
  add(scenes);
  return all;
}

std::string with_values(const std::string& toml, const std::vector<KeyValue>& values) {
  Lines lines;
  std::istringstream in(toml);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  for (const KeyValue& entry : values) put(lines, entry);
  return joined(lines);
}

TunedText tuned_text(const std::string& toml, const std::string& name, const Setting& setting,
                     const std::vector<std::string>& libraries) {
  std::vector<KeyValue> values = key_values(setting);
  values.push_back({"run", "integrator", "\"event\"", true});
  for (const std::string& library : libraries) {
    const std::string key = scene::override_key(library);
    const std::size_t dot = key.rfind('.');
    values.push_back({key.substr(0, dot), key.substr(dot + 1),
                      nlohmann::json(library.substr(key.size() + 1)).dump()});
  }
  TunedText tuned{with_values(toml, values)};
  if (reads_as(tuned.text, name, setting)) return tuned;
  std::vector<std::string> further;
  for (const KeyValue& v : values) further.push_back(override_of(v));
  return {scene::parse_scene(toml, name, further).text, false};
}

}  // namespace rotorub::tune
