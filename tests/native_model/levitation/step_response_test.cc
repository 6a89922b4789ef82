// Responses of magnetic bearings' loops to a step of force and to the unbalance, against closed
// forms and against runs of the nonlinear model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "native_model/linear/levitation.h"
#include "native_model/linear/synchronous_response.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/levitation/two_bearings.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using Phasor = std::complex<double>;

constexpr double kHeavy = 2.0, kPulls = 1e5, kPushes = 80.0;  // kg, N/m, N/A

// m r'' + c r' + k r = force: k = k_i P - k_s, c = k_i D.
scene::Scene hung(double stiffness, double damping) {
  scene::Scene s = test::make_scene({.mass = kHeavy});
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {1.0}, kPulls}};
  s.magnetic_bearings[0].control =
      scene::BearingControl{.force_per_current = kPushes,
                            .proportional = (stiffness + kPulls) / kPushes,
                            .derivative = damping / kPushes};
  return s;
}

// Where f, which is monotone there, is 0.
template <class F>
double root(const F& f, double low, double high) {
  const bool begins_above = f(low) > 0.0;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == begins_above ? low : high) = middle;
  }
  return low;
}

// The most of y is (1 + exp(-pi zeta / sqrt(1 - zeta^2))) / k, at pi / w_d.
TEST(StepResponse, ProportionalAndDerivativeOfOneMassHaveTheTextbooksFigures) {
  constexpr double kHeld = 2.2e5;
  const double w = std::sqrt(kHeld / kHeavy);
  for (const double zeta : {0.02, 0.1, 0.4, 0.7}) {
    SCOPED_TRACE(zeta);
    const Levitation all = levitation(prepare(hung(kHeld, 2.0 * zeta * w * kHeavy)), 0.0);
    const double wd = w * std::sqrt(1.0 - zeta * zeta),
                 beside = zeta / std::sqrt(1.0 - zeta * zeta);
    const auto y = [&](double t) {
      return (1.0 - std::exp(-zeta * w * t) * (std::cos(wd * t) + beside * std::sin(wd * t))) /
             kHeld;
    };
    ASSERT_EQ(all.steps.size(), 2u);
    for (const StepResponse& step : all.steps) {
      const double overshoot = std::exp(-M_PI * beside);
      EXPECT_NEAR(step.overshoot.value(), overshoot, 1e-9);
      EXPECT_NEAR(step.largest, (1.0 + overshoot) / kHeld, 1e-10 / kHeld);
      EXPECT_NEAR(step.largest_at.value(), M_PI / wd, 1e-9 * M_PI / wd);
      EXPECT_NEAR(step.static_stiffness().value(), kHeld, 1e-9 * kHeld);
      const auto first = [&](double share) {
        return root([&](double t) { return y(t) - share / kHeld; }, 0.0, M_PI / wd);
      };
      EXPECT_NEAR(step.rise_time.value(), first(0.9) - first(0.1), 1e-8 / w);
      // The last half swing that leaves the band, and where it comes back into it.
      int swing = 1;
      while (std::exp(-zeta * w * (swing + 1) * M_PI / wd) > 0.02) ++swing;
      const bool leaves = std::exp(-zeta * w * swing * M_PI / wd) > 0.02;
      const double side = swing % 2 == 1 ? 1.02 : 0.98;
      const double settled =
          leaves ? root([&](double t) { return y(t) - side / kHeld; }, swing * M_PI / wd,
                        (swing + 1) * M_PI / wd)
                 : root([&](double t) { return y(t) - 0.98 / kHeld; }, 0.0, M_PI / wd);
      EXPECT_NEAR(step.settling_time, settled, 1e-7 * settled);
      for (std::size_t k = 0; k < step.t.size(); ++k)
        ASSERT_NEAR(step.y[k], y(step.t[k]), 1e-9 / kHeld) << step.t[k];
    }
  }
}

// Two equal poles, whose modes are no basis, and two real ones: there is no overshoot and no
// maximum.
TEST(StepResponse, WithoutASwingDoesNotOvershoot) {
  constexpr double kHeld = 2.2e5;
  const double w = std::sqrt(kHeld / kHeavy);
  for (const double zeta : {1.0, 3.0}) {
    const Levitation all = levitation(prepare(hung(kHeld, 2.0 * zeta * w * kHeavy)), 0.0);
    const StepResponse& step = all.steps.at(0);
    EXPECT_LT(step.overshoot.value(), 1e-9);
    EXPECT_FALSE(step.largest_at.has_value());
    EXPECT_EQ(step.largest, step.steady);
    // (1 + w t) e^{-w t} = 0.02.
    if (zeta == 1.0) {
      EXPECT_NEAR(w * step.settling_time, 5.83392, 1e-5);
    }
  }
}

