// A sampled controller in a run: its trigger, the measurements at its start, its state.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "native_model/control/abi/rotorub/controller.h"
#include "native_model/control/control_loop.h"
#include "native_model/control/controller.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/prepare/prepare.h"
#include "tests/support/jeffcott.h"
#include "tests/support/machine.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

constexpr double kLoopSample = 1e-4, kLoopClearance = 5e-4;

// Records when it was switched on, and counts its calls.
class Probe final : public Controller {
 public:
  std::size_t state_size() const override { return 2; }
  void start(double* state) const override { state[0] = 10.0; }
  Eigen::Vector2d command(const Measurement&, const SwitchOn& on, double* state) const override {
    state[0] += 1.0;
    seen = on;
    return {state[0], on.t};
  }
  mutable SwitchOn seen;
};

// A rotor that approaches the ring at `speed` from the centre, along an oblique line.
Measurement approach(int k, double speed) {
  Measurement m;
  m.t = k * kLoopSample;
  m.sample = k;
  const Eigen::Vector2d e(0.6, 0.8);
  m.rotor = (1e-6 + speed * m.t) * e;
  m.rotor_velocity = speed * e;
  return m;
}

struct Trial {
  explicit Trial(std::optional<scene::Trigger> trigger)
      : law(std::make_shared<Probe>()),
        loop(law, {}, trigger, kLoopSample, kLoopClearance),
        memory(loop.memory_size(), 0.0) {}
  // The first sample with a command; -1 if there is none up to `samples`.
  int first(int samples, double speed) {
    for (int k = 0; k < samples; ++k) {
      if (!loop.sample(approach(k, speed), memory.data()).isZero(0.0)) return k;
    }
    return -1;
  }
  std::shared_ptr<Probe> law;
  ControlLoop loop;
  std::vector<double> memory;
};

TEST(ControlLoop, WithoutATriggerItRunsAtOnceAndKeepsItsState) {
  Trial run(std::nullopt);
  EXPECT_EQ(run.loop.sample(approach(3, 0.1), run.memory.data()).x(), 11.0)
      << "start() is asked once";
  EXPECT_EQ(run.loop.sample(approach(4, 0.1), run.memory.data()).x(), 12.0);
  EXPECT_DOUBLE_EQ(run.law->seen.t, 3 * kLoopSample);
  EXPECT_DOUBLE_EQ(run.law->seen.gap, kLoopClearance - 1e-6 - 3e-5);
  EXPECT_DOUBLE_EQ(run.law->seen.gap_rate, -0.1);
}

// The gap is 499 um - 10 um k at 0.1 m/s.
TEST(ControlLoop, TriggersByGap) {
  scene::Trigger trigger;
  trigger.gap = 2.0e-4;
  Trial run(trigger);
  EXPECT_EQ(run.first(100, 0.1), 30);
  EXPECT_NEAR(run.law->seen.gap, 1.99e-4, 1e-12) << "the reference starts where the rotor is";
  EXPECT_EQ(Trial(trigger).first(100, 1e-3), -1) << "it never gets there";
}

TEST(ControlLoop, TriggersByTheTimeToTouch) {
  scene::Trigger trigger;
  trigger.time_to_touch = 2e-3;
  EXPECT_EQ(Trial(trigger).first(100, 0.1), 30) << "0.2 mm at 0.1 m/s";
  EXPECT_EQ(Trial(trigger).first(100, 0.2), 5) << "twice as fast, twice as far: 0.4 mm";
  EXPECT_EQ(Trial(trigger).first(100, -0.001), -1) << "not while it goes";
}

TEST(ControlLoop, TriggersByTouchAlsoBetweenTwoSamples) {
  scene::Trigger trigger;
  trigger.touch = true;
  EXPECT_EQ(Trial(trigger).first(100, 0.1), 50) << "closed";
  // The rotor approaches at 0.1 m/s, touches and rebounds between samples 49 and 50, so no sample
  // has a closed gap.
  Trial run(trigger);
  for (int k = 0; k < 50; ++k) {
    ASSERT_TRUE(run.loop.sample(approach(k, 0.1), run.memory.data()).isZero(0.0)) << k;
  }
  Measurement back = approach(49, 0.1);
  back.t = 50 * kLoopSample;
  back.rotor_velocity *= -0.5;
  EXPECT_FALSE(run.loop.sample(back, run.memory.data()).isZero(0.0));
}

