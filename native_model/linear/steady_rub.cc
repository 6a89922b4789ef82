#include "native_model/linear/steady_rub.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "native_model/linear/rub_stability.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/root.h"

namespace rotorub::rub {
namespace {

double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

double slip_at(const RubSystem& s, double nu) { return s.radius * s.speed + s.clearance * nu; }

bool finite(const Complex& z) { return std::isfinite(z.real()) && std::isfinite(z.imag()); }

// Positions of rotor and ring under lambda (1 + i tau) and `load`, both in the rotating frame.
void place(const RubSystem& s, const Eigen::VectorXcd& load, SteadyRub& rub) {
  const Complex push = rub.normal_force * Complex(1.0, rub.friction);
  rub.rotor = response(s, rub.whirl, load - push * s.contact.cast<Complex>());
  rub.ring = s.ring ? push / ring_stiffness(s, rub.whirl) : Complex();
}

// For a rub computed as if the ring were at rest: sets the ring speed that friction sustains and
// the remaining slip. Returns false if no slip would remain, because the ring would catch up.
bool turn_ring(const RubSystem& s, SteadyRub& rub) {
  if (!s.ring_turns()) return true;
  if (s.ring->drag == 0.0) return false;
  const double before = rub.slip;
  rub.ring_speed = s.ring_radius() * rub.friction * rub.normal_force / s.ring->drag;
  rub.slip -= s.ring_radius() * rub.ring_speed;
  return rub.slip * before > 0.0;
}

// lambda >= 0 of |offset + lambda h| = reach, N, the larger first; offset and reach in m.
std::vector<double> forces_to(const Complex& offset, const Complex& h, double reach) {
  const double square = std::norm(h), half = (std::conj(offset) * h).real();
  // Written as (delta_0 - |a|)(delta_0 + |a|), so that no digits are lost when the free orbit
  // grazes.
  const double bent = std::abs(offset), constant = (bent - reach) * (bent + reach);
  const double discriminant = half * half - square * constant;
  if (!(discriminant >= 0.0) || !(square > 0.0)) return {};
  // First the root without cancellation; the other follows from the product of both.
  const double sum = -half - std::copysign(std::sqrt(discriminant), half);
  const double first = sum / square, second = sum != 0.0 ? constant / sum : 0.0;
  std::vector<double> forces{std::max(first, second), std::min(first, second)};
  if (forces[0] == forces[1]) forces.pop_back();
  std::erase_if(forces, [](double force) { return !(force >= 0.0); });
  return forces;
}

Complex at_contact(const RubSystem& s, const RotatingLoad& load) {
  return s.contact.cast<Complex>().dot(response(s, load.frequency, load.load));
}

}  // namespace

std::vector<double> resonance_points(const std::vector<Complex>& poles, double low, double top) {
  constexpr int kEven = 400;
  constexpr double kSharpest = 1e-9;  // half-width of an undamped resonance, relative
  std::vector<double> nu;
  for (int k = 0; k <= kEven; ++k) {
    nu.push_back(low * std::pow(top / low, static_cast<double>(k) / kEven));
  }
  for (const Complex& pole : poles) {
    const double centre = std::abs(pole.imag());
    const double width = std::max(std::abs(pole.real()), kSharpest * centre);
    if (!(width > 0.0)) continue;
    nu.push_back(centre);
    for (double step = 0.25 * width; step < top; step *= 2.0) {
      nu.push_back(centre - step);
      nu.push_back(centre + step);
    }
  }
  std::erase_if(nu, [&](double x) { return !(x >= low && x <= top); });
  std::sort(nu.begin(), nu.end());
  nu.erase(std::unique(nu.begin(), nu.end()), nu.end());
  return nu;
}

const char* to_string(RubKind kind) {
  constexpr std::array<const char*, 3> kNames{"forced", "whip", "rolling"};
  return kNames[static_cast<std::size_t>(kind)];
}

bool can_roll(const Complex& h, double mu) {
  return finite(h) && h.real() < 0.0 && std::abs(h.imag()) <= -mu * h.real();
}

double free_orbit(const RubSystem& system, const RotatingLoad& load) {
  const Complex a = at_contact(system, load);
  return finite(a) ? std::abs(a) : std::numeric_limits<double>::infinity();
}

std::vector<SteadyRub> forced_rubs(const RubSystem& s, const RotatingLoad& load) {
  std::vector<SteadyRub> rubs;
  const double slip = slip_at(s, load.frequency);
  const Complex a = at_contact(s, load);
  const Complex compliant = compliance(s, load.frequency);
  if (slip == 0.0 || !finite(a) || !finite(compliant)) return rubs;
  const auto add = [&](SteadyRub rub, const Complex& bent) {
    rub.direction = std::arg(a) - std::arg(bent);
    place(s, std::polar(1.0, -rub.direction) * load.load, rub);
    rubs.push_back(std::move(rub));
  };
  const double nu = load.frequency, tau = s.friction.at(slip) * sign(slip);
  const Complex h = Complex(1.0, tau) * compliant;
  for (const double force : forces_to(s.clearance, h, std::abs(a))) {
    SteadyRub rub{RubKind::kForced, nu, force, tau, slip, 0.0, {}, {}};
    if (turn_ring(s, rub)) add(std::move(rub), s.clearance + force * h);
  }
  if (!s.ring_turns()) return rubs;
  const double ring_speed = slip / s.ring_radius(),
               kappa = s.ring->drag * ring_speed / s.ring_radius();
  const Complex offset = s.clearance + kI * kappa * compliant;
  for (const double force : forces_to(offset, compliant, std::abs(a))) {
    if (!(force > 0.0) || std::abs(kappa) > s.friction.sticking() * force) continue;
    add({RubKind::kForced, nu, force, kappa / force, 0.0, 0.0, {}, {}, ring_speed},
        offset + force * compliant);
  }
  return rubs;
}

// --------------------------------------------------------------- whip and rolling, without load
BackwardCompliance::BackwardCompliance(const RubSystem& system)
    : system_(system), sense_(sign(system.speed)) {
  system_.forces.clear();
  system_.unbalance.setZero();
  if (sense_ == 0.0) return;
  constexpr double kBeyond = 20.0, kBelow = 1e-3;
  std::vector<Complex> poles = free_eigenvalues(system_);
  for (const Complex& pole : ring_eigenvalues(system_)) poles.push_back(pole);
  double highest = largest_size(poles), lowest = smallest_size(poles);
  if (!(highest > 0.0)) highest = lowest = std::abs(system_.speed);
  nu_ = resonance_points(poles, kBelow * lowest, std::max(rolling_pace(), kBeyond * highest));
  sample_with_extremes([this](double nu) { return asked(nu); }, nu_, asked_);
}

Complex BackwardCompliance::at(double nu) const {
  const Complex h = compliance(system_, -sense_ * nu);
  return sense_ > 0.0 ? h : std::conj(h);
}

double BackwardCompliance::asked(double nu) const {
  const Complex h = at(nu);
  return std::atan2(h.imag(), -h.real());
}

// Roots with Re H < 0 of a function that takes these values at nu.
std::vector<double> BackwardCompliance::roots(const std::function<double(double)>& f,
                                              const std::vector<double>& nu,
                                              const std::vector<double>& values) const {
  std::vector<double> all;
  for (std::size_t k = 0; k + 1 < nu.size(); ++k) {
    const double left = values[k], right = values[k + 1];
    if (!(left * right <= 0.0) || (left == 0.0 && k > 0) || (left == 0.0 && right == 0.0)) continue;
    const auto [lo, hi] = root(f, nu[k], nu[k + 1], left, right);
    const double found = 0.5 * (lo + hi);
    if (at(found).real() < 0.0) all.push_back(found);
  }
  return all;
}

std::vector<double> BackwardCompliance::edges(double mu) const {
  constexpr double kRoundOff = 1e-13;  // a fold this close to mu counts as its double root
  const double given = std::atan(mu);
  std::vector<double> excess;
  for (const double angle : asked_) {
    excess.push_back(std::abs(angle - given) <= kRoundOff * given ? 0.0 : angle - given);
  }
  return roots([&](double nu) { return asked(nu) - given; }, nu_, excess);
}

std::vector<double> BackwardCompliance::edges(const FrictionLaw& friction) const {
  if (friction.is_constant()) return edges(friction.coefficient);
  const auto excess = [&](double nu) {
    return asked(nu) - std::atan(friction.at(slip_at(system_, -sense_ * nu)));
  };
  // Around rolling, mu changes within the Stribeck speed.
  std::vector<double> nu = nu_, values;
  const double rolling = rolling_pace();
  for (double slip = 8.0; slip > 1e-3; slip *= 0.5) {
    const double off = slip * friction.stribeck_speed / system_.clearance;
    for (const double near : {rolling - off, rolling + off}) {
      if (near > nu_.front() && near < nu_.back()) nu.push_back(near);
    }
  }
  std::sort(nu.begin(), nu.end());
  sample_with_extremes(excess, nu, values);
  return roots(excess, nu, values);
}

std::vector<std::pair<double, double>> BackwardCompliance::rolling_ranges(double mu) const {
  std::vector<std::pair<double, double>> ranges;
  std::vector<double> ends = edges(mu);
  if (ends.empty()) return ranges;
  ends.push_back(std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double inside =
        std::isfinite(ends[k + 1]) ? 0.5 * (ends[k] + ends[k + 1]) : 2.0 * ends[k];
    if (can_roll(at(inside), mu)) ranges.emplace_back(ends[k], ends[k + 1]);
  }
  return ranges;
}

SteadyRub BackwardCompliance::standing(RubKind kind, double nu) const {
  SteadyRub rub{kind, -sense_ * nu, 0.0, 0.0, 0.0, 0.0, {}, {}};
  const Complex h = compliance(system_, rub.whirl);
  rub.normal_force = -system_.clearance * h.real() / std::norm(h);
  rub.friction = -h.imag() / h.real();
  rub.slip = kind == RubKind::kRolling ? 0.0 : slip_at(system_, rub.whirl);
  place(system_, Eigen::VectorXcd::Zero(system_.modes()), rub);
  return rub;
}

double BackwardCompliance::rolling_pace() const {
  return system_.radius * std::abs(system_.speed) / system_.clearance;
}

std::vector<SteadyRub> BackwardCompliance::whips(const FrictionLaw& friction) const {
  std::vector<SteadyRub> all;
  for (const double nu : edges(friction)) {
    if (!(nu < rolling_pace())) continue;
    SteadyRub rub = standing(RubKind::kWhip, nu);
    if (turn_ring(system_, rub)) all.push_back(std::move(rub));
  }
  return all;
}

std::vector<SteadyRub> BackwardCompliance::rolling_on_ring(double mu) const {
  std::vector<SteadyRub> all;
  if (sense_ == 0.0 || !system_.ring_turns()) return all;
  const double R = system_.ring_radius();
  const auto ring_speed = [&](double nu) { return system_.clearance * (rolling_pace() - nu) / R; };
  // Friction torque on the ring minus the torque of its drag, N m.
  const auto balance = [&](double nu) {
    const Complex h = at(nu);
    return R * system_.clearance * h.imag() / std::norm(h) - system_.ring->drag * ring_speed(nu);
  };
  std::vector<double> nu = nu_, values;
  sample_with_extremes(balance, nu, values);
  for (const double found : roots(balance, nu, values)) {
    SteadyRub rub = standing(RubKind::kRolling, found);
    rub.ring_speed = sense_ * ring_speed(found);
    if (std::abs(rub.friction) <= mu) all.push_back(std::move(rub));
  }
  return all;
}

std::optional<SteadyRub> BackwardCompliance::rolling(double mu) const {
  if (sense_ == 0.0) return {};
  const double nu = rolling_pace();
  if (!can_roll(at(nu), mu)) return {};
  return standing(RubKind::kRolling, nu);
}

}  // namespace rotorub::rub
