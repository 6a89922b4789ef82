#include "native_model/model/model_checks.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "native_model/bearing/actuator.h"
#include "native_model/model/dynamics.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

constexpr double kRoundOff = 1e-12;  // relative, in sums over modes and discs

// The key of the scene that sets the number of bending modes.
const char* modes_key(const scene::Rotor& rotor) {
  if (!rotor.geometry) return "rotor.modal.mass";
  return rotor.geometry->max_frequency ? "rotor.max_frequency" : "rotor.modes";
}

// The value for the unbalances that exist at t (s); see the header.
double unbalance_inertia(const Model& model, double t) {
  using Complex = std::complex<double>;
  const Layout& l = model.layout;
  double mean = 0.0;
  Complex swing = 0.0;
  for (int k = 0; k < l.modes; ++k) {
    Complex x = 0.0, y = 0.0;
    for (const DiscUnbalance& u : model.unbalances) {
      if (u.on > t) continue;
      const Complex arm = std::polar(u.static_moment, u.phase);
      x += u.shape.x[k] * arm;
      y += u.shape.y[k] * arm;
    }
    const double mx = model.mass[l.x() + k], my = model.mass[l.y() + k];
    mean += 0.5 * (std::norm(x) / mx + std::norm(y) / my);
    swing += 0.5 * (y * y / my - x * x / mx);
  }
  return mean + std::abs(swing);
}

void refuse_any(const scene::Scene& scene, std::vector<scene::Diagnostic> wrong) {
  if (!wrong.empty()) throw scene::SceneError(scene::placed(scene, std::move(wrong)));
}

std::string rough_text(double number) { return scene::number_text(number, 3); }

// Columns of a row; commands and currents are left out because they are few.
double columns(const Model& model) {
  const Layout& l = model.layout;
  return 17.0 + 4.0 * l.modes + 2.0 * (l.torsion + l.ring_spin);
}

double rows(const scene::Run& run) {
  return run.end / run.series_step() + static_cast<double>(run.output_times.size());
}

// For example "1e+11 steps to run.end = 10 s are too many; the limit is 1e+10": count, what, most.
std::string too_many(const scene::Run& run, double count, const std::string& what, double most) {
  return rough_text(count) + what + " to run.end = " + rough_text(run.end) +
         " s are too many; the limit is " + rough_text(most);
}

void find_steps(const scene::Run& run, double step, std::vector<scene::Diagnostic>& wrong) {
  const double count = run.end / step;
  if (count <= kMostRunSteps) return;
  wrong.push_back({"", 0, "run.step",
                   too_many(run, count, " steps of " + rough_text(step) + " s", kMostRunSteps) +
                       " steps, of " + rough_text(run.end / kMostRunSteps) + " s or more"});
}

void find_samples(const scene::Scene& scene, std::vector<scene::Diagnostic>& wrong) {
  const auto look = [&](const std::string& key, double time) {
    const double count = scene.run.end / time;
    if (!(time > 0.0) || count <= kMostRunSteps) return;
    wrong.push_back({"", 0, key + "sample_time",
                     too_many(scene.run, count, " samples", kMostRunSteps) + " samples, one in " +
                         rough_text(scene.run.end / kMostRunSteps) + " s"});
  };
  const bool several = scene.auxiliary.size() > 1;
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& controller = scene.auxiliary[k].controller;
    if (!controller) continue;
    look((several ? scene::list_element("contact", k) + "." : std::string()) + "controller.",
         controller->sample_time);
  }
  for (std::size_t k = 0; k < scene.magnetic_bearings.size(); ++k) {
    const auto& control = scene.magnetic_bearings[k].control;
    if (!control) continue;
    look(scene::magnetic_bearing_path(scene, k) + ".control.", control->sample_time);
  }
  if (scene.magnetic_control) look("magnetic_control.", scene.magnetic_control->sample_time);
}

// An integrator with adaptive steps resolves every turn of a load.
void find_turns(const scene::Scene& scene, std::vector<scene::Diagnostic>& wrong) {
  const auto look = [&](const std::string& key, double frequency, double from, double to) {
    const double turns = std::abs(frequency) * (std::min(to, scene.run.end) - std::max(from, 0.0)) /
                         (2.0 * std::numbers::pi);
    if (!(turns > kMostRunSteps)) return;
    wrong.push_back({"", 0, key, too_many(scene.run, turns, " turns", kMostRunSteps)});
  };
  for (std::size_t k = 0; k < scene.forces.size(); ++k) {
    const scene::Force& f = scene.forces[k];
    const std::string path = scene::list_element("force", k);
    if (f.kind == scene::ForceKind::kRotating) look(path + ".frequency", f.frequency, f.on, f.off);
    if (f.kind == scene::ForceKind::kChirp)
      look(path + ".frequency_end", f.frequency_end, f.on, f.off);
  }
}

