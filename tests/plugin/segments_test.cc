// The segment rotor in MuJoCo against the native beam: whirl at rest and at speed, its convergence,
// torsion, damping in both frames, sag and unbalance.
#include "plugin/model/segments.h"
#include "native_model/prepare/prepare.h"
#include "plugin/make_config.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "mjcf/writer.h"
#include "native_model/linear/campbell.h"
#include "native_model/model/dynamics.h"
#include "native_model/run/run_native.h"
#include "plugin/model/generated_rotor.h"
#include "tests/plugin/linearised.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

// All stations are multiples of 0.1 m: 10, 20 and 40 segments are all of one length.
const std::string kRotor = R"(
[run]
step = 1e-6
[rotor]
length = 1.0
E = "210 GPa"
nu = 0.3
rho = 7850.0
modes = 3
[[rotor.section]]
from = 0.0
to = 0.5
diameter = "50 mm"
[[rotor.section]]
from = 0.5
to = 1.0
diameter = "45 mm"
inner_diameter = "10 mm"
[[rotor.disc]]
z = 0.3
mass = 12.0
Jt = 0.06
Jp = 0.11
[[rotor.disc]]
z = 1.0
mass = 4.0
Jt = 0.01
Jp = 0.018
[[rotor.bearing]]
z = 0.1
stiffness = 2e7
[[rotor.bearing]]
z = 0.8
stiffness = 1e7
)";

scene::Scene rotor(int segments, std::vector<std::string> overrides = {}) {
  overrides.push_back("mujoco={rotor=\"segments\", segments=" + std::to_string(segments) + "}");
  return parsed(kRotor, overrides);
}

class SegmentsTest : public HookedTest {
 protected:
  // Largest relative error of the six whirls of the three modes kept.
  static double whirl_error(int segments, double speed) {
    const scene::Scene scene = rotor(segments);
    const WhirlSpectrum native = whirl_spectrum(whirl_system(scene), speed);
    const ModelPointer m = load(mjcf(scene));
    LinearisedRotor linear(m.get());
    const auto s = isotropic_whirl(linear.bending(speed));
    double largest = 0.0;
    for (const WhirlMode& mode : native.modes) {
      double least = 1.0;
      for (const auto& value : s) {
        least = std::min(least, std::abs(value.imag() / mode.frequency - 1.0));
      }
      largest = std::max(largest, least);
    }
    return largest;
  }
};

TEST_F(SegmentsTest, WhirlConvergesWithTheSquareOfTheSegments) {
  for (const double speed : {0.0, 600.0}) {
    const double e10 = whirl_error(10, speed), e20 = whirl_error(20, speed),
                 e40 = whirl_error(40, speed);
    std::printf("whirl at %g rad/s, 10, 20, 40 segments: %.2e %.2e %.2e\n", speed, e10, e20, e40);
    EXPECT_LT(e10, 0.03) << speed;
    EXPECT_LT(e40, 2e-3) << speed;
    EXPECT_NEAR(std::log2(e10 / e20), 2.0, 0.3) << speed;
    EXPECT_NEAR(std::log2(e20 / e40), 2.0, 0.15) << speed;
  }
}

TEST_F(SegmentsTest, ThePluginAddsNothingToAFreeRotor) {
  const ModelPointer m = load(mjcf(rotor(10, {"rotor.speed=300", "initial.vx=[0.1, 0.01, 0]"})));
  std::vector<double> with, without;
  with = state_after(m.get(), 200);
  {
    const DataPointer d = start(m.get());
    const auto passive = mjcb_passive;
    mjcb_passive = nullptr;
    for (int k = 0; k < 200; ++k) mj_step(m.get(), d.get());
    mjcb_passive = passive;
    without = state_of(m.get(), d.get());
  }
  EXPECT_EQ(with, without);
}

TEST_F(SegmentsTest, AnisotropicBearingsWithDashpots) {
  const scene::Scene scene =
      rotor(40, {"rotor.bearing[1].stiffness=[1e7, 4e6]", "rotor.bearing[0].damping=[800, 300]",
                 "rotor.damping_ratio=0.01"});
  const double speed = 500.0;
  const WhirlSpectrum native = whirl_spectrum(whirl_system(scene), speed);
  const ModelPointer m = load(mjcf(scene));
  LinearisedRotor linear(m.get());
  const Linearised a = linear.bending(speed);
  const auto s = eigenvalues(a.from_position, a.from_velocity);
  for (const WhirlMode& mode : native.modes) {
    double least = 1.0, ratio = 0.0;
    for (const auto& value : s) {
      const double error = std::abs(std::abs(value.imag() / mode.frequency) - 1.0);
      if (error >= least) continue;
      least = error;
      ratio = -value.real() / std::abs(value);
    }
    EXPECT_LT(least, 2e-3) << mode.frequency;
    EXPECT_NEAR(ratio, mode.damping_ratio, 1e-2 * mode.damping_ratio) << mode.frequency;
  }
}

