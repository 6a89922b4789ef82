// Compliant contact and a moving base, by `event`, against an independent program
// (oracles/still_machine.h). native_model/docs/evidence.md gives the agreement that is tested here.
#include "tests/support/oracles/still_machine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using oracle::Motion;
using oracle::Plane;
using oracle::StillMachine;

constexpr Motion kStart{{0.2e-3, -0.1e-3}, {0.0, 0.0}, {0.25, 0.05}, {0.0, 0.0}};
constexpr double kLongest = 2e-6;  // s, steps of the program: they leave 1e-14 m

scene::Scene scene_of(const StillMachine& machine) {
  const StillMachine::Contact& c = machine.contact;
  scene::Scene s = test::make_scene({.mass = machine.rotor.mass,
                                     .damping = machine.rotor.damping,
                                     .stiffness = machine.rotor.stiffness,
                                     .clearance = c.clearance,
                                     .radius = c.radius,
                                     .friction = c.friction,
                                     .restitution = c.restitution,
                                     .speed = machine.speed});
  test::add_ring(s, machine.ring.mass, machine.ring.damping, machine.ring.stiffness);
  s.first().contact->compliance = Compliance{.stiffness = c.stiffness, .exponent = c.exponent};
  s.initial.x = {kStart.rotor.real()};
  s.initial.y = {kStart.rotor.imag()};
  s.initial.vx = {kStart.rotor_rate.real()};
  s.initial.vy = {kStart.rotor_rate.imag()};
  s.run.end = 0.02;
  return s;
}

// The largest difference at the end of a run by `event` with this tolerance: of positions relative
// to the clearance, of velocities relative to the one at the start.
double difference(const scene::Scene& scene, double tolerance, const StillMachine& machine,
                  const Motion& exact) {
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  options.event.emplace().tolerance = tolerance;
  const Trajectory t = test::complete(run_native(scene, options));
  EXPECT_EQ(static_cast<int>(t.impacts.size()), machine.touches());
  const auto last = [&t](const char* x, const char* y) {
    return Plane(t.column(x).back(), t.column(y).back());
  };
  const double clearance = machine.contact.clearance, speed = std::abs(kStart.rotor_rate);
  return std::max({std::abs(last("rotor_x", "rotor_y") - exact.rotor) / clearance,
                   std::abs(last("stator_x", "stator_y") - exact.ring) / clearance,
                   std::abs(last("rotor_vx", "rotor_vy") - exact.rotor_rate) / speed,
                   std::abs(last("stator_vx", "stator_vy") - exact.ring_rate) / speed});
}

// One touch and five, with exponents for which p^n is smooth and for which it is not.
TEST(StillMachine, TouchesOfEveryExponentAndRestitution) {
  double by = 0.0, finer = 0.0;
  for (const double n : {1.0, 1.25, 1.5, 2.0}) {
    for (const double e : {0.01, 0.1, 0.5, 0.9, 1.0}) {
      StillMachine machine;
      machine.contact.exponent = n;
      machine.contact.stiffness = 1e6 * std::pow(1e-4, 1.0 - n);
      machine.contact.restitution = e;
      machine.force = [](double t) { return std::polar(180.0, 290.0 * t + 0.4); };
      scene::Scene s = scene_of(machine);
      test::add_rotating_force(s, 180.0, 290.0, 0.4);
      const Motion exact = machine.at(s.run.end, kStart, kLongest);
      EXPECT_GE(machine.touches(), 1) << n << " " << e;
      EXPECT_GT(machine.least_slip(), 1.0) << "friction has one sense";
      const double a = difference(s, 1e-12, machine, exact),
                   b = difference(s, 1e-13, machine, exact);
      by = std::max(by, a);
      finer = std::max(finer, b);
    }
  }
  EXPECT_LT(by, 4e-9);
  EXPECT_LT(finer, 5e-11);
}

// a(t) of the base: a record that is linear between its samples and 0 outside, and lines of a
// spectrum, both from `on` to `off`. Its place and velocity are the closed integrals, from rest.
class Shaken {
 public:
  scene::Base table() const {
    scene::Base b;
    b.time = time_;
    for (const Plane& a : acceleration_) {
      b.acceleration_x.push_back(a.real());
      b.acceleration_y.push_back(a.imag());
    }
    for (const Line& line : lines_) {
      b.frequency.push_back(line.frequency);
      b.amplitude.push_back(line.amplitude);
      b.phase.push_back(line.phase);
    }
    b.direction = direction_;
    b.on = on_;
    b.off = off_;
    return b;
  }
  std::vector<double> breaks() const {
    std::vector<double> all = time_;
    all.insert(all.end(), {on_, off_});
    std::ranges::sort(all);
    return all;
  }
  oracle::BaseMotion at(double t) const {
    const oracle::BaseMotion begin = whole(on_), now = whole(std::clamp(t, on_, off_));
    const double moved = std::clamp(t, on_, off_) - on_, after = std::max(t - off_, 0.0);
    const Plane rate = now.rate - begin.rate;
    return {now.place - begin.place - moved * begin.rate + after * rate, rate};
  }

 private:
  struct Line {
    double frequency, amplitude, phase;
  };
  // The integrals if it acted all the time.
  oracle::BaseMotion whole(double t) const {
    oracle::BaseMotion sum{};
    for (const Line& l : lines_) {
      const double angle = l.frequency * t + l.phase;
      sum.rate += l.amplitude / l.frequency * std::sin(angle) * std::polar(1.0, direction_);
      sum.place -=
          l.amplitude / (l.frequency * l.frequency) * std::cos(angle) * std::polar(1.0, direction_);
    }
    oracle::BaseMotion record{};
    for (std::size_t k = 0; k + 1 < time_.size() && time_[k] < t; ++k) {
      const double piece = time_[k + 1] - time_[k], h = std::min(t - time_[k], piece);
      const Plane slope = (acceleration_[k + 1] - acceleration_[k]) / piece;
      record.place += h * (record.rate + h * (acceleration_[k] / 2.0 + h * slope / 6.0));
      record.rate += h * (acceleration_[k] + h * slope / 2.0);
    }
    record.place += std::max(t - time_.back(), 0.0) * record.rate;
    return {sum.place + record.place, sum.rate + record.rate};
  }

  std::vector<double> time_{0.002, 0.005, 0.009, 0.014};
  std::vector<Plane> acceleration_{{20.0, 0.0}, {90.0, -40.0}, {-120.0, 70.0}, {30.0, 15.0}};
  std::vector<Line> lines_{{200.0, 60.0, 0.3}, {510.0, 40.0, 1.9}};
  double direction_ = 0.6, on_ = 0.001, off_ = 0.013;
};

TEST(StillMachine, OnABaseThatMoves) {
  const Shaken shaken;
  StillMachine machine;
  machine.contact.exponent = 1.5;
  machine.contact.stiffness = 1e8;
  machine.base = [&](double t) { return shaken.at(t); };
  machine.breaks = shaken.breaks();
  scene::Scene s = scene_of(machine);
  s.base = shaken.table();
  const Motion exact = machine.at(s.run.end, kStart, kLongest);
  EXPECT_GE(machine.touches(), 2);
  EXPECT_GT(machine.least_slip(), 1.0) << "friction has one sense";
  EXPECT_LT(difference(s, 1e-12, machine, exact), 4e-10);
  EXPECT_LT(difference(s, 1e-13, machine, exact), 1e-11);
}

}  // namespace
}  // namespace rotorub