void find_rows(const scene::Run& run, const Model& model, const std::vector<double>* times,
               std::vector<scene::Diagnostic>& wrong) {
  const double count = times ? static_cast<double>(times->size()) : rows(run);
  const double most = std::floor(kMostSeriesValues / columns(model));
  if (count <= most) return;
  const char* key =
      run.output_step || run.output_times.empty() ? "run.output_step" : "run.output_times";
  const std::string what = " rows of " + rough_text(columns(model)) + " columns";
  wrong.push_back(
      {"", 0, key,
       too_many(run, count, what, most) + " rows, one in " + rough_text(run.end / most) + " s"});
}

}  // namespace

void check_size(const scene::Scene& scene, int nq) {
  if (nq <= kMaxCoordinates) return;
  scene::refuse_at(scene, modes_key(scene.rotor),
                   "is too large: " + std::to_string(nq) +
                       " coordinates or more, two for each bending mode; the limit is " +
                       std::to_string(kMaxCoordinates) +
                       " in all (bending, torsion, spin and ring)");
}

void check_unbalances(const scene::Scene& scene, std::size_t count) {
  if (count <= kMaxUnbalances) return;
  scene::refuse_at(scene, "rotor.disc",
                   std::to_string(count) + " eccentric discs are too many; the limit is " +
                       std::to_string(kMaxUnbalances));
}

double unbalance_inertia(const Model& model) {
  if (!model.coupled_mass()) return 0.0;
  double most = 0.0;
  for (const DiscUnbalance& u : model.unbalances) {
    most = std::max(most, unbalance_inertia(model, u.on));
  }
  return most;
}

void check_spin_inertia(const scene::Scene& scene, const Model& model) {
  if (!model.coupled_mass()) return;
  const double inertia = model.mass[model.layout.phi()], bound = unbalance_inertia(model);
  if (inertia > bound * (1.0 + kRoundOff)) return;
  const bool disc = model.unbalances.front().on < 0.0;
  scene::refuse_at(
      scene, disc ? "rotor.disc" : "force",
      "the eccentric discs move " + scene::number_text(bound) +
          " kg m^2 with the spin, whose inertia is " + scene::number_text(inertia) +
          " kg m^2: the mass matrix is not positive definite; give each disc a Jp of at least mass "
          "eccentricity^2, and shaft, discs and motor together more than " +
          scene::number_text(bound) + " kg m^2");
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
  refuse_any(scene, std::move(wrong));
}

void check_initial_gap(const scene::Scene& scene, const Model& model, std::size_t k) {
  const AuxiliaryBearing& at = model.auxiliary[k];
  if (!at.contact) return;
  const double* q = model.q0.data();
  const double delta = (separation(model, q, k)).norm();
  const double clearance = at.contact->clearance;
  constexpr double kTolerance = 1e-9;  // share of the clearance, for a start on the ring
  // With a compliant contact the start may be as deep as a run may go.
  const double reach = at.is_compliant() ? 2.0 * clearance : clearance;
  if (delta <= reach * (1.0 + kTolerance)) return;
  const Layout& l = model.layout;
  const bool steady = scene.initial.steady;  // sets a rotor position that no list states
  const auto listed = [&](const std::vector<double>& list, int row) {
    return !(steady && list.empty()) && !model.q0.segment(row, l.modes).isZero(0.0);
  };
  const char* key = listed(scene.initial.x, l.x())   ? "initial.x"
                    : listed(scene.initial.y, l.y()) ? "initial.y"
                    : at.moves() && !model.q0.segment<2>(at.ring).isZero(0.0)
                        ? (scene.auxiliary.size() > 1 ? "stator.position" : "initial.stator")
                    : steady ? "initial.steady"
                             : "contact.offset";
  scene::refuse_at(scene, k, key,
                   "the rotor starts outside the ring, " + scene::number_text(delta) +
                       " m from its centre; start it at most " +
                       (reach > clearance ? "twice " : "") +
                       scene::place_of(scene, "contact.clearance", k) + " = " +
                       scene::number_text(clearance) + " m");
}

void check_initial_ring(const scene::Scene& scene, std::size_t k) {
  const scene::AuxiliaryBearing& at = scene.auxiliary[k];
  if (!at.stator || !at.actuator || at.actuator->kind != scene::ActuatorKind::kElectromagnet)
    return;
  const double start = to_axes(at.stator->position).cwiseAbs().maxCoeff();
  if (start < at.actuator->air_gap) return;
  scene::refuse_at(
      scene, k, scene.auxiliary.size() > 1 ? "stator.position" : "initial.stator",
      "is " + scene::number_text(start) +
          " m along an axis of the actuator; it must be less than actuator.air_gap = " +
          scene::number_text(at.actuator->air_gap) + " m");
}