TEST_F(SegmentsTest, RotatingDampingMakesItUnstableAtTheNativeThreshold) {
  // The dampers turn with the speed that the scene holds.
  const auto at = [](double speed) {
    return rotor(20, {"rotor.damping_ratio=0.01", "rotor.internal_damping_ratio=0.02",
                      "rotor.speed=" + std::to_string(speed)});
  };
  const double native = stability_threshold(whirl_system(at(100.0))).value();
  const auto growth = [&](double speed) {
    const ModelPointer m = load(mjcf(at(speed)));
    LinearisedRotor linear(m.get());
    double largest = -1e300;
    for (const auto& s : isotropic_whirl(linear.bending(speed))) {
      largest = std::max(largest, s.real());
    }
    return largest;
  };
  double stable = 0.9 * native, unstable = 1.1 * native;
  ASSERT_LT(growth(stable), 0.0);
  ASSERT_GT(growth(unstable), 0.0);
  while (unstable - stable > 1e-5 * native) {
    const double middle = 0.5 * (stable + unstable);
    (growth(middle) > 0.0 ? unstable : stable) = middle;
  }
  std::printf("threshold: native %.3f, 20 segments %.3f rad/s\n", native, stable);
  EXPECT_NEAR(stable, native, 5e-3 * native);
}

TEST_F(SegmentsTest, TorsionConverges) {
  const auto error = [](int segments) {
    const scene::Scene scene = rotor(
        segments, {"rotor.torsion={modes=2}", "drive={kind=\"free\", station=0.0, inertia=0.05}"});
    const Model native = prepare(scene);
    const ModelPointer m = load(mjcf(scene));
    LinearisedRotor linear(m.get());
    const Linearised a = linear.torsion(300.0);
    const auto s = eigenvalues(a.from_position, a.from_velocity);
    double largest = 0.0;
    for (int k = 0; k < 2; ++k) {
      const int at = native.layout.theta() + k;
      const double omega = std::sqrt(native.stiffness[at] / native.mass[at]);
      double least = 1.0;
      for (const auto& value : s) least = std::min(least, std::abs(value.imag() / omega - 1.0));
      largest = std::max(largest, least);
    }
    return largest;
  };
  const double e10 = error(10), e20 = error(20);
  std::printf("torsion, 10, 20 segments: %.2e %.2e\n", e10, e20);
  EXPECT_LT(e20, 2e-3);
  EXPECT_NEAR(std::log2(e10 / e20), 2.0, 0.3);
}

TEST_F(SegmentsTest, NamesAJointThatIsGone) {
  expect_refused(replaced(mjcf(rotor(10)), "name=\"spin_3\"", "name=\"other\""), "spin_3");
}

// More joints than MuJoCo allows per body: the chain continues over several bodies.
TEST_F(SegmentsTest, ModalChainOfManyModesLoads) {
  const ModelPointer m = load(mjcf(shipped("paper_passive", {"rotor.modes=5"})));
  EXPECT_EQ(m->nv, 14);
  const plugin::Config config = plugin::make_config(m.get());
  EXPECT_TRUE(config.same_order);
}

// Recent versions of MuJoCo move a centre of mass less than 1 um off its frame to the frame's
// origin.
TEST_F(SegmentsTest, HaveTheSmallestEccentricity) {
  constexpr double kPhase = 0.3;
  for (const double e : {1e-9, 0.5e-6, 1e-6, 5e-6}) {
    const ModelPointer m =
        load(mjcf(rotor(10, {"rotor.disc[0].eccentricity=" + std::to_string(e * 1e9) + "e-9",
                             "rotor.disc[0].phase=0.3"})));
    const DataPointer d = start(m.get());
    mj_forward(m.get(), d.get());
    double largest = 0.0;
    for (int b = 1; b < m->nbody; ++b) {
      const double x = d->xipos[3 * b] - d->xpos[3 * b],
                   y = d->xipos[3 * b + 1] - d->xpos[3 * b + 1];
      if (std::hypot(x, y) <= largest) continue;
      largest = std::hypot(x, y);
      EXPECT_NEAR(std::atan2(y, x), kPhase, 1e-6) << e;
    }
    EXPECT_NEAR(largest, e, 1e-6 * e);
  }
}

TEST_F(SegmentsTest, RefusesWhatItCannotCarry) {
  EXPECT_THROW(rotor(1), std::exception);
  EXPECT_TRUE(contains(message_of([] { mjcf(rotor(3)); }), "mujoco.segments"));
  EXPECT_THROW(mjcf(rotor(5, {"rotor.modes=9"})), std::exception);
  EXPECT_THROW(parsed("[rotor.modal]\nmass=[1.0]\nstiffness=[1.0]\n[mujoco]\nrotor=\"segments\"\n"),
               std::exception);
  const ModelPointer m = load(mjcf(rotor(40)));
  const plugin::Config config = plugin::make_config(m.get());
  EXPECT_NE(plugin::segment_step_refusal(*config.segments, 1e-4), "");
}

}  // namespace
}  // namespace rotorub::test
