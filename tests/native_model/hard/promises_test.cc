// Promises of the control laws on the reference rig (8 modes, sleeve, friction 0.3): against the
// passive bearing, from the first touch to the end, sampled and with a lag like a real amplifier.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "native_model/control/library.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

// The tests open only their own libraries.
[[maybe_unused]] const bool promises_trusts = (set_scene_libraries(SceneLibraries::kAllowed), true);

struct Figures {
  double impacts = 0.0, peak = 0.0, rate = 0.0, force = 0.0, contact = 0.0, open_until = 0.0;
};

Figures figures(const std::string& name, std::vector<std::string> overrides = {}) {
  overrides.push_back("run.step=5us");
  const Trajectory t =
      test::run_with(test::shipped(name, overrides), scene::Integrator::kVerlet, 5e-6);
  const double span = t.statistics.first_touch < 0.0 ? t.end : t.end - t.statistics.first_touch;
  Figures f;
  for (const Impact& impact : t.impacts) {
    f.impacts += counts(impact) ? 1.0 : 0.0;
    f.peak = std::max(f.peak, impact.normal_impulse);
  }
  f.rate = std::sqrt(t.statistics.gap_rate_square / span);
  f.force = t.statistics.impulse_total / span;
  f.contact = t.statistics.contact_time / span;
  const auto &gap = t.column("gap"), &time = t.column("t");
  for (std::size_t i = 0; i < gap.size(); ++i) {
    if (gap[i] > 1e-7) f.open_until = time[i];
  }
  return f;
}

const Figures& passive() {
  static const Figures all = figures("paper_passive");
  return all;
}

void expect_soft(const Figures& f, double slack) {
  EXPECT_LE(f.impacts, slack * passive().impacts / 50.0);
  EXPECT_LE(f.peak, slack * passive().peak / 5.0);
  EXPECT_LE(f.rate, slack * passive().rate / 20.0);
  EXPECT_LE(f.force, passive().force);
  EXPECT_GT(f.contact, 0.98);
}

TEST(LongPromises, ThePassiveBearingBouncesToTheEnd) {
  EXPECT_GT(passive().impacts, 500.0);
  EXPECT_LT(passive().contact, 0.7);
  EXPECT_GT(passive().open_until, 0.49);
}

TEST(LongPromises, ContinuousSlidingIsSoft) { expect_soft(figures("paper_sliding"), 1.0); }

TEST(LongPromises, SampledSlidingIsSoft) {
  for (const char* sample : {"20us", "100us"}) {
    SCOPED_TRACE(sample);
    expect_soft(figures("paper_sliding",
                        {std::string("controller.sample_time=") + sample, "controller.preload=30"}),
                1.0);
  }
}

// The largest delay, and the refusal beyond it: 1/w_c = 178.5 us.
TEST(LongPromises, TheSampleTimeThatIsNeededIsTold) {
  expect_soft(figures("paper_sliding", {"controller.sample_time=300us", "controller.preload=30"}),
              2.0);
  EXPECT_TRUE(test::contains(
      test::message_of<scene::SceneError>([] {
        figures("paper_sliding", {"controller.sample_time=400us", "controller.preload=30"});
      }),
      {"controller.sample_time", "set at most 0.00035"}));
}

// The paper's claim: the earlier the law is switched on before the touch (107 ms), the smaller the
// largest impact.
TEST(LongPromises, LeadTimeIsWhatSoftensTheTouch) {
  double last = 0.0;
  for (const char* on : {"103ms", "105ms", "107ms", "112ms"}) {
    const double peak =
        figures("paper_sliding", {std::string("controller.on=") + on, "run.end=0.15"}).peak;
    EXPECT_GT(peak, 1.2 * last) << on;
    last = peak;
  }
  EXPECT_NEAR(last, passive().peak, 0.05 * passive().peak) << "too late for the first impacts";
}

// From rounded and delayed positions alone: the law of the example (examples/own_controller.c).
TEST(LongPromises, AControllerOfOnesOwnFromPositionsAlone) {
  const Figures f = figures("examples/own_controller", {std::string("controller.library=") +
                                                        ROTORUB_LIBRARIES + "/own_controller.so"});
  EXPECT_LE(f.impacts, passive().impacts / 50.0);
  EXPECT_LE(f.peak, passive().peak / 3.0);
  EXPECT_LE(f.rate, passive().rate / 10.0);
  EXPECT_GT(f.contact, 0.98);
  EXPECT_LT(f.open_until, 0.12);
}

// The quadratic laws keep the ring about the rotor, which is another solution: there is no contact.
// It costs force, because the ring is carried on the whole orbit.
TEST(LongPromises, QuadraticLawsAvoidTheRub) {
  for (const char* kind : {"lqr", "lqg"}) {
    SCOPED_TRACE(kind);
    const Figures f = figures(
        "paper_passive", {std::string("controller.kind=") + kind, "controller.sample_time=50us"});
    EXPECT_EQ(f.impacts, 0.0);
    EXPECT_EQ(f.force, 0.0);
  }
}

TEST(LongPromises, SampledSlidingWithALagIsSoft) {
  expect_soft(figures("paper_magnetic", {"controller.sample_time=100us", "actuator.coil_lag=0.1ms",
                                         "controller.preload=30"}),
              2.0);
}

// It holds the rotor at half the orbit, which takes more force: at most a 20th of the impacts.
TEST(LongPromises, CrossCoupledFeedbackStopsTheBouncing) {
  for (const char* sample : {"20us", "100us"}) {
    SCOPED_TRACE(sample);
    const Figures f =
        figures("paper_cross_coupled", {std::string("controller.sample_time=") + sample});
    EXPECT_LE(f.impacts, passive().impacts / 20.0);
    EXPECT_GT(f.contact, 0.97);
    EXPECT_LT(f.open_until, 0.15);
  }
}

// The eigenvalues of the forced rub say which feedback does (linear/rub_map.h): with 1,000 N s/m
// it grows.
TEST(LongPromises, FeedbackOutsideTheWindowDoesNot) {
  const Figures f = figures(
      "paper_cross_coupled",
      {"controller.feedback=[1000]", "controller.feedback_speed=[0]", "controller.damping=0"});
  EXPECT_GT(f.impacts, 300.0);
  EXPECT_GT(f.open_until, 0.49);
}

// The feedback's mean force is that of holding the rotor at half its orbit.
TEST(LongPromises, TheTwoPhaseLawIsSoftAndHoldsTheOrbit) {
  const Figures f = figures("paper_two_phase"), cross = figures("paper_cross_coupled");
  EXPECT_LE(f.impacts, passive().impacts / 50.0);
  EXPECT_LE(f.peak, passive().peak / 5.0);
  EXPECT_LE(f.rate, passive().rate / 20.0);
  EXPECT_GT(f.contact, 0.98);
  EXPECT_NEAR(f.force, cross.force, 0.1 * cross.force);
}

}  // namespace
}  // namespace rotorub
