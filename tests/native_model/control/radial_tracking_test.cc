// The wanted gap: ends, smoothness, and that it never asks for a closed gap before its time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "native_model/control/radial_tracking.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

constexpr double kGap = 0.5e-3, kTime = 0.008;
const SwitchOn kAtRest{0.1, kGap, 0.0};

TEST(GapReference, FallsFromTheGapAtSwitchOnToZero) {
  EXPECT_EQ(gap_reference(kAtRest, 0.0, kTime).gap, kGap);
  EXPECT_EQ(gap_reference(kAtRest, 0.1, kTime).gap, kGap);
  EXPECT_NEAR(gap_reference(kAtRest, 0.104, kTime).gap, 0.5 * kGap, 1e-15);
  EXPECT_NEAR(gap_reference(kAtRest, 0.108, kTime).gap, 0.0, 1e-18);
  EXPECT_NEAR(gap_reference(kAtRest, 5.0, kTime).gap, 0.0, 1e-18);
  EXPECT_EQ(gap_reference(kAtRest, 5.0, kTime).share, 1.0);
  double last = kGap;
  for (double t = 0.1; t < 0.109; t += 1e-5) {
    const GapReference r = gap_reference(kAtRest, t, kTime);
    ASSERT_LE(r.gap, last);
    ASSERT_LE(r.rate, 0.0);
    last = r.gap;
  }
}

void expect_smooth(const SwitchOn& on, double from) {
  const double h = 1e-7, speed = kGap / kTime, acceleration = speed / kTime;
  for (double t = from; t < 0.109; t += 1.3e-5) {
    const auto before = gap_reference(on, t - h, kTime), now = gap_reference(on, t, kTime),
               after = gap_reference(on, t + h, kTime);
    ASSERT_NEAR(now.rate, (after.gap - before.gap) / (2 * h), 1e-6 * speed) << t;
    ASSERT_NEAR(now.acceleration, (after.rate - before.rate) / (2 * h), 2e-3 * acceleration) << t;
    // No jump anywhere: the third derivative is bounded by 60 g0 / T^3 and 36 rate / T^2.
    ASSERT_LT(std::abs(after.acceleration - before.acceleration), 330.0 * h / kTime * acceleration)
        << t;
  }
}

TEST(GapReference, IsTwiceContinuouslyDifferentiable) { expect_smooth(kAtRest, 0.0995); }

TEST(GapReference, LeavesTheGapAtTheRateItHad) {
  for (const double rate : {-0.1, -0.02, 0.05}) {
    const SwitchOn on{0.1, kGap, rate};
    const GapReference start = gap_reference(on, 0.1, kTime);
    EXPECT_EQ(start.gap, kGap);
    EXPECT_DOUBLE_EQ(start.rate, rate) << "so the error starts without a jump in its rate";
    EXPECT_EQ(start.acceleration, 0.0);
    expect_smooth(on, 0.1 + 1e-6);
    const GapReference end = gap_reference(on, 0.108, kTime);
    EXPECT_NEAR(end.gap, 0.0, 1e-18);
    EXPECT_NEAR(end.rate, 0.0, 1e-15);
  }
}

TEST(GapReference, NeverAsksForAClosedGapBeforeItsTime) {
  for (const double rate : {-0.1, -1.0, -100.0}) {
    for (double t = 0.1; t < 0.108; t += 1e-5) {
      ASSERT_GE(gap_reference({0.1, kGap, rate}, t, kTime).gap, 0.0) << rate << " " << t;
    }
  }
  EXPECT_EQ(gap_reference({0.1, -1e-6, -1.0}, 0.101, kTime).gap, 0.0) << "closed already";
}

// Beyond the clearance the ring would have to be on the other side of the rotor.
TEST(GapReference, NeverAsksForLessThanHalfTheDistanceAtSwitchOn) {
  for (const double distance : {0.0, 0.01, 0.1, 0.3, 0.5, 0.9}) {
    const double clearance = kGap, gap = (1.0 - distance) * clearance;
    for (const double rate : {0.01, 0.1, 100.0}) {
      for (double t = 0.1; t < 0.108; t += 1e-5) {
        ASSERT_GE(clearance - gap_reference({0.1, gap, rate}, t, kTime, clearance).gap,
                  0.5 * distance * clearance)
            << distance << " " << rate << " " << t;
      }
    }
  }
}

// ------------------------------------------------------------------

// A tracking law that is switched on near the centre, where the normal turns by half a turn at
// once, does not hold the ring there.

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
