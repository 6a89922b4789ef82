#include "tests/bench/peers/penalty.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "mjcf/soft_contact.h"

namespace rotorub::peers {
namespace {

double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

// Rates of a state, and the contact's forces for its impulses.
StepRecord slope(const PlanarSystem& s, const StepRecord& y, double t, double k, double c,
                 const PenaltyParameters& parameters) {
  const PenaltyForce contact = penalty_force(s, y, k, c, parameters);
  const Pair load = s.load(t);
  StepRecord d;
  d.position = y.velocity;
  d.ring_position = y.ring_velocity;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto free = [i](const PlanarSupport& b, const Pair& x, const Pair& v) {
      return -b.stiffness[i] * x[i] - b.damping[i] * v[i];
    };
    d.velocity[i] =
        (free(s.rotor, y.position, y.velocity) + load[i] + contact.force[i]) / s.rotor.mass[i];
    if (!s.ring_moves) continue;
    d.ring_velocity[i] =
        (free(s.ring, y.ring_position, y.ring_velocity) - contact.force[i]) / s.ring.mass[i];
  }
  d.angle = y.speed;
  if (s.spin_is_free) {
    d.speed = (s.drive_gain * (s.drive_speed - y.speed) + s.radius * contact.friction) / s.inertia;
  }
  d.normal = contact.normal;
  d.friction = contact.friction;
  return d;
}

// y += h d, impulses too.
void add(StepRecord& y, double h, const StepRecord& d) {
  for (std::size_t i = 0; i < 2; ++i) {
    y.position[i] += h * d.position[i];
    y.velocity[i] += h * d.velocity[i];
    y.ring_position[i] += h * d.ring_position[i];
    y.ring_velocity[i] += h * d.ring_velocity[i];
  }
  y.angle += h * d.angle;
  y.speed += h * d.speed;
  y.normal += h * d.normal;
  y.friction += h * d.friction;
}

// k and c of the law for this step, and the state.
class PenaltyStepper : public Stepper {
 public:
  PenaltyStepper(const PlanarSystem& system, double step, const PenaltyParameters& parameters)
      : system_(system), step_(step), parameters_(parameters) {
    const auto& m = system.rotor.mass;
    double mass = std::min(m[0], m[1]);
    if (system.ring_moves) {
      const double ring = std::min(system.ring.mass[0], system.ring.mass[1]);
      mass = mass * ring / (mass + ring);
    }
    const double rate = parameters.step_fraction / step;  // 1/s, sqrt(k/m)
    stiffness_ = mass * rate * rate;
    damping_ = 2.0 * soft_damping_ratio(system.restitution) * rate * mass;
    now_.position = system.position;
    now_.velocity = system.velocity;
    now_.ring_position = system.ring_position;
    now_.ring_velocity = system.ring_velocity;
    now_.angle = system.angle;
    now_.speed = system.speed;
  }

  bool advance(std::int64_t count, StepRecord* records) override {
    for (std::int64_t i = 0; i < count; ++i, ++taken_) {
      now_.normal = now_.friction = 0.0;
      take_step(static_cast<double>(taken_) * step_);
      records[i] = now_;
    }
    return true;
  }
  const char* message() const override { return ""; }

 protected:
  virtual void take_step(double t) = 0;

  PlanarSystem system_;
  double step_;
  PenaltyParameters parameters_;
  double stiffness_ = 0.0, damping_ = 0.0;
  StepRecord now_;

 private:
  std::int64_t taken_ = 0;
};

class RungeKutta final : public PenaltyStepper {
  using PenaltyStepper::PenaltyStepper;

  void take_step(double t) override {
    const double half = 0.5 * step_;
    const auto rates = [&](const StepRecord& y, double at) {
      return slope(system_, y, at, stiffness_, damping_, parameters_);
    };
    const StepRecord k1 = rates(now_, t);
    StepRecord y = now_;
    add(y, half, k1);
    const StepRecord k2 = rates(y, t + half);
    y = now_;
    add(y, half, k2);
    const StepRecord k3 = rates(y, t + half);
    y = now_;
    add(y, step_, k3);
    const StepRecord k4 = rates(y, t + step_);
    add(now_, step_ / 6.0, k1);
    add(now_, step_ / 3.0, k2);
    add(now_, step_ / 3.0, k3);
    add(now_, step_ / 6.0, k4);
  }
};

// y_1 = y_0 + h f(y_m), y_m = (y_0 + y_1) / 2. But for the contact f is linear and a body's axis is
// alone, so that with N on the direction u = -e_r + (T/N) e_t all of y_m is affine in N:
//
//   v_m = v_free + (h/2) N u / D,   D = m + (h/2) d + (h^2/4) k
//
// N = max(0, -k gap_m - c gap_rate_m) is solved by Newton's method, e_r and T/N those of the last
// iterate.
class ImplicitMidpoint final : public PenaltyStepper {
  using PenaltyStepper::PenaltyStepper;

