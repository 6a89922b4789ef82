#include "native_model/periodic/periodic_rub.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "native_model/model/dynamics.h"
#include "native_model/model/linear_parts.h"

namespace rotorub::periodic {
namespace {

std::string kind_of(const Model& m, const PeriodicRub& rub) {
  constexpr double kWhole = 1e-6, kSameTurns = 1e-3;
  const ContactFigures& f = rub.figures[rub.contact];
  const PeriodicMotion& motion = rub.settled.motion;
  const bool touches = std::ranges::any_of(
      rub.figures, [](const auto& of) { return of.impacts > 0 || of.contact_share > 0.0; });
  if (!touches) return "no contact";
  if (f.impacts > 0) return "bouncing";
  const double turns = f.whirl * motion.period / (2.0 * std::numbers::pi);
  const bool goes_around = std::abs(turns) > 0.5;
  if (f.stuck_share > 1.0 - kWhole) return goes_around ? "rolling" : "sticking";
  if (f.stuck_share > kWhole) return "stick-slip";
  if (!goes_around) return "rub on one side";
  const auto goes_with = [&](double speed) {
    return std::abs(turns - speed * motion.period / (2.0 * std::numbers::pi)) < kSameTurns;
  };
  const bool is_driven = std::ranges::any_of(m.forces, [&](const AppliedForce& force) {
    return force.kind == scene::ForceKind::kRotating && goes_with(force.frequency);
  });
  if (is_driven || goes_with(rub.spin)) return "synchronous rub";
  if (turns * rub.spin < 0.0) return "backward whip";
  return std::lround(std::abs(turns)) == rub.settled.order ? "synchronous rub" : "forward whirl";
}

}  // namespace

PeriodicRub periodic_rub(const Model& m, SettledMotion settled) {
  PeriodicRub rub;
  PeriodFigures figures = period_figures(m, settled.motion);
  rub.figures = std::move(figures.contacts);
  rub.passes = std::move(figures.passes);
  rub.spin = spin_speed(m, settled.motion.start.v.data());
  rub.settled = std::move(settled);
  rub.contact = static_cast<std::size_t>(
      std::ranges::max_element(rub.figures, {}, &ContactFigures::mean_force) - rub.figures.begin());
  rub.kind = kind_of(m, rub);
  return rub;
}

double PeriodicRub::largest_multiplier() const {
  const auto& all = settled.motion.multipliers;
  return all.empty() ? 0.0 : std::abs(all.front());
}

std::optional<State> backward_whirl(const Model& m) {
  constexpr double kOfClearance = 0.98, kOfRing = 0.35;  // of the clearance: rotor in ring, ring
  constexpr double kOfFrequency = 1.4, kLeastShape = 1e-6;
  const Layout& l = m.layout;
  const AuxiliaryBearing& at = m.first();
  const bool drags = at.contact && at.contact->friction.sticking() > 0.0;
  if (m.speed == 0.0 || l.modes == 0 || !drags) return {};
  const double shape_x = at.shape.x[0], shape_y = at.shape.y[0];
  if (std::min(std::abs(shape_x), std::abs(shape_y)) < kLeastShape) return {};
  const LinearParts parts = linear_parts(m, m.speed);
  const double pace = kOfFrequency * std::sqrt(parts.stiffness(0, 0) / parts.mass[0]);
  if (!(pace > 0.0)) return {};
  const double backward = m.speed > 0.0 ? -pace : pace, clearance = at.contact->clearance;
  State state = initial_state(m);
  const Eigen::Index bending = 2 * l.modes;
  state.q.head(bending).setZero();
  state.v.head(bending).setZero();
  double ring = 0.0;  // m, from its place at rest
  if (at.moves()) {
    ring = kOfRing * clearance;
    state.q.segment<2>(at.ring) = Eigen::Vector2d(ring, 0.0);
    state.v.segment<2>(at.ring) = Eigen::Vector2d(0.0, backward * ring);
  }
  const double reach = kOfClearance * clearance;
  const Eigen::Vector2d away = Eigen::Vector2d(reach, 0.0) - separation(m, state.q.data());
  state.q[l.x()] = away.x() / shape_x;
  state.q[l.y()] = away.y() / shape_y;
  state.v[l.y()] = backward * (ring + reach) / shape_y;
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const auto& contact = m.auxiliary[k].contact;
    if (contact && separation(m, state.q.data(), k).norm() > contact->clearance) return {};
  }
  return state;
}

}  // namespace rotorub::periodic
