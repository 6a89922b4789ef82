#include "native_model/model/base_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "native_model/linear/rub_system.h"
#include "native_model/model/model.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/scene/scene_samples.h"
#include "tests/support/native_run.h"
#include "tests/support/refusal.h"
#include "tests/support/thrown.h"

namespace rotorub {
namespace {

using Eigen::Vector2d;

scene::Base table() {
  scene::Base base;
  base.time = {0.1, 0.2, 0.4};
  base.acceleration_x = {1.0, 3.0, -1.0};
  base.acceleration_y = {0.0, 2.0, 2.0};
  return base;
}

scene::Base lines() {
  scene::Base base;
  base.frequency = {40.0, 0.0};
  base.amplitude = {2.0, 0.5};
  base.phase = {0.7, 0.0};
  base.direction = 0.4;
  return base;
}

TEST(BaseMotion, OnOffAndRamp) {
  scene::Base base = lines();
  const Vector2d whole = BaseMotion(base).at(0.3);
  base.on = 0.2;
  base.ramp = 0.4;
  base.off = 0.7;
  const BaseMotion motion(base);
  EXPECT_EQ(motion.at(0.19), Vector2d(0.0, 0.0));
  EXPECT_NEAR((motion.at(0.3) - 0.25 * whole).norm(), 0.0, 1e-14);
  EXPECT_EQ(motion.at(0.7), Vector2d(0.0, 0.0));
  EXPECT_EQ(motion.breaks(), (std::vector<double>{0.2, 0.2 + 0.4, 0.7}));
  EXPECT_EQ(motion.jumps(), (std::vector<double>{0.2, 0.7}));
}

// A step uses the exact mean over its time, across breaks and ends.
TEST(BaseMotion, TheMeanIsTheIntegral) {
  // Trapezoids of the table over [0, 0.5].
  const Vector2d all = 0.1 * Vector2d(2.0, 1.0) + 0.2 * Vector2d(1.0, 2.0);
  EXPECT_NEAR((BaseMotion(table()).mean(0.0, 0.5) - all / 0.5).norm(), 0.0, 1e-15);
  scene::Base base = lines();
  base.on = 0.2;
  base.ramp = 0.4;
  for (const scene::Base& of : {table(), base}) {
    const BaseMotion motion(of);
    const double from = 0.15, to = 0.25;
    constexpr int kCells = 200000;
    Vector2d sum{0.0, 0.0};
    for (int k = 0; k < kCells; ++k) sum += motion.at(from + (k + 0.5) * (to - from) / kCells);
    // The quadrature error of the line is (w h)^4 / 4320, with h = 0.05 from break to break.
    EXPECT_NEAR((motion.mean(from, to) - sum / kCells).norm(), 0.0, 2.0 * 16.0 / 4320.0);
    Vector2d parts{0.0, 0.0};
    for (int k = 0; k < 100; ++k) parts += motion.mean(from + 1e-3 * k, from + 1e-3 * (k + 1));
    EXPECT_NEAR((parts / 100.0 - sum / kCells).norm(), 0.0, 1e-8);
  }
}

TEST(BaseMotion, ASeedGivesPhasesThatAreAlwaysTheSame) {
  scene::Base base = lines();
  base.phase.clear();
  const Vector2d none = BaseMotion(base).at(0.3);
  base.seed = 1;
  const Vector2d one = BaseMotion(base).at(0.3);
  EXPECT_EQ(BaseMotion(base).at(0.3), one);
  base.seed = 2;
  EXPECT_NE(BaseMotion(base).at(0.3), one);
  EXPECT_NE(one, none);
}

// Even over the circle: the mean of e^{i phi} of n phases is of the size 1/sqrt(n).
TEST(BaseMotion, RandomPhasesAreEven) {
  scene::Base base;
  constexpr int kLines = 4000;
  base.frequency.assign(kLines, 0.0);
  base.amplitude.assign(kLines, 1.0);
  base.seed = 7;
  EXPECT_LT(std::abs(BaseMotion(base).at(0.0).x()), 3.0 * std::sqrt(0.5 * kLines));
}

TEST(BaseTable, RefusesEmptyTables) {
  using scene::expect_refused;
  const std::string rotor = "[rotor.modal]\nmass = [2.0]\nstiffness = [1e4]\n[base]\n";
  expect_refused({
      {"nothing", rotor + "on = 0.1\n", 4, "base", "has no acceleration; give `time`"},
      {"no acceleration", rotor + "time = [0, 1]\n", 5, "base.time", "needs base.acceleration_x"},
      {"one sample", rotor + "time = [0]\nacceleration_x = [1]\n", 5, "base.time", "two times"},
      {"falling", rotor + "time = [1, 0]\nacceleration_x = [1, 2]\n", 5, "base.time",
       "strictly ascending"},
      {"lengths", rotor + "time = [0, 1]\nacceleration_y = [1]\n", 6, "base.acceleration_y",
       "expected 2 value(s), one for each time"},
      {"no times", rotor + "acceleration_x = [1]\nfrequency = [1]\namplitude = [1]\n", 5,
       "base.acceleration_x", "needs base.time"},
      {"no amplitude", rotor + "frequency = [1]\n", 5, "base.frequency", "needs base.amplitude"},
      {"a phase each", rotor + "frequency = [1, 2]\namplitude = [1, 1]\nphase = [0]\n", 7,
       "base.phase", "expected 2 value(s), one for each line"},
      {"two phases", rotor + "frequency = [1]\namplitude = [1]\nphase = [0]\nseed = 1\n", 8,
       "base.seed", "cannot be given together with base.phase"},
      {"over before", rotor + "frequency = [1]\namplitude = [1]\non = 2\noff = 1\n", 8, "base.off",
       "must not be before `on`"},
  });
}

// ---------------------------------------------------------------- ring offset
// contact.offset: a machine and its ring moved by the same are the same machine.

Trajectory thrown(scene::Integrator integrator, const std::vector<std::string>& overrides) {
  return test::run_with(scene::parse_scene(test::kThrown, "thrown.toml", overrides), integrator);
}

TEST(RingOffset, AMachineMovedIsTheSameMachine) {
  const std::vector<std::string> ring{"stator={mass=1.0,stiffness=1e5,damping=100.0}"};
  for (const std::vector<std::string>& with : {std::vector<std::string>{}, ring}) {
    for (const scene::Integrator integrator :
         {scene::Integrator::kEvent, scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
      std::vector<std::string> there = with;
      there.insert(there.end(), {"contact.offset=[\"0.25 mm\",\"-0.125 mm\"]", "initial.x=[2.5e-4]",
                                 "initial.y=[-1.25e-4]"});
      std::vector<std::string> here = with;
      if (integrator == scene::Integrator::kEuler) {
        for (auto* all : {&here, &there}) all->push_back("contact.friction=0.0");
      }
      const Trajectory moved = thrown(integrator, there), plain = thrown(integrator, here);
      EXPECT_GE(plain.impacts.size(), 3u);
      ASSERT_EQ(moved.impacts.size(), plain.impacts.size());
      for (std::size_t k = 0; k < moved.rows(); ++k) {
        EXPECT_NEAR(moved.column("rotor_x")[k] - 2.5e-4, plain.column("rotor_x")[k], 1e-12);
        EXPECT_NEAR(moved.column("rotor_y")[k] + 1.25e-4, plain.column("rotor_y")[k], 1e-12);
        EXPECT_NEAR(moved.column("stator_x")[k] - 2.5e-4, plain.column("stator_x")[k], 1e-12);
        EXPECT_NEAR(moved.column("gap")[k], plain.column("gap")[k], 1e-12);
      }
    }
  }
}

TEST(RingOffset, AStartOutsideTheRingIsRefusedByIt) {
  const auto with = [](const std::string& offset) {
    const std::vector<std::string> overrides{"contact.offset=" + offset};
    return scene::parse_scene(test::kThrown, "thrown.toml", overrides);
  };
  EXPECT_EQ(test::refusal(with("[0.0,0.6e-3]")).key, "contact.offset");
  const scene::Scene inside = with("[0.0,0.1e-3]");
  EXPECT_THROW(rub::rub_system(inside), scene::SceneError);
}

}  // namespace
}  // namespace rotorub