void refuse_compliance(const scene::Scene& scene, scene::Integrator integrator) {
  if (integrator != scene::Integrator::kEuler) return;
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    if (!scene.auxiliary[k].contact || !scene.auxiliary[k].contact->compliance) continue;
    scene::refuse_at(scene, k, "contact.compliance",
                     "`euler` supports only rigid contacts; remove contact.compliance, or use the "
                     "integrator event or verlet");
  }
}

void refuse_lag_with_several(const scene::Scene& scene, const Model& model) {
  for (std::size_t k = 0; model.auxiliary.size() > 1 && k < model.auxiliary.size(); ++k) {
    if (model.auxiliary[k].coil == kAbsent) continue;
    scene::refuse_at(scene, k, "actuator.coil_lag",
                     "with several contacts a coil_lag needs the integrator event; set 0 for "
                     "another integrator");
  }
}

void refuse_compliance_in_mujoco(const scene::Scene& scene) {
  if (!scene.is_compliant()) return;
  const scene::ContactModel model = scene.mujoco.contact;
  if (model == scene::ContactModel::kRigid || model == scene::ContactModel::kCone) {
    scene::refuse_at(
        scene, "mujoco.contact",
        std::string("\"") + scene::to_string(model) +
            "\" does not support contact.compliance; set \"coulomb\" or \"cone-coulomb\"");
  }
  if (scene.mujoco.shadow) {
    scene::refuse_at(scene, "mujoco.shadow",
                     "the shadow's contact is rigid; with contact.compliance set false");
  }
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    if (!scene.auxiliary[k].contact || scene.auxiliary[k].contact->compliance) continue;
    scene::refuse_at(scene, k, "contact",
                     "is rigid beside a compliant contact, which only the native engine can "
                     "simulate; for MuJoCo give all contacts [contact.compliance], or none");
  }
}

void refuse_several_in_mujoco(const scene::Scene& scene) {
  if (scene.auxiliary.size() < 2) return;
  if (scene.mujoco.rotor != scene::MujocoRotor::kSegments && scene::is_cone(scene.mujoco.contact)) {
    scene::refuse_at(scene, "mujoco.contact",
                     "MuJoCo's cone supports only one contact of the modal chain; for several set "
                     "\"rigid\" or \"coulomb\", or mujoco.rotor = \"segments\"");
  }
  if (scene.mujoco.shadow)
    scene::refuse_at(scene, "mujoco.shadow",
                     "the shadow has one contact; with several contacts set false");
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const bool driven = scene.auxiliary[k].actuator || scene.auxiliary[k].controller;
    if (!driven) continue;
    scene::refuse_at(scene, k, scene.auxiliary[k].actuator ? "actuator" : "controller",
                     "in MuJoCo the rings of several contacts are passive; remove this table");
  }
}

void refuse_finite_impacts(const scene::Scene& scene, FiniteImpacts accepted) {
  const bool sampled = std::ranges::any_of(scene.auxiliary, [](const auto& at) {
    return at.controller && at.controller->sample_time > 0.0;
  });
  const bool asked = std::ranges::any_of(
      scene.magnetic_bearings, [](const auto& at) { return at.control && at.control->sampled(); });
  const bool knows = accepted == FiniteImpacts::kUnsampled;
  if (knows && !sampled && !asked) return;
  const auto check = [&](std::size_t k, const char* key, double time) {
    if (time <= 0.0) return;
    scene::refuse_at(scene, k, key,
                     knows ? "impacts of finite duration under a sampled controller need the "
                             "integrator event; set 0, or remove the controller's sample_time"
                           : "impacts of finite duration need the integrator event or verlet, or "
                             "in MuJoCo the contact model rigid on a modal chain without a shadow "
                             "and without a coil_lag; otherwise set 0");
  };
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& contact = scene.auxiliary[k].contact;
    if (!contact) continue;
    check(k, "contact.compression_time", contact->compression_time);
    check(k, "contact.expansion_time", contact->expansion_time);
  }
}

void check_steps(const scene::Scene& scene, double fixed_step) {
  std::vector<scene::Diagnostic> wrong;
  find_steps(scene.run, fixed_step, wrong);
  find_samples(scene, wrong);
  refuse_any(scene, std::move(wrong));
}

void check_run_size(const scene::Scene& scene, const Model& model, std::optional<double> fixed_step,
                    const std::vector<double>* times) {
  std::vector<scene::Diagnostic> wrong;
  if (fixed_step) {
    find_steps(scene.run, *fixed_step, wrong);
  } else {
    find_turns(scene, wrong);
  }
  find_samples(scene, wrong);
  find_rows(scene.run, model, times, wrong);
  refuse_any(scene, std::move(wrong));
}

}  // namespace rotorub
