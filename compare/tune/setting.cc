#include "compare/tune/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string_view>

#include "compare/base/format.h"
#include "compare/engine/engine.h"
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

// Start of a comment outside of strings; npos: none.
std::size_t comment_of(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote == '"' && c == '\\') {
      ++i;
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      return i;
    }
  }
  return std::string_view::npos;
}

std::string_view without_comment(std::string_view line) {
  return trimmed(line.substr(0, comment_of(line)));
}

bool is_header(std::string_view line) { return trimmed(line).starts_with('['); }

using Lines = std::vector<std::string>;

// The lines of a table without its header.
struct Table {
  std::size_t first = 0, last = 0;
};
std::optional<Table> find_table(const Lines& lines, const std::string& name) {
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (without_comment(lines[k]) != "[" + name + "]") continue;
    Table table{k + 1, k + 1};
    while (table.last < lines.size() && !is_header(lines[table.last])) ++table.last;
    return table;
  }
  return std::nullopt;
}

std::optional<std::size_t> find_key(const Lines& lines, const Table& table,
                                    const std::string& key) {
  for (std::size_t k = table.first; k < table.last; ++k) {
    const std::string_view line = without_comment(lines[k]);
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos && trimmed(line.substr(0, equals)) == key) return k;
  }
  return std::nullopt;
}

void put(Lines& lines, const KeyValue& entry) {
  const std::string text = entry.key + " = " + entry.value;
  const bool wanted = !entry.is_default && !entry.value.empty();
  auto table = find_table(lines, entry.table);
  if (!table) {
    if (!wanted) return;
    if (!lines.empty() && !trimmed(lines.back()).empty()) lines.emplace_back();
    lines.push_back("[" + entry.table + "]");
    lines.push_back(text);
    return;
  }
  const auto at = [](std::size_t k) { return static_cast<std::ptrdiff_t>(k); };
  if (const auto line = find_key(lines, *table, entry.key)) {
    if (entry.value.empty()) {
      lines.erase(lines.begin() + at(*line));
      return;
    }
    const std::size_t comment = comment_of(lines[*line]);
    lines[*line] = text + (comment == std::string::npos ? "" : "  " + lines[*line].substr(comment));
    return;
  }
  // After the last line of the table with content; the lines that follow may belong to the next
  // table.
  std::size_t end = table->first;
  for (std::size_t k = table->first; k < table->last; ++k) {
    if (!without_comment(lines[k]).empty()) end = k + 1;
  }
  if (wanted) lines.insert(lines.begin() + at(end), text);
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
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

TunedText tuned_text(const std::string& toml, const std::string& name, const Setting& setting) {
  std::vector<KeyValue> values = key_values(setting);
  values.push_back({"run", "integrator", "\"event\"", true});
  TunedText tuned{with_values(toml, values)};
  if (reads_as(tuned.text, name, setting)) return tuned;
  std::vector<std::string> further;
  for (const KeyValue& v : values) further.push_back(override_of(v));
  return {scene::parse_scene(toml, name, further).text, false};
}

}  // namespace rotorub::tune