TEST(StepResponse, OfALoopThatIsUnstableThereIsNone) {
  EXPECT_TRUE(levitation(prepare(hung(2e5, -10.0)), 0.0).steps.empty());
  EXPECT_EQ(levitation(prepare(hung(2e5, -10.0)), 100.0).unbalance.size(), 0);
}

// An integrator brings the rotor back, so the final value is 0 and the overshoot is undefined.
TEST(StepResponse, AnIntegratorLetsNothingStay) {
  scene::Scene s = hung(2.2e5, 400.0);
  s.magnetic_bearings[0].control->integral = 3e4;
  const StepResponse step = levitation(prepare(s), 0.0).steps.at(0);
  EXPECT_EQ(step.steady, 0.0);
  EXPECT_FALSE(step.overshoot || step.rise_time || step.static_stiffness());
  EXPECT_GT(step.largest, 1.0 / 2.2e5);
  const auto late = [&](double t) { return t > step.settling_time * (1.0 + 1e-9); };
  for (std::size_t k = 0; k < step.t.size(); ++k) {
    EXPECT_LE(std::abs(step.y[k]), step.largest * (1.0 + 1e-12));
    if (late(step.t[k])) {
      EXPECT_LE(std::abs(step.y[k]), 0.02 * step.largest * (1.0 + 1e-9));
    }
  }
}

// Every row of a run at an instant of the curve, and the figures of its rows.
void expect_the_run(const std::string& law, double every) {
  // A tenth of a newton at the first bearing, which stands at the contact.
  constexpr const char* kPush = R"(
[[force]]
kind = "constant"
vector = [0.1, 0.0]
[run]
end = 0.06
)";
  scene::Scene s = scene::parse_scene(
      test::two_bearings("200.0", "damping = [30.0, 20.0]", law, kPush), "step.toml", {});
  const Levitation all = levitation(prepare(s), 200.0);
  ASSERT_TRUE(all.stable());
  const StepResponse& step = all.steps.at(0);
  s.run.output_step = every > 0.0 ? every : 32.0 * step.t[1];
  const Trajectory run = test::run_event(s);
  int met = 0;
  double largest = 0.0;
  for (std::size_t row = 1; row < run.rows(); ++row) {
    const double t = run.column("t")[row], moved = run.column("rotor_x")[row] / 0.1;
    largest = std::max(largest, moved);
    const auto at = std::lower_bound(step.t.begin(), step.t.end(), t * (1.0 - 1e-9));
    if (std::abs(*at - t) > 1e-9 * t) continue;
    ++met;
    EXPECT_NEAR(step.y[static_cast<std::size_t>(at - step.t.begin())], moved, 1e-8 * step.largest)
        << t;
  }
  EXPECT_GT(met, 100);
  EXPECT_LE(largest, step.largest * (1.0 + 1e-8));
  EXPECT_GT(largest, step.largest * (1.0 - 1e-3));
}

TEST(StepResponse, IsTheRunUnderASmallForce) {
  const std::string law = "derivative_lag = 2e-4\nintegral = 3e4\n";
  expect_the_run(law, 0.0);
  expect_the_run(law + "sample_time = 1e-4\ndelay = 2e-4", 1e-4);
}

// 2 m e Omega^2 / |k - m Omega^2 + i Omega c|.
TEST(UnbalanceResponse, OneMassHasItsClosedForm) {
  constexpr double kMoment = 1e-4;  // kg m
  scene::Scene s = hung(2.2e5, 400.0);
  scene::Force unbalance;
  unbalance.kind = scene::ForceKind::kUnbalance;
  unbalance.static_moment = kMoment;
  unbalance.phase = 0.7;
  s.forces.push_back(unbalance);
  for (const double speed : {-500.0, 40.0, 330.0, 900.0}) {
    s.rotor.speed = speed;
    const Eigen::VectorXd moved = levitation(prepare(s), speed).unbalance;
    const double exact =
        2.0 * kMoment * speed * speed /
        std::abs(std::complex<double>(2.2e5 - kHeavy * speed * speed, 400.0 * speed));
    EXPECT_NEAR(moved[0], exact, 1e-10 * exact) << speed;
    EXPECT_NEAR(moved[1], exact, 1e-10 * exact) << speed;
  }
}

