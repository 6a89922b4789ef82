#include "native_model/system/model_checks.h"

#include <cstdio>
#include <utility>

#include "native_model/bearing/actuator_axes.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {
namespace {

std::string text(double number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", number);
  return buffer;
}

// The part of the scene that sets how many bending modes there are.
const char* modes_key(const scene::Rotor& rotor) {
  if (!rotor.geometry) return "rotor.modal.mass";
  return rotor.geometry->modes ? "rotor.modes" : "rotor.max_frequency";
}

}  // namespace

void refuse(const scene::Scene& scene, std::vector<scene::Diagnostic> diagnostics) {
  for (scene::Diagnostic& d : diagnostics) {
    if (!scene.name.empty()) d.file = scene.name + ".toml";
  }
  throw scene::SceneError(std::move(diagnostics));
}

void check_size(const scene::Scene& scene, int nq) {
  if (nq <= kMaxCoordinates) return;
  refuse(scene, {{"", 0, modes_key(scene.rotor),
                  "gives " + std::to_string(nq) + " coordinates or more; accepted: at most " +
                      std::to_string(kMaxCoordinates) +
                      ", of bending modes in both planes, torsion modes, spin and ring"}});
}

void check_unbalances(const scene::Scene& scene, std::size_t count) {
  if (count <= kMaxUnbalances) return;
  refuse(scene, {{"", 0, "rotor.disc",
                  std::to_string(count) + " eccentric discs; accepted: at most " +
                      std::to_string(kMaxUnbalances)}});
}

void check_initial_lists(const scene::Scene& scene, const Layout& l) {
  std::vector<scene::Diagnostic> wrong;
  const auto check = [&](const char* key, const std::vector<double>& list, int length,
                         const char* of) {
    if (list.empty() || list.size() == static_cast<std::size_t>(length)) return;
    wrong.push_back({"", 0, key,
                     "expected " + std::to_string(length) + " value(s), one for each " + of +
                         " mode, got " + std::to_string(list.size())});
  };
  const scene::Initial& initial = scene.initial;
  check("initial.x", initial.x, l.modes, "bending");
  check("initial.y", initial.y, l.modes, "bending");
  check("initial.vx", initial.vx, l.modes, "bending");
  check("initial.vy", initial.vy, l.modes, "bending");
  check("initial.torsion", initial.torsion, l.torsion, "torsion");
  check("initial.torsion_speed", initial.torsion_speed, l.torsion, "torsion");
  if (!wrong.empty()) refuse(scene, std::move(wrong));
}

void check_initial_gap(const scene::Scene& scene, const Model& model) {
  if (!model.contact) return;
  const double* q = model.q0.data();
  const double delta = (rotor_point(model, q) - stator_point(model, q)).norm();
  const double clearance = model.contact->clearance;
  // On the ring is meant.
  constexpr double kTolerance = 1e-9;  // of the clearance
  if (delta <= clearance * (1.0 + kTolerance)) return;
  const Layout& l = model.layout;
  const char* key = !model.q0.segment(l.x(), l.modes).isZero(0.0)   ? "initial.x"
                    : !model.q0.segment(l.y(), l.modes).isZero(0.0) ? "initial.y"
                                                                    : "initial.stator";
  refuse(scene, {{"", 0, key,
                  "the rotor starts outside the ring, " + text(delta) +
                      " m from its centre; accepted: at most contact.clearance = " +
                      text(clearance) + " m"}});
}

void check_initial_ring(const scene::Scene& scene) {
  if (!scene.actuator || scene.actuator->kind != scene::ActuatorKind::kElectromagnet) return;
  const double start = to_axes(scene.initial.stator).cwiseAbs().maxCoeff();
  if (start < scene.actuator->air_gap) return;
  refuse(scene, {{"", 0, "initial.stator",
                  "is " + text(start) +
                      " m along an axis of the actuator; accepted: less than actuator.air_gap = " +
                      text(scene.actuator->air_gap) + " m"}});
}

}  // namespace rotorub
