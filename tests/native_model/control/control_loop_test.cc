// A sampled controller as it is run: when its trigger lets it in, what it is told of that, its
// state.
#include "native_model/control/control_loop.h"

#include <gtest/gtest.h>

#include <vector>

namespace rotorub {
namespace {

constexpr double kLoopSample = 1e-4, kLoopClearance = 5e-4;

// Tells when it was let in, and how often it was asked.
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

// A rotor that goes to the ring at `speed` from the centre, along a slant line.
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
  // The first sample with a command; -1: none up to `samples`.
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

TEST(ControlLoop, TheStateIsTheCallersAlone) {
  Trial run(std::nullopt);
  std::vector<double> other = run.memory;
  run.loop.sample(approach(0, 0.1), run.memory.data());
  const std::vector<double> copy = run.memory;
  const Eigen::Vector2d next = run.loop.sample(approach(1, 0.1), run.memory.data());
  run.memory = copy;
  EXPECT_EQ(run.loop.sample(approach(1, 0.1), run.memory.data()), next)
      << "put back, it does it again";
  EXPECT_EQ(run.loop.sample(approach(1, 0.1), other.data()).x(), 11.0)
      << "another array, another run";
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
  // In at 0.1 m/s, touched and thrown back between samples 49 and 50: the gap is never seen closed.
  Trial run(trigger);
  for (int k = 0; k < 50; ++k) {
    ASSERT_TRUE(run.loop.sample(approach(k, 0.1), run.memory.data()).isZero(0.0)) << k;
  }
  Measurement back = approach(49, 0.1);
  back.t = 50 * kLoopSample;
  back.rotor_velocity *= -0.5;
  EXPECT_FALSE(run.loop.sample(back, run.memory.data()).isZero(0.0));
}

// Contact that lasts leaves the gap at round-off of either sign; armed in it, the trigger is let in
// at once.
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

TEST(ControlLoop, ARotorThatTurnsBackBeforeTheRingIsNoTouch) {
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

}  // namespace
}  // namespace rotorub
