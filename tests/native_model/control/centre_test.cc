// A tracking law that is switched on near the centre, where the normal turns by half a turn at
// once, does not hold the ring there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/native_run.h"

namespace rotorub {
namespace {

constexpr const char* kLaw = "gap_time=TIME,bandwidth=400.0,boundary_layer=0.1,switching_gain=60.0";

// From x (m) at the velocity (m/s), in `bench_ring` on a force of that frequency.
struct Passage {
  std::string law, time, x, vx, vy, frequency;
};

scene::Scene passing(const Passage& p) {
  std::string law = kLaw;
  law.replace(law.find("TIME"), 4, p.time);
  return test::shipped("bench_ring",
                       {"actuator={force_limit=3000.0}", "run.end=0.15", "run.output_step=20us",
                        "controller={" + p.law + "," + law + "}", "initial.x=[" + p.x + "]",
                        "initial.vx=[" + p.vx + "]", "initial.vy=[" + p.vy + "]",
                        "force[0].frequency=\"" + p.frequency + " Hz\""});
}

// s: the longest time for which the centres are together while the law acts.
double held_at_the_centre(const Trajectory& t, double clearance) {
  double longest = 0.0, since = 0.0;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const bool near = clearance - t.column("gap")[k] < 0.05 * clearance;
    const bool acts = std::hypot(t.column("control_x")[k], t.column("control_y")[k]) > 1.0;
    if (!near || !acts) since = t.column("t")[k];
    longest = std::max(longest, t.column("t")[k] - since);
  }
  return longest;
}

double largest_command(const Trajectory& t) {
  double most = 0.0;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    most = std::max(most, std::hypot(t.column("control_x")[k], t.column("control_y")[k]));
  }
  return most;
}

// Of the sampled laws the feed-forward is a mean over a turn, 20 ms: a passage must not fill it.
TEST(TrackingAtTheCentre, SampledLawsLetGo) {
  const std::string sampled = "sample_time=20e-6,preload=";
  const std::string sliding = "kind='sliding'," + sampled;
  const std::string handing =
      "kind='two_phase',feedback=[1000.0],damping=300.0,handover_time=0.02," + sampled;
  for (const Passage& p :
       {Passage{sliding + "30.0", "4e-3", "3.45e-5", "-0.312", "0.182", "120"},
        Passage{handing + "0.0", "20e-3", "6.12e-5", "-0.188", "-0.157", "120"},
        Passage{handing + "30.0", "20e-3", "9.93e-5", "-0.018", "-0.154", "120"}}) {
    const scene::Scene scene = passing(p);
    const Trajectory t = test::run_with(scene, scene::Integrator::kVerlet, 1e-5);
    ASSERT_EQ(t.status, Status::kOk) << t.message;
    EXPECT_LT(held_at_the_centre(t, scene.first().contact->clearance), 0.01) << p.x << " " << p.vx;
  }
}

TEST(TrackingAtTheCentre, TheContinuousLawNeedsNoForceWithoutEnd) {
  for (const Passage& p :
       {Passage{"kind='sliding',preload=100.0", "20e-3", "1.11e-4", "-0.130", "0.0", "50"},
        Passage{"kind='sliding',preload=30.0", "8e-3", "1e-4", "-0.3", "0.05", "50"}}) {
    const Trajectory t = test::run_event(passing(p));
    ASSERT_EQ(t.status, Status::kOk) << t.message;
    EXPECT_LT(largest_command(t), 600.0) << p.x << " " << p.vx;
  }
}

}  // namespace
}  // namespace rotorub
