// What mjcf/docs/parts.md says of magnetic bearings at their limits.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

// A free mass of 2 kg between two magnets with their bias current alone.
scene::Scene beyond_the_gap(double place, bool controlled) {
  scene::Scene s = scene::parse_scene(R"(
[run]
end = 1e-3
step = 1e-5
output_step = 1e-4
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
[magnetic_bearing]
kind = "electromagnet"
force_constant = 2e-6
bias_current = 2.5
air_gap = 6e-4
)",
                                      "gap.toml", {});
  if (controlled) s.magnetic_bearings[0].control = scene::BearingControl{};
  s.initial.x = {place};
  return s;
}

// The cores do not stop the rotor: beyond 99 % of the gap the force is constant. A bearing without
// a control has the same magnets, and no current to show.
TEST(OpposedMagnets, PullBeyondTheirGapAsAt99PercentOfIt) {
  constexpr double kAirGap = 6e-4, kReach = 0.99 * kAirGap;
  const auto square = [](double x) { return x * x; };
  const double force =
      2e-6 * 2.5 * 2.5 * (1.0 / square(kAirGap - kReach) - 1.0 / square(kAirGap + kReach));
  for (const double start : {kReach, kAirGap, 3.0 * kAirGap}) {
    for (const bool controlled : {false, true}) {
      for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
        const Trajectory t = test::run_with(beyond_the_gap(start, controlled), integrator);
        ASSERT_EQ(t.status, Status::kOk) << t.message;
        EXPECT_EQ(t.has("bearing_current_x"), controlled);
        for (std::size_t k = 0; k < t.rows(); ++k) {
          const double exact = start + 0.25 * force * square(t.column("t")[k]);
          EXPECT_NEAR(t.column("rotor_x")[k] / exact, 1.0, 1e-12) << start << " " << k;
        }
      }
    }
  }
}

// Switched on at 10 ms, with samples every 1 ms and a delay of 2 ms, it has no current before 12
// ms; from then on it has that of the sample at 10 ms.
TEST(SampledMagneticSwitching, HasNoCurrentUntilTheDelayHasPassed) {
  for (const char* when : {"on = 10e-3", "fails_at = 3e-3\nreturns_at = 10e-3"}) {
    const scene::Scene s = scene::parse_scene(std::string(R"(
[run]
end = 0.015
step = 1e-5
output_step = 0.25e-3
[rotor.modal]
mass = [2.0]
stiffness = [1e4]
[magnetic_bearing]
negative_stiffness = 1e5
[magnetic_bearing.control]
sample_time = 1e-3
delay = 2e-3
proportional = 2e3
force_per_current = 100.0
)") + when + R"(
[initial]
x = [1e-4]
)",
                                              "late.toml", {});
    for (const auto integrator :
         {scene::Integrator::kEvent, scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
      const Trajectory t = test::run_with(s, integrator);
      ASSERT_EQ(t.status, Status::kOk) << t.message;
      const std::vector<double>&time = t.column("t"), &current = t.column("bearing_current_x");
      double sampled = 0.0;
      for (std::size_t k = 0; k < t.rows(); ++k) {
        if (std::abs(time[k] - 10e-3) < 1e-7) sampled = t.column("rotor_x")[k];
        if (time[k] < 3.1e-3 || time[k] > 12.9e-3) continue;
        if (time[k] > 11.9e-3 && time[k] < 12.1e-3) continue;
        const double delayed = time[k] < 12e-3 ? 0.0 : -2e3 * sampled;
        EXPECT_NEAR(current[k], delayed, 1e-12) << when << " at " << time[k];
      }
      EXPECT_GT(std::abs(sampled), 1e-5) << when;
    }
  }
}

}  // namespace
}  // namespace rotorub
