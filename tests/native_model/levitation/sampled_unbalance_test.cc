// The unbalance response of magnetic bearings whose controls are sampled, against long runs.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "native_model/linear/levitation.h"
#include "native_model/linear/synchronous_response.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/levitation/two_bearings.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using Phasor = std::complex<double>;

// Of planes that differ.
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

// samples: lines of the first bearing's control; run: of [run].
scene::Scene sampled(double speed, const std::string& samples, const std::string& run) {
  const std::string law = "integral = 3e4\nderivative_lag = 2e-4\n" + samples;
  return scene::parse_scene(
      test::two_bearings(std::to_string(speed), kModal, law, kUnbalance + run), "sampled.toml", {});
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
    return sampled(speed, line("sample_time", sample()) + line("delay", sample()),
                   line("end", kOfRun * turn()) + line("output_step", row()));
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
    ASSERT_EQ(run.status, Status::kOk) << run.message;
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

// What a sensor sees is what `modes` says of it: both of them at the speed of the scene.
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

// Of samples that come faster and faster the continuous law's: there is no derivative's filter and
// no delay in the limit that is not in both.
TEST(SampledUnbalance, ApproachesTheContinuousLaw) {
  const auto at = [](const std::string& law) {
    const scene::Scene s = sampled(600.0, law, "end = 0.1\noutput_step = 1e-4\n");
    const auto response = synchronous_response(s, 600.0);
    return response.value().probes.front().deflection.back();
  };
  const Phasor exact = at("");
  double last = 1.0;
  for (const char* law : {"sample_time = 4e-5\n", "sample_time = 2e-5\n", "sample_time = 1e-5\n"}) {
    const double off = std::abs(at(law) - exact) / std::abs(exact);
    EXPECT_LT(off, 0.6 * last) << law;
    last = off;
  }
  EXPECT_LT(last, 1e-3);
}

// A loop that its delay makes unstable has no answer.
TEST(SampledUnbalance, HasNothingWhereTheDelayMakesItUnstable) {
  EXPECT_FALSE(synchronous_response(Turns{600.0, 3}.scene(), 600.0));
}

}  // namespace
}  // namespace rotorub
