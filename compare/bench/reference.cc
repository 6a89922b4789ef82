#include "compare/bench/reference.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "compare/bench/engines.h"
#include "native_model/oracles/annular_rub.h"
#include "native_model/oracles/bounces.h"
#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::bench {
namespace {

using Place = std::complex<double>;

// A closed form at one instant.
struct Exact {
  Place rotor, stator;  // m
  double normal = 0.0;  // N, in lasting contact
};
struct Form {
  std::string name;
  std::function<Exact(double)> at;
};

double first(const std::vector<double>& list) { return list.empty() ? 0.0 : list.front(); }
Place start(const scene::Initial& i) { return {first(i.x), first(i.y)}; }
Place start_velocity(const scene::Initial& i) { return {first(i.vx), first(i.vy)}; }
Place of(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }

// Whether the scene has one isotropic mode, a contact, and no part that the closed forms do not
// cover.
bool is_plain(const scene::Scene& s) {
  if (!s.rotor.modal || !s.has_contact() || s.auxiliary.size() > 1) return false;
  const scene::RotorModal& m = *s.rotor.modal;
  const scene::AuxiliaryBearing& bearing = s.first();
  const scene::Contact& contact = *bearing.contact;
  const bool one_mode = m.mass.size() == 1 && m.mass == m.mass_y && m.stiffness == m.stiffness_y &&
                        m.damping == m.damping_y && first(m.internal_damping) == 0.0 &&
                        first(m.gyroscopic) == 0.0;
  const bool turning_ring = bearing.stator && bearing.stator->spin;
  return one_mode && !turning_ring && contact.offset.isZero(0.0) && !s.rotor.torsion && !s.drive &&
         s.magnetic_bearings.empty() && !bearing.actuator && !bearing.controller && !s.gravity &&
         !s.base && contact.compression_time == 0.0 && contact.expansion_time == 0.0 &&
         contact.tangential_restitution == 0.0;
}

bool is_free_mass(const scene::Scene& s) {
  const scene::RotorModal& m = *s.rotor.modal;
  return first(m.stiffness) == 0.0 && first(m.damping) == 0.0 && !s.first().stator &&
         s.first().contact->friction.is_frictionless();
}

bool acts_throughout(const scene::Force& f, double end) {
  const bool unshaped = f.shape.empty() || f.shape.front() == 1.0;
  return f.on <= 0.0 && f.off >= end && f.ramp == 0.0 && unshaped;
}

std::optional<Form> billiard(const scene::Scene& s) {
  const Place v = start_velocity(s.initial);
  if (!is_free_mass(s) || !s.forces.empty() || s.first().contact->restitution != 1.0 ||
      v == Place())
    return {};
  const Place x = start(s.initial);
  const oracle::Billiard exact(s.first().contact->clearance, {x.real(), x.imag()},
                               {v.real(), v.imag()});
  return Form{"elastic billiard in a circle", [exact](double t) {
                return Exact{of(exact.position(t)), {}, 0.0};
              }};
}

// A fall from rest at the centre along a constant force, in any direction.
std::optional<Form> drop(const scene::Scene& s) {
  if (!is_free_mass(s) || s.forces.size() != 1 || s.first().contact->restitution >= 1.0) return {};
  const scene::Force& f = s.forces.front();
  if (f.kind != scene::ForceKind::kConstant || !acts_throughout(f, s.run.end)) return {};
  if (f.vector.norm() == 0.0) return {};
  if (start(s.initial) != Place() || start_velocity(s.initial) != Place()) return {};
  const double load = f.vector.norm();
  const Place down = of(f.vector) / load;
  const oracle::Drop exact{s.first().contact->clearance, load / first(s.rotor.modal->mass),
                           s.first().contact->restitution};
  return Form{"drop with restitution, to rest", [=](double t) {
                const double rest = t >= exact.rest_time() ? 1.0 : 0.0;
                return Exact{(exact.height - exact.height_at(t)) * down, {}, rest * load};
              }};
}

// The start must lie on the rub within the digits of a file.
bool same(Place a, Place b, double size) { return std::abs(a - b) <= 1e-12 * size; }

std::optional<Form> annular(const scene::Scene& s) {
  if (s.forces.size() != 1) return {};
  const scene::Force& f = s.forces.front();
  if (f.kind != scene::ForceKind::kRotating || !acts_throughout(f, s.run.end)) return {};
  if (f.phase != 0.0 || f.amplitude <= 0.0) return {};
  const scene::RotorModal& m = *s.rotor.modal;
  const oracle::Support rotor{first(m.mass), first(m.damping), first(m.stiffness)};
  const scene::Contact& c = *s.first().contact;
  const double mu = c.friction.at(c.radius * s.rotor.speed + c.clearance * f.frequency);
  std::optional<oracle::AnnularRub> rub;
  const scene::Stator ring = s.first().stator.value_or(scene::Stator{});
  if (!s.first().stator) {
    rub = oracle::annular_rub(rotor, c.clearance, mu, f.amplitude, f.frequency);
  } else {
    const scene::Stator& r = *s.first().stator;
    if (r.mass.x() != r.mass.y() || r.damping.x() != r.damping.y() ||
        r.stiffness.x() != r.stiffness.y()) {
      return {};
    }
    rub = oracle::annular_rub(rotor, {r.mass.x(), r.damping.x(), r.stiffness.x()}, c.clearance, mu,
                              f.amplitude, f.frequency);
  }
  if (!rub || c.radius * s.rotor.speed + c.clearance * f.frequency <= 0.0) return {};
  const double size = std::abs(rub->rotor), rate = f.frequency;
  const Place turn{0.0, rate};
  const bool starts_on = same(start(s.initial), rub->rotor, size) &&
                         same(start_velocity(s.initial), turn * rub->rotor, rate * size) &&
                         same(of(ring.position), rub->stator, size) &&
                         same(of(ring.velocity), turn * rub->stator, rate * size);
  if (!starts_on) return {};
  return Form{"synchronous full annular rub", [rub = *rub, rate](double t) {
                const Place phase = std::polar(1.0, rate * t);
                return Exact{rub.rotor * phase, rub.stator * phase, rub.force};
              }};
}

std::optional<Form> closed_form(const scene::Scene& scene) {
  if (!is_plain(scene)) return {};
  for (const auto& form : {billiard(scene), drop(scene), annular(scene)}) {
    if (form) return form;
  }
  return {};
}

// m: some units in the last place of positions of about 1 mm.
constexpr double kClosedFormRoundOff = 1e-17;

Trajectory run_event(const scene::Scene& scene, const RunRequest& request, double tolerance) {
  Trajectory t = event_engine(event_parameters(tolerance))->run(scene, request);
  if (t.status != Status::kOk && t.status != Status::kInterrupted) {
    throw std::runtime_error(fmt::format("{}: no reference: event at tolerance {:g}: {}: {}",
                                         scene.name, tolerance, to_string(t.status), t.message));
  }
  return t;
}

}  // namespace

