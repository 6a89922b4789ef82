// A stepper and a command whose state is carried as plain numbers go on to the same bits.
#include <gtest/gtest.h>

#include <vector>

#include "native_model/scene/reader.h"
#include "native_model/stepping/stepper.h"
#include "native_model/stepping/zero_order_hold.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using test::shipped;

constexpr double kStep = 1e-5;
// A closed loop, one step after the other.
struct Loop {
  Loop(const Model& of, const State& start)
      : model(&of), stepper(of, kStep, start), command(of), origin(start.t) {}

  FixedStep step(std::int64_t k) {
    const double t = origin + static_cast<double>(k) * kStep, end = t + 0.5 * kStep;
    if (!command.listens(end)) return stepper.step(k, command.held());
    double v[kMaxCoordinates], a[kMaxCoordinates] = {};
    stepper.velocity_now(k, command.held(), v);
    for (int i = 0; k > 0 && i < model->nq(); ++i) a[i] = 2.0 / kStep * (v[i] - stepper.v()[i]);
    const double begin = k == 0 ? t : t - 0.5 * kStep;
    const Eigen::Vector2d u = command.mean(begin, t, end, stepper.q(), v, a);
    stepper.jump(command.jump());
    return stepper.step(k, u);
  }
  std::vector<double> state() const {
    std::vector<double> all(stepper.q(), stepper.q() + model->nq());
    all.insert(all.end(), stepper.v(), stepper.v() + model->nq());
    return all;
  }

  const Model* model;
  VerletStepper stepper;
  ZeroOrderHold command;
  double origin;
};

struct Case {
  const char* name;
  std::vector<std::string> overrides;
};

// Friction with unbalance and a free spin (rows of M that lag a step), rotating forces between
// their exact sines, a sampled controller, several impacts, lasting contact.
std::vector<Case> cases() {
  return {{"bench_ring", {}},
          {"paper_passive", {"force[0].on=0.0", "initial.steady=false", "rotor.modes=2"}},
          {"paper_sliding",
           {"force[0].on=0.0", "initial.steady=false", "controller.on=0.0",
            "controller.sample_time=1e-4", "contact.clearance=0.1 mm", "rotor.modes=2"}}};
}

TEST(VerletMemory, RestoredAtEveryStepItGivesTheBitsOfAnUninterruptedRun) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Model model = make_model(shipped(c.name, c.overrides));
    Loop whole(model, initial_state(model)), carried(model, initial_state(model));
    // Another stepper takes the steps, with steps of another time in between: what those leave
    // behind must not show.
    Loop other(model, initial_state(model));
    constexpr std::int64_t kElsewhere = 700;
    for (std::int64_t k = 0; k < kElsewhere; ++k) other.step(k);

    std::vector<double> memory(VerletStepper::memory_size(model), -1.0), elsewhere = memory;
    std::vector<double> held(ZeroOrderHold::memory_size(model));
    other.stepper.save(elsewhere.data());
    carried.stepper.save(memory.data());
    carried.command.save(held.data());
    bool impacts = false, lasting = false;
    for (std::int64_t k = 0; k < 6000; ++k) {
      const FixedStep a = whole.step(k);
      other.stepper.restore(elsewhere.data());
      other.step(kElsewhere);
      other.stepper.restore(memory.data());
      other.command.restore(held.data());
      const FixedStep b = other.step(k);
      other.stepper.save(memory.data());
      other.command.save(held.data());
      ASSERT_EQ(other.state(), whole.state()) << k;
      ASSERT_EQ(a.normal_impulse, b.normal_impulse) << k;
      ASSERT_EQ(a.friction_impulse, b.friction_impulse) << k;
      ASSERT_EQ(a.mode, b.mode) << k;
      impacts |= !a.impacts.empty();
      lasting |= a.mode != Mode::kFree;
    }
    EXPECT_TRUE(impacts && lasting) << "the scene does not reach what is tested";
  }
}

// A machine that does not know the time by itself: later, all is the same but for round-off of t.
TEST(VerletOrigin, TheStartsTimeIsTheForcesTime) {
  const scene::Scene scene = shipped("bench_ring", {});
  const double period = 0.02, tolerance = 1e-13;  // 50 Hz; m, of 2e-3 m
  const Model model = make_model(scene);
  State later = initial_state(model);
  later.t = 7.0 * period;
  Loop now(model, initial_state(model)), then(model, later);
  for (std::int64_t k = 0; k < 300; ++k) {  // before the first impact
    now.step(k);
    then.step(k);
  }
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(now.stepper.q()[i], then.stepper.q()[i], tolerance) << i;
    EXPECT_GT(std::abs(now.stepper.q()[i]), 1e-5);
  }
  later.t = 7.25 * period;  // a quarter turn on: x becomes y
  Loop turned(model, later);
  for (std::int64_t k = 0; k < 300; ++k) turned.step(k);
  EXPECT_NEAR(turned.stepper.q()[1], now.stepper.q()[0], tolerance);
}

// The ring obeys a force that no controller of the model asked for.
TEST(VerletStepper, PassiveRingObeysAForceGivenToIt) {
  const Model model = make_model(shipped("paper_passive", {}));
  ASSERT_EQ(model.first().controller, nullptr);
  VerletStepper stepper(model, kStep);
  const int ring = model.layout.ring();
  stepper.step(0, {30.0, 0.0});
  const double implicit = model.mass[ring] + 0.5 * kStep * model.damping[ring];
  // The first step is half a kick.
  EXPECT_NEAR(stepper.v()[ring], 0.5 * 30.0 * kStep / implicit, 1e-18);
  EXPECT_EQ(stepper.v()[ring + 1], 0.0);
}

}  // namespace
}  // namespace rotorub