// In lasting contact the gap is round-off of either sign; a trigger that is armed then fires at
// once.
TEST(ControlLoop, TriggersAtOnceInLastingContact) {
  scene::Trigger trigger;
  trigger.touch = true;
  for (const double gap : {0.0, 2e-19, -2e-19, 3e-11, -3e-11, 1e-9}) {
    Measurement m;
    m.t = 40 * kLoopSample;
    m.sample = 40;
    m.rotor = {kLoopClearance - gap, 0.0};
    m.rotor_velocity = {1e-12, 0.3};
    Trial run(trigger);
    EXPECT_FALSE(run.loop.sample(m, run.memory.data()).isZero(0.0)) << gap;
  }
  Measurement near;
  near.rotor = {kLoopClearance - 1e-7, 0.0};
  Trial run(trigger);
  EXPECT_TRUE(run.loop.sample(near, run.memory.data()).isZero(0.0)) << "0.1 um off the ring";
}

TEST(ControlLoop, DoesNotTriggerIfTheRotorTurnsBackBeforeTheRing) {
  scene::Trigger trigger;
  trigger.touch = true;
  Trial run(trigger);
  for (int k = 0; k < 30; ++k) run.loop.sample(approach(k, 0.1), run.memory.data());
  for (int k = 30; k < 60; ++k) {
    Measurement back = approach(60 - k, 0.1);
    back.t = k * kLoopSample;
    back.rotor_velocity *= -1.0;
    ASSERT_TRUE(run.loop.sample(back, run.memory.data()).isZero(0.0)) << k;
  }
}

// ------------------------------------------------------------------

// Measurements of a sampled controller: choice, resolution, noise, delay, velocities from
// positions.

constexpr double kSensorSample = 1e-4;

// All numbers differ.
Measurement truth(std::int64_t k) {
  const double t = static_cast<double>(k) * kSensorSample;
  Measurement m;
  m.t = t;
  m.sample = k;
  m.rotor = {1.1e-4 + 0.3 * t, -2.2e-4 + 0.7 * t};
  m.rotor_velocity = {0.3, 0.7};
  m.stator = {3.3e-5 - 0.2 * t, 4.4e-5 + 0.1 * t};
  m.stator_velocity = {-0.2, 0.1};
  m.spin_angle = 314.0 * t;
  m.spin_speed = 314.0;
  m.current = {1.5, -0.5};
  m.rotor_acceleration = {7.0, 8.0};
  return m;
}

std::vector<Measurement> shown(const scene::Sensors& settings, int samples) {
  const Sensors sensors(settings, kSensorSample);
  std::vector<double> memory(sensors.memory_size(), 0.0);
  std::vector<Measurement> all;
  for (int k = 0; k < samples; ++k) all.push_back(sensors.measure(truth(k), memory.data()));
  return all;
}

TEST(Sensors, UnmeasuredValuesAreZeroAndNotListed) {
  scene::Sensors s;
  s.rotor = s.spin = s.current = false;
  const Measurement m = shown(s, 1).front();
  EXPECT_TRUE(m.rotor.isZero(0.0));
  EXPECT_TRUE(m.rotor_velocity.isZero(0.0)) << "of what is not measured";
  EXPECT_EQ(m.stator_velocity, truth(0).stator_velocity);
  EXPECT_EQ(m.spin_speed, 0.0);
  EXPECT_TRUE(m.current.isZero(0.0));
  EXPECT_EQ(Sensors(s, kSensorSample).measured(),
            unsigned{ROTORUB_MEASURES_STATOR | ROTORUB_MEASURES_VELOCITY});
}

TEST(Sensors, RoundToTheResolution) {
  scene::Sensors s;
  s.position_resolution = 1e-5;
  s.velocity_resolution = 0.25;
  const Measurement m = shown(s, 1).front();
  EXPECT_DOUBLE_EQ(m.rotor.x(), 1.1e-4);
  EXPECT_DOUBLE_EQ(m.stator.x(), 3e-5);
  EXPECT_EQ(m.rotor_velocity, Eigen::Vector2d(0.25, 0.75));
}

