#include "compare/tune/setting.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/base/format.h"
#include "compare/engine/engine.h"

namespace rotorub::tune {
namespace {

using scene::ContactModel;
using scene::MujocoIntegrator;
using scene::MujocoSolver;

bool is_soft(const Setting& setting) { return setting.contact != ContactModel::kRigid; }

}  // namespace

const char* to_string(MujocoIntegrator integrator) {
  switch (integrator) {
    case MujocoIntegrator::kEuler:
      return "euler";
    case MujocoIntegrator::kImplicit:
      return "implicit";
    case MujocoIntegrator::kRk4:
      return "rk4";
  }
  return "";
}

const char* to_string(MujocoSolver solver) {
  switch (solver) {
    case MujocoSolver::kNewton:
      return "newton";
    case MujocoSolver::kCg:
      return "cg";
    case MujocoSolver::kPgs:
      return "pgs";
  }
  return "";
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

std::vector<std::string> overrides(const Setting& setting) {
  std::vector<std::string> all;
  for (const KeyValue& entry : key_values(setting)) {
    if (entry.table == "run") continue;
    all.push_back(fmt::format("{}.{}={}", entry.table, entry.key,
                              entry.value.empty() ? "none" : entry.value));
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

}  // namespace rotorub::tune