// ---------------------------------------------------------------- unbalance of sampled loops
// The unbalance response of magnetic bearings whose controls are sampled, against long runs.

// A rotor whose planes differ.
constexpr const char* kModal = R"(
stiffness_y = [1.3e5, 9e5]
damping = [300.0, 200.0]
)";
constexpr const char* kUnbalance = R"(
[[force]]
kind = "unbalance"
static_moment = 1e-5
phase = 0.4
shape = [0.8, -0.5]
[run]
)";

std::string line(const char* key, double value) {
  return key + (" = " + std::to_string(value * 1e9)) + "e-9\n";
}

// Samples a whole number of times a turn, so that the motion repeats once a turn; rows a whole
// number of times a sample, the last turns of which give the part at the spin's speed.
struct Turns {
  static constexpr int kOfRun = 60, kLast = 4, kRows = 16;
  double speed;
  int samples;
  double turn() const { return 2.0 * std::numbers::pi / std::abs(speed); }
  double sample() const { return turn() / samples; }
  double row() const { return sample() / kRows; }
  scene::Scene scene() const {
    const std::string law = "integral = 3e4\nderivative_lag = 2e-4\n" +
                            line("sample_time", sample()) + line("delay", sample());
    const std::string run = line("end", kOfRun * turn()) + line("output_step", row());
    return scene::parse_scene(
        test::two_bearings(std::to_string(speed), kModal, law, kUnbalance + run), "sampled.toml");
  }
};

// X of d = Re(X e^{i |Omega| t}): the mean of 2 d e^{-i |Omega| t} over whole turns.
Phasor once_a_turn(const Turns& turns, const Trajectory& run, const char* column) {
  const auto &t = run.column("t"), &d = run.column(column);
  const std::size_t count = static_cast<std::size_t>(Turns::kLast) *
                            static_cast<std::size_t>(turns.samples) * Turns::kRows;
  Phasor sum = 0.0;
  for (std::size_t k = d.size() - count; k < d.size(); ++k)
    sum += 2.0 * d[k] * std::polar(1.0, -std::abs(turns.speed) * t[k]);
  return sum / static_cast<double>(count);
}

TEST(SampledUnbalance, IsOnceATurnInALongRun) {
  for (const Turns& turns : {Turns{600.0, 12}, Turns{-600.0, 12}, Turns{250.0, 40}}) {
    SCOPED_TRACE(turns.speed);
    const scene::Scene s = turns.scene();
    const auto response = synchronous_response(s, std::abs(turns.speed));
    ASSERT_TRUE(response);
    EXPECT_FALSE(response->same_planes);
    const Trajectory run = test::run_event(s);
    int met = 0;
    for (const ProbeResponse& probe : response->probes) {
      if (probe.name != "contact") continue;
      ++met;
      Phasor exact = once_a_turn(turns, run, probe.plane == 0 ? "rotor_x" : "rotor_y");
      // The mark passes under the probe of y a quarter turn later.
      if (probe.plane == 1) exact *= Phasor(0.0, turns.speed < 0.0 ? -1.0 : 1.0);
      EXPECT_LT(std::abs(probe.deflection.back() - exact), 2e-5 * std::abs(exact)) << probe.plane;
    }
    EXPECT_EQ(met, 2);
  }
}

// A sensor in the run shows the prediction of `modes`; both at the speed of the scene.
TEST(SampledUnbalance, HasTheFiguresOfTheLoopAtItsSensors) {
  const Turns turns{600.0, 12};
  const scene::Scene s = turns.scene();
  const auto response = synchronous_response(s, 600.0);
  ASSERT_TRUE(response);
  const Eigen::VectorXd moved = levitation(prepare(s), 600.0).unbalance;
  ASSERT_EQ(moved.size(), 4);
  int met = 0;
  for (const ProbeResponse& probe : response->probes) {
    const bool first = probe.name == "sensor 1", second = probe.name == "magnetic bearing 2";
    if (!first && !second) continue;
    ++met;
    EXPECT_NEAR(2.0 * std::abs(probe.deflection.back()) / moved[(second ? 2 : 0) + probe.plane],
                1.0, 1e-12);
  }
  EXPECT_EQ(met, 4);
}

// A loop that its delay makes unstable has no response.
TEST(SampledUnbalance, HasNothingWhereTheDelayMakesItUnstable) {
  EXPECT_FALSE(synchronous_response(Turns{600.0, 3}.scene(), 600.0));
}

}  // namespace
}  // namespace rotorub