std::string put_closed_form(const scene::Scene& scene, Trajectory& trajectory) {
  const auto form = closed_form(scene);
  if (!form) return {};
  const std::vector<double> times = trajectory.column("t");
  for (Column& column : trajectory.series) {
    const auto put = [&](const auto& value) {
      for (std::size_t k = 0; k < times.size(); ++k) column.values[k] = value(form->at(times[k]));
    };
    if (column.name == "rotor_x") put([](const Exact& e) { return e.rotor.real(); });
    if (column.name == "rotor_y") put([](const Exact& e) { return e.rotor.imag(); });
    if (column.name == "stator_x") put([](const Exact& e) { return e.stator.real(); });
    if (column.name == "stator_y") put([](const Exact& e) { return e.stator.imag(); });
    if (column.name == "normal_force") put([](const Exact& e) { return e.normal; });
  }
  return form->name;
}

std::vector<double> common_times(const scene::Run& run, const std::vector<double>& steps) {
  constexpr double kNano = 1e-9;   // s
  constexpr double kWhole = 1e-6;  // tolerance for whole numbers
  std::int64_t common = 1;
  for (const double step : steps) {
    const double nanos = step / kNano;
    const bool whole = nanos > 0.5 && std::abs(nanos - std::round(nanos)) < kWhole * nanos;
    if (!whole || static_cast<double>(common) > run.end / kNano) return output_times(run);
    common = std::lcm(common, static_cast<std::int64_t>(std::llround(nanos)));
  }
  const double least = static_cast<double>(common) * kNano;
  if (run.end / least < kFewestRows) return output_times(run);
  // The end is included as a row if possible.
  const double most = std::max(1.0, std::ceil(run.end / kMostRows / least - kWhole));
  const auto ends_at_the_end = [&](double factor) {
    const double rows = run.end / (factor * least);
    return std::abs(rows - std::round(rows)) < kWhole;
  };
  double factor = most;
  while (factor < 2.0 * most && !ends_at_the_end(factor)) factor += 1.0;
  const double spacing = least * (ends_at_the_end(factor) ? factor : most);
  std::vector<double> times;
  const auto count = static_cast<std::int64_t>(std::floor(run.end / spacing * (1.0 + 1e-12)));
  for (std::int64_t k = 0; k <= count; ++k) times.push_back(static_cast<double>(k) * spacing);
  times.back() = std::min(times.back(), run.end);
  return times;
}

double position_distance(const Trajectory& a, const Trajectory& b) {
  assert(a.rows() == b.rows());
  assert(a.contacts == b.contacts);
  double largest = 0.0;
  for (std::size_t contact = 0; contact < a.contacts; ++contact) {
    for (const char* body : {"rotor", "stator"}) {
      const std::string name = column_of_contact(contact, body);
      const auto &ax = a.column(name + "_x"), &ay = a.column(name + "_y");
      const auto &bx = b.column(name + "_x"), &by = b.column(name + "_y");
      for (std::size_t k = 0; k < ax.size(); ++k) {
        largest = std::max(largest, std::hypot(ax[k] - bx[k], ay[k] - by[k]));
      }
    }
  }
  return largest;
}

Reference make_reference(const scene::Scene& scene, const RunRequest& request) {
  Reference r;
  r.trajectory = run_event(scene, request, kReferenceTolerance);
  r.times = r.trajectory.column("t");
  const Trajectory event = r.trajectory;
  const std::string form = put_closed_form(scene, r.trajectory);
  if (!form.empty()) {
    r.source = "closed form: " + form;
    r.event_distance = position_distance(event, r.trajectory);
    r.error = kClosedFormRoundOff;
    return r;
  }
  r.source = fmt::format("event at tolerance {:g}", kReferenceTolerance);
  for (const double factor : {3.0, 10.0}) {
    const Trajectory looser = run_event(scene, request, factor * kReferenceTolerance);
    if (looser.rows() != event.rows()) return r;  // interrupted
    r.error = std::max(r.error, position_distance(event, looser));
  }
  return r;
}

}  // namespace rotorub::bench
