// Sampled controls of magnetic bearings that are switched at one of their samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

using test::run_event;
using test::run_with;

scene::Scene switched_scene(const std::string& control, const std::string& further = "") {
  const std::string text = R"(
[run]
end = 0.06
step = 1e-5
output_step = 0.77e-3
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [1e4]
damping = [10.0]
[magnetic_bearing]
)" + further + R"(
[magnetic_bearing.control]
sample_time = 1e-3
proportional = 2e3
derivative = 2.0
)" + (further.find("electromagnet") == further.npos ? "force_per_current = 100.0\n" : "") +
                           control + R"(
[initial]
x = [1e-4]
)";
  return scene::parse_scene(text, "switched.toml", {});
}
double between(const scene::Scene& s, scene::Integrator integrator, double step) {
  const Trajectory exact = run_event(s);
  return test::orbit_error(run_with(s, integrator, step), [&](double t) {
    const std::vector<double>& times = exact.column("t");
    const auto at = static_cast<std::size_t>(
        std::lower_bound(times.begin(), times.end(), t - 1e-9) - times.begin());
    return std::complex<double>(exact.column("rotor_x")[at], exact.column("rotor_y")[at]);
  });
}

// k T, and k T less T, meet what a scene says of them to round-off alone.
TEST(SampledMagneticSwitching, SwitchedOnAtASampleItRemembersFromThere) {
  for (int k = 1; k <= 30; ++k) {
    const std::string at = std::to_string(k) + "e-3";
    for (const std::string& when : {"on = " + at, "fails_at = 1e-4\nreturns_at = " + at}) {
      const scene::Scene s = switched_scene(when, "negative_stiffness = 1e5");
      EXPECT_LT(between(s, scene::Integrator::kVerlet, 1e-5), 2e-9) << when;
    }
  }
}

// A sample and a switch at the same instant act one after the other, so the order stays 2.
TEST(SampledMagneticSwitching, SwitchedAtASampleTheOrderIsTwo) {
  const std::string linear = "negative_stiffness = 1e5\n";
  for (const std::string& further :
       {linear, linear + "amplifier = { bandwidth = 3000.0 }\n",
        linear + "amplifier = { bandwidth = 3000.0, voltage_limit = 4.0, inductance = 0.05 }\n",
        std::string("kind = \"electromagnet\"\nforce_constant = 8e-6\nbias_current = 1.0\n"
                    "air_gap = 6e-4\n")}) {
    for (const char* when :
         {"on = 10e-3", "fails_at = 10e-3", "fails_at = 10e-3\nreturns_at = 14e-3",
          "delay = 1e-3\nfails_at = 10e-3\nreturns_at = 13e-3"}) {
      scene::Scene s = switched_scene(when, further);
      s.run.end = 0.03;
      const test::Convergence c = test::convergence({1e-5, 5e-6, 2.5e-6}, [&](double step) {
        return between(s, scene::Integrator::kVerlet, step);
      });
      // A limit begins and ends anywhere within a step.
      const double least = further.find("limit") == further.npos ? 1.9 : 1.6;
      EXPECT_GT(c.order(), least) << further << when << "\n" << c.text();
    }
  }
}

// A bearing that is switched on at 10 ms, with samples every 1 ms and a delay of 2 ms, has no
// current before 12 ms. Then it has the current of the sample at 10 ms.
TEST(SampledMagneticSwitching, HasNoCurrentUntilTheDelayHasPassed) {
  for (const char* when : {"on = 10e-3", "fails_at = 3e-3\nreturns_at = 10e-3"}) {
    scene::Scene s =
        switched_scene(std::string("delay = 2e-3\n") + when, "negative_stiffness = 1e5");
    s.magnetic_bearings[0].control->derivative = 0.0;
    s.run.end = 0.015;
    s.run.output_step = 0.25e-3;
    for (const auto integrator :
         {scene::Integrator::kEvent, scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
      const Trajectory t = run_with(s, integrator);
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
