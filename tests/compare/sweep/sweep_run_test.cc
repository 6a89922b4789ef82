// The order in which a sweep runs its points, and its reports of progress.
#include "compare/sweep/sweep_run.h"

#include <gtest/gtest.h>

#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

// Points of `count` frictions, each of a millisecond.
struct ShortSweep {
  explicit ShortSweep(int count)
      : study(folder.study(test::of_ring() +
                           "[sample]\nkind = \"grid\"\n[[vary]]\nkey = \"contact.friction\"\n"
                           "from = 0.1\nto = 0.3\ncount = " +
                           std::to_string(count) +
                           "\n[run]\nintegrator = \"event\"\nend = \"1 ms\"\n")),
        scenes(study, {}),
        store(folder.path() / "results.sqlite", study, {"h", count}, {}) {}

  test::StudyFolder folder;
  Study study;
  PointScenes scenes;
  Store store;
};

TEST(RunSweep, FirstPointsAreSpreadOverTheStudy) {
  constexpr int kPoints = 4000, kFirst = 16;
  ShortSweep sweep(kPoints);
  std::atomic<bool> interrupt{false};
  SweepOptions options;
  options.interrupt = &interrupt;
  options.progress = [&](const SweepProgress& at) { interrupt = at.now >= kFirst; };
  EXPECT_FALSE(run_sweep(sweep.scenes, sweep.store, options));
  const std::vector<bool> done = sweep.store.done();
  for (std::size_t k = 0; k < kFirst; ++k) EXPECT_TRUE(done[k * kPoints / kFirst]) << k;
  EXPECT_FALSE(done[kPoints - 1]);
  // Each of the others follows once.
  EXPECT_TRUE(run_sweep(sweep.scenes, sweep.store, {}));
  EXPECT_EQ(sweep.store.count(), kPoints);
}

TEST(RunSweep, TellsTheTimeThatIsLeftOnceAPointIsDone) {
  ShortSweep sweep(500);
  std::vector<SweepProgress> told;
  SweepOptions options;
  options.jobs = 2;
  options.progress = [&](const SweepProgress& at) { told.push_back(at); };
  EXPECT_TRUE(run_sweep(sweep.scenes, sweep.store, options));
  ASSERT_FALSE(told.empty());
  for (const SweepProgress& at : told) {
    EXPECT_EQ(at.of, 500);
    EXPECT_EQ(at.stored, at.now) << "by this call";
    ASSERT_EQ(at.left.has_value(), at.now > 0);
    EXPECT_EQ(at.left.value_or(1.0) > 0.0, at.now < 500);
  }
  EXPECT_EQ(told.back().now, 500);
  // A second call has nothing to run.
  told.clear();
  EXPECT_TRUE(run_sweep(sweep.scenes, sweep.store, options));
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back().stored, 500);
  EXPECT_EQ(told.back().now, 0);
  EXPECT_EQ(told.back().left, 0.0);
}

}  // namespace
}  // namespace rotorub::sweep