TEST(Sensors, NoiseIsNormalIndependentAndAlwaysTheSame) {
  scene::Sensors s;
  s.position_noise = 2e-6;
  const int count = 20'000;
  const auto a = shown(s, count), b = shown(s, count);
  double sum = 0.0, square = 0.0, across = 0.0, next = 0.0, fourth = 0.0, last = 0.0;
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    ASSERT_EQ(a[i].rotor, b[i].rotor);
    const Eigen::Vector2d e = (a[i].rotor - truth(k).rotor) / s.position_noise;
    sum += e.x();
    square += e.x() * e.x();
    fourth += std::pow(e.x(), 4);
    across += e.x() * e.y();
    next += e.x() * last;
    last = e.x();
  }
  // Five standard deviations of each mean.
  const double bound = 5.0 / std::sqrt(count);
  EXPECT_LT(std::abs(sum / count), bound);
  EXPECT_LT(std::abs(square / count - 1.0), std::sqrt(2.0) * bound);
  EXPECT_LT(std::abs(fourth / count - 3.0), std::sqrt(96.0) * bound);
  EXPECT_LT(std::abs(across / count), bound);
  EXPECT_LT(std::abs(next / count), bound);
  EXPECT_EQ(a[5].rotor_velocity, truth(5).rotor_velocity) << "no noise of its own";
  s.seed = 2;
  EXPECT_NE(shown(s, 1).front().rotor, a.front().rotor);
}

TEST(Sensors, EveryChannelHasANoiseOfItsOwn) {
  scene::Sensors s;
  s.position_noise = 2e-6;
  s.velocity_noise = 3e-3;
  s.current_noise = 0.02;
  const Measurement m = shown(s, 1).front(), wanted = truth(0);
  std::vector<double> errors;
  const auto add = [&errors](const Eigen::Vector2d& error, double sigma) {
    for (const double e : error) errors.push_back(std::abs(e) / sigma);
  };
  add(m.rotor - wanted.rotor, s.position_noise);
  add(m.stator - wanted.stator, s.position_noise);
  add(m.rotor_velocity - wanted.rotor_velocity, s.velocity_noise);
  add(m.stator_velocity - wanted.stator_velocity, s.velocity_noise);
  add(m.current - wanted.current, s.current_noise);
  std::ranges::sort(errors);
  EXPECT_GT(errors.front(), 1e-3);
  EXPECT_LT(errors.back(), 5.0) << "standard deviations";
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) EXPECT_GT(errors[i + 1] - errors[i], 1e-9);
  EXPECT_EQ(m.spin_angle, wanted.spin_angle);
  EXPECT_EQ(m.spin_speed, wanted.spin_speed);
  EXPECT_EQ(m.rotor_acceleration, wanted.rotor_acceleration);
}

TEST(Sensors, DelayIsOfWholeSamplesAndTheFirstStandsForAllBefore) {
  scene::Sensors s;
  s.delay = 3 * kSensorSample;
  const auto all = shown(s, 8);
  for (int k = 0; k < 8; ++k) {
    const Measurement wanted = truth(std::max(0, k - 3));
    const Measurement& m = all[static_cast<std::size_t>(k)];
    EXPECT_EQ(m.rotor, wanted.rotor) << k;
    EXPECT_EQ(m.spin_angle, wanted.spin_angle) << k;
    EXPECT_EQ(m.t, truth(k).t) << "the time is now";
    EXPECT_EQ(m.sample, k);
  }
}

TEST(Sensors, VelocitiesFromTheShownPositions) {
  scene::Sensors s;
  s.velocity = scene::VelocitySensor::kDifference;
  s.position_resolution = 1e-6;
  const auto all = shown(s, 4);
  EXPECT_TRUE(all[0].rotor_velocity.isZero(0.0)) << "nothing to differ from";
  for (std::size_t k = 1; k < all.size(); ++k) {
    EXPECT_LT((all[k].rotor_velocity - (all[k].rotor - all[k - 1].rotor) / kSensorSample).norm(),
              1e-12);
    EXPECT_LT((all[k].rotor_velocity - truth(0).rotor_velocity).norm(), 1.5e-6 / kSensorSample);
  }
  s.delay = kSensorSample;
  const auto late = shown(s, 4);
  EXPECT_EQ(late[3].rotor_velocity, all[2].rotor_velocity) << "late as they are";
}

// ---------------------------------------------------------------- whole runs
// The emulated support, and the preload of the sliding law.

scene::Scene emulating() {
  scene::Scene s = test::machine_scene(true);
  s.first().controller = scene::Controller{};
  s.first().controller->stiffness = 5e4;
  return s;
}

TEST(EmulatedSupport, IsTheMechanicalOneAddedThroughTheActuator) {
  scene::Scene emulated = emulating();
  emulated.first().controller->damping = 120.0;
  scene::Scene mechanical = test::machine_scene(true);
  mechanical.first().stator->stiffness += Eigen::Vector2d(5e4, 5e4);
  mechanical.first().stator->damping += Eigen::Vector2d(120.0, 120.0);
  const Model a = prepare(emulated), b = prepare(mechanical);
  const State s = test::random_state(a, 70);
  const Eigen::Vector2d u = control_command(a, s.t, s.q.data(), s.v.data());
  Eigen::VectorXd fa(a.nq()), fb(b.nq());
  smooth_force(a, s.t, s.q.data(), s.v.data(), u, fa.data());
  smooth_force(b, s.t, s.q.data(), s.v.data(), {0.0, 0.0}, fb.data());
  EXPECT_LT((fa - fb).norm(), 1e-12 * fb.norm());
}