  void take_step(double t) override {
    constexpr int kIterations = 10;
    constexpr double kTolerance = 1e-12;  // of N
    const double half = 0.5 * step_;
    const PlanarSystem& s = system_;
    const Pair load = s.load(t + half);
    double normal = 0.0, ratio = 0.0;
    Pair u{0.0, 0.0};
    StepRecord middle = at_middle(load, normal, u, ratio);
    PlanarGap g = gap_of(middle);
    for (int i = 0; i < kIterations && (i > 0 || g.gap < 0.0); ++i) {
      const Pair& n = g.normal;
      ratio = -s.friction * std::tanh(g.slip / parameters_.smoothing_speed);
      u = {-n[0] - ratio * n[1], -n[1] + ratio * n[0]};
      // Gap rate in m/s per N of normal force.
      double rate = 0.0;
      for (std::size_t k = 0; k < 2; ++k) {
        rate -= half * n[k] * u[k] / weight(s.rotor, k);
        if (s.ring_moves) rate -= half * n[k] * u[k] / weight(s.ring, k);
      }
      const double answer = (stiffness_ * half + damping_) * rate;
      const double before = normal;
      normal = std::max(
          0.0, (-stiffness_ * g.gap - damping_ * g.gap_rate + answer * before) / (1.0 + answer));
      middle = at_middle(load, normal, u, ratio);
      g = gap_of(middle);
      if (std::abs(normal - before) <= kTolerance * normal) break;
    }
    for (std::size_t k = 0; k < 2; ++k) {
      now_.position[k] += step_ * middle.velocity[k];
      now_.velocity[k] = 2.0 * middle.velocity[k] - now_.velocity[k];
      now_.ring_position[k] += step_ * middle.ring_velocity[k];
      now_.ring_velocity[k] = 2.0 * middle.ring_velocity[k] - now_.ring_velocity[k];
    }
    now_.angle += step_ * middle.speed;
    now_.speed = 2.0 * middle.speed - now_.speed;
    now_.normal = step_ * normal;
    now_.friction = ratio * now_.normal;
  }

  // D, kg.
  double weight(const PlanarSupport& b, std::size_t k) const {
    const double half = 0.5 * step_;
    return b.mass[k] + half * b.damping[k] + half * half * b.stiffness[k];
  }

  StepRecord at_middle(const Pair& load, double normal, const Pair& u, double ratio) const {
    const double half = 0.5 * step_;
    const PlanarSystem& s = system_;
    StepRecord y = now_;
    const auto move = [&](const PlanarSupport& b, std::size_t k, double force, double& x,
                          double& v) {
      v = (b.mass[k] * v + half * (force - b.stiffness[k] * x)) / weight(b, k);
      x += half * v;
    };
    for (std::size_t k = 0; k < 2; ++k) {
      move(s.rotor, k, load[k] + normal * u[k], y.position[k], y.velocity[k]);
      if (s.ring_moves) move(s.ring, k, -normal * u[k], y.ring_position[k], y.ring_velocity[k]);
    }
    if (s.spin_is_free) {
      const double torque = s.drive_gain * s.drive_speed + s.radius * ratio * normal;
      y.speed = (s.inertia * y.speed + half * torque) / (s.inertia + half * s.drive_gain);
    }
    return y;
  }

  PlanarGap gap_of(const StepRecord& y) const {
    return planar_gap(system_, y.position, y.velocity, y.ring_position, y.ring_velocity, y.speed);
  }
};

}  // namespace

PenaltyForce penalty_force(const PlanarSystem& s, const StepRecord& y, double k, double c,
                           const PenaltyParameters& parameters) {
  PenaltyForce f;
  const PlanarGap g =
      planar_gap(s, y.position, y.velocity, y.ring_position, y.ring_velocity, y.speed);
  if (g.gap >= 0.0) return f;
  const Pair& n = g.normal;
  if (parameters.friction == PenaltyFriction::kTangential) {
    f.normal = std::max(0.0, -k * g.gap - c * g.gap_rate);
    f.friction = -s.friction * f.normal * std::tanh(g.slip / parameters.smoothing_speed);
    f.force = {-f.normal * n[0] - f.friction * n[1], -f.normal * n[1] + f.friction * n[0]};
    return f;
  }
  const Pair v{y.velocity[0] - y.ring_velocity[0], y.velocity[1] - y.ring_velocity[1]};
  const Pair press{k * g.gap * n[0] - c * v[0], k * g.gap * n[1] - c * v[1]};
  const double side = sign(v[0] * n[0] - v[1] * n[1] + s.radius * y.speed);
  f.force = {press[0] - side * s.friction * std::abs(press[0]),
             press[1] + side * s.friction * std::abs(press[1])};
  f.normal = std::max(0.0, -(f.force[0] * n[0] + f.force[1] * n[1]));
  f.friction = -f.force[0] * n[1] + f.force[1] * n[0];
  return f;
}

std::unique_ptr<Stepper> penalty_stepper(const PlanarSystem& system, double step,
                                         const PenaltyParameters& parameters) {
  if (parameters.scheme == PenaltyScheme::kImplicitMidpoint) {
    assert(parameters.friction == PenaltyFriction::kTangential);
    return std::make_unique<ImplicitMidpoint>(system, step, parameters);
  }
  return std::make_unique<RungeKutta>(system, step, parameters);
}

}  // namespace rotorub::peers
