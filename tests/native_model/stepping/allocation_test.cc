// A step allocates nothing on the heap. This program's operator new counts; with sanitizers, which
// replace the operator themselves, the tests are skipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "native_model/bearing/actuator.h"
#include "native_model/event/driver.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/reader.h"
#include "native_model/stepping/stepper.h"
#include "native_model/trajectory/recorder.h"
#include "tests/support/counted_new.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using test::allocations;

class Allocation : public testing::Test {
 protected:
  void SetUp() override {
    if (!ROTORUB_COUNTS_ALLOCATIONS) GTEST_SKIP() << "the sanitizer owns operator new";
    // The counter works; otherwise the tests below prove nothing. It is a direct call, because a
    // compiler may remove a new-expression.
    const std::int64_t before = allocations;
    ::operator delete(::operator new(64));
    ASSERT_EQ(allocations - before, 1);
  }
};

// Every kind of work in a step: free flight, impacts, sliding, torsion, unbalance, control.
scene::Scene soon_active(const std::string& name) {
  scene::Scene scene = test::shipped(name);
  if (name.starts_with("paper")) {
    scene.forces[0].on = 0.0;
    scene.initial.steady = false;
    scene.rotor.geometry->modes = 2;
    if (scene.first().controller) scene.first().controller->on = 0.002;
  }
  return scene;
}

constexpr const char* kScenes[] = {"bench_ring",    "bench_billiard", "bench_drop",
                                   "paper_passive", "paper_sliding",  "paper_magnetic"};

TEST_F(Allocation, NoneInAStepOfSeveralContacts) {
  const Model model = prepare(scene::read_scene(std::string(ROTORUB_SOURCE_DIR) +
                                                "/tests/native_model/event/two_rings/moving.toml"));
  for (const auto integrator : {scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
    const auto stepper = make_stepper(integrator, model, 1e-5);
    const std::vector<Eigen::Vector2d> u(2, Eigen::Vector2d(0.0, 0.0));
    bool touched[2] = {};
    const std::int64_t before = allocations;
    for (std::int64_t k = 0; k < 5000; ++k) {
      const FixedStep done = stepper->step(k, u, true);
      for (const std::size_t i : {0, 1}) touched[i] |= done.contacts[i].normal_impulse > 0.0;
    }
    const std::int64_t count = allocations - before;
    EXPECT_EQ(count, 0);
    EXPECT_TRUE(touched[0] && touched[1]);
  }
}

// A run of `event` allocates where it begins and where its lists (impacts, events, the keyphasor's
// passes) grow, which doubles them: a number that does not depend on the steps. A run of four times
// the length, with its events, may allocate for those doublings only.
TEST_F(Allocation, NoneInAStepOrEventOfEvent) {
  for (const char* name : kScenes) {
    SCOPED_TRACE(name);
    const Model model = prepare(soon_active(name));
    struct Run {
      std::int64_t allocations, steps;
      std::size_t impacts, events, passes;
    };
    const auto run = [&](double end) {
      EventIntegrator integrator(model);
      Recorder recorder(model, {end});
      const State start = initial_state(model);
      const std::int64_t before = allocations;
      const auto result = integrator.run(start, end, recorder);
      const std::int64_t count = allocations - before;
      EXPECT_EQ(result.status, Status::kOk) << result.message;
      const Trajectory t = recorder.finish({end});
      return Run{count, result.steps, t.impacts.size(), t.events.size(), t.keyphasor.size()};
    };
    const auto doublings = [](std::size_t n) {
      std::int64_t count = 0;
      for (std::size_t room = 0; room < n; room = room == 0 ? 1 : 2 * room) ++count;
      return count;
    };
    const Run brief = run(0.02), whole = run(0.08);
    EXPECT_GT(whole.steps, brief.steps + 20);
    const auto grown = [&](const Run& r) {
      return doublings(r.impacts) + doublings(r.events) + doublings(r.passes);
    };
    EXPECT_LE(whole.allocations - grown(whole), brief.allocations - grown(brief))
        << whole.steps << " steps, " << whole.events << " events";
    EXPECT_LT(whole.allocations, 60);
  }
}

// The only law whose arithmetic is in a library.
TEST_F(Allocation, NoneInAForceTable) {
  const ForceTable table({{-1e-3, -5e-4, 5e-4, 1e-3},
                          {-2.0, -1.0, 1.0, 2.0},
                          {-9, -4, 4, 9, -8, -3, 5, 10, -7, -2, 6, 11, -6, -1, 7, 12}});
  const std::int64_t before = allocations;
  const double force = table.force(2e-4, 0.3), current = table.current(1e-4, 1.0, 2.0);
  EXPECT_EQ(allocations - before, 0);
  EXPECT_TRUE(std::isfinite(force + current));
}

// A free spin with unbalance, rotating forces, impacts that take time, a compliant contact, several
// contacts, and magnetic bearings with states.
TEST(SavedStep, HasTheSizeThatFollowsFromTheModel) {
  for (const char* name : {"bench_ring", "blade_loss", "run_up", "finite_impacts", "compliant_ring",
                           "two_catchers", "amb_machine"}) {
    SCOPED_TRACE(name);
    const Model model = prepare(test::shipped(name));
    const VerletStepper stepper(model, 1e-6);
    const auto size = static_cast<std::ptrdiff_t>(VerletStepper::memory_size(model));
    std::vector<double> memory(static_cast<std::size_t>(size) + 1000,
                               std::numeric_limits<double>::quiet_NaN());
    stepper.save(memory.data());
    const auto written = [](double value) { return !std::isnan(value); };
    EXPECT_EQ(std::ranges::count_if(memory, written), size);
    EXPECT_TRUE(std::all_of(memory.begin(), memory.begin() + size, written));
  }
}

}  // namespace
}  // namespace rotorub