TEST(EmulatedSupport, ActsWithoutAContactToo) {
  scene::Scene s = emulating();
  s.first().contact.reset();
  const Model m = prepare(s);
  ASSERT_NE(m.first().controller, nullptr);
  State state = test::random_state(m, 71);
  state.q.segment<2>(m.layout.ring()) = Eigen::Vector2d(1e-3, -2e-3);
  const Eigen::Vector2d u = control_command(m, 0.0, state.q.data(), state.v.data());
  EXPECT_LT((u - Eigen::Vector2d(-50.0, 100.0)).norm(), 1e-12);
}

// A row at the instant of a sample shows the command after it, although 3 * 0.1 is later than 0.3.
TEST(SampledController, RowsAtASampleShowTheCommandAfterIt) {
  scene::Scene s = emulating();
  s.first().contact.reset();
  s.forces.clear();
  s.rotor.speed = 0.0;
  s.first().stator->stiffness = {100.0, 100.0};
  s.first().stator->damping = {0.1, 0.1};
  s.first().stator->position = {1e-3, -5e-4};
  s.first().controller->stiffness = 20.0;
  s.first().controller->sample_time = 0.1;
  s.run.end = 1.0;
  s.run.output_step = 1.0;
  const std::vector<double> samples{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  for (const double t : samples) s.run.output_times.insert(s.run.output_times.end(), {t, t + 0.05});
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    SCOPED_TRACE(integrator == scene::Integrator::kEvent ? "event" : "verlet");
    const Trajectory t = test::run_with(s, integrator, 1e-4);
    const std::vector<double>& force = t.column("control_x");
    for (const double at : samples) {
      const std::size_t row = test::row_of(t, at), later = test::row_of(t, at + 0.05);
      EXPECT_EQ(force[row], force[later]) << at;
      EXPECT_NE(force[row], force[row - 1]) << at;
    }
  }
}

TEST(SlidingController, LastingContactCarriesThePreload) {
  // Ring 1.5 kg and rotor 2 kg move as one, whatever the orbit. The free orbit, 1.6 mm, is past the
  // clearance.
  scene::Scene s = test::make_scene({.damping = 60.0, .stiffness = 2e5, .friction = 0.1});
  test::add_ring(s, 1.5, 300.0, 2e5);
  test::add_rotating_force(s, 60.0, 300.0);
  s.rotor.speed = 300.0;
  s.first().controller = scene::Controller{};
  s.first().controller->kind = scene::ControllerKind::kSliding;
  s.first().controller->on = 0.02;
  s.first().controller->preload = 20.0;
  s.initial.x = {4e-4};
  s.run.end = 0.2;
  const Trajectory t = test::run_event(s);
  for (std::size_t row = t.rows() / 2; row < t.rows(); row += 50) {
    EXPECT_NEAR(t.column("normal_force")[row], 20.0, 2e-5) << t.column("t")[row];
    EXPECT_NEAR(t.column("gap")[row], 0.0, 1e-12);
  }
}

// The reference rig from the switch-on to 50 ms after the touch. The more modes, the less the rotor
// weighs at the contact: 1.2 kg with 2, 0.30 kg with 12. Where the law gives the actuator the
// preload itself, the contact keeps 10.4 N of 20 N with 2, 3.3 N with 12.
TEST(SlidingController, ForceDoesNotDependOnTheModesOfItsPlant) {
  for (const int modes : {2, 6, 10}) {
    SCOPED_TRACE(modes);
    scene::Scene s = test::shipped("paper_sliding", {"run.end=0.157"});
    s.rotor.geometry->modes = modes;
    const Trajectory t = test::run_event(s);
    const double preload = s.first().controller->preload;
    EXPECT_NEAR(t.mean_force(), preload, 0.03 * preload);
    const double apart = (1.0 - t.contact_fraction()) * (t.end - t.statistics.first_touch);
    EXPECT_LT(apart, 1e-3) << "it bounces for a moment, then stays";
    EXPECT_LT(std::count_if(t.impacts.begin(), t.impacts.end(), counts), 12);
  }
}

}  // namespace
}  // namespace rotorub
