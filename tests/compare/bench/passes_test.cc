#include "compare/bench/error_pass.h"

#include <gtest/gtest.h>

#include "compare/bench/timing_pass.h"
#include "native_model/scene/reader.h"

namespace rotorub::bench {
namespace {

const Progress kSilent = [](double, const std::string&) {};

TEST(WallTime, IsMedianLowestHighest) {
  const WallTime odd = wall_time({3.0, 1.0, 2.0});
  EXPECT_EQ(odd.median, 2.0);
  EXPECT_EQ(odd.low, 1.0);
  EXPECT_EQ(odd.high, 3.0);
  EXPECT_EQ(odd.repeats, 3);
  EXPECT_EQ(wall_time({4.0, 1.0, 2.0, 100.0}).median, 3.0) << "one outlier does not move it";
}

TEST(Interleaved, TakesTheJobsInTurns) {
  std::vector<int> order;
  std::vector<std::function<double()>> jobs;
  for (int k = 0; k < 3; ++k) {
    jobs.push_back([k, &order] {
      order.push_back(k);
      return static_cast<double>(order.size());
    });
  }
  TimingParameters parameters;
  parameters.repeats = 2;
  const auto times = interleaved(jobs, {1e-3, 1e-3, 1e-3}, parameters, kSilent, nullptr);
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 0, 1, 2}));
  EXPECT_EQ(times[1].low, 2.0);
  EXPECT_EQ(times[1].high, 5.0);
  EXPECT_EQ(times[1].median, 3.5);
}

// What takes long is repeated less often, but not so seldom that a median means nothing.
TEST(Interleaved, SlowJobsAreRepeatedLess) {
  const TimingParameters parameters{20, 5, 20.0};
  EXPECT_EQ(repeats_of(1e-3, parameters), 20);
  EXPECT_EQ(repeats_of(1.0, parameters), 20);
  EXPECT_EQ(repeats_of(2.0, parameters), 10);
  EXPECT_EQ(repeats_of(100.0, parameters), 5);
  EXPECT_EQ(repeats_of(100.0, {3, 5, 20.0}), 3) << "never more than asked for";
}

TEST(Interleaved, AnInterruptedRunIsNoTime) {
  std::atomic<bool> interrupt{false};
  std::vector<std::function<double()>> jobs{[] { return 1.0; },
                                            [&] {
                                              interrupt = true;
                                              return 1e-9;
                                            }};
  const auto times = interleaved(jobs, {1.0, 1.0}, {3, 1, 1e9}, kSilent, &interrupt);
  EXPECT_EQ(times[0].repeats, 1);
  EXPECT_EQ(times[1].repeats, 0);
}

// ---------------------------------------------------------------- the error pass
class ErrorPass : public testing::Test {
 protected:
  ErrorPass()
      : scene_(std::make_shared<const scene::Scene>(
            scene::read_scene(std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml",
                              std::vector<std::string>{"run.end=0.02"}))),
        reference_(make_reference(*scene_, rows())) {}

  RunRequest rows() const {
    RunRequest r;
    r.output_times = common_times(scene_->run, {1e-4, 1e-5});
    return r;
  }
  Setting setting(scene::Integrator integrator, double step) const {
    return {"native", "", step, native_engine(integrator), scene_, ""};
  }

  std::shared_ptr<const scene::Scene> scene_;
  Reference reference_;
};

TEST_F(ErrorPass, FinerStepsAreMoreExactAndTheFinestIsTheLimit) {
  const auto points = error_pass(
      {setting(scene::Integrator::kVerlet, 1e-4), setting(scene::Integrator::kVerlet, 5e-5),
       setting(scene::Integrator::kVerlet, 1e-5)},
      reference_, kSilent, nullptr);
  ASSERT_EQ(points.size(), 3u);
  for (const Point& p : points) {
    EXPECT_EQ(p.judgement.outcome, Outcome::kOk) << p.judgement.reason;
    ASSERT_TRUE(p.finished());
    EXPECT_TRUE(p.metrics);
  }
  EXPECT_LT(points[1].errors->position, points[0].errors->position);
  EXPECT_LT(points[2].errors->position, points[1].errors->position);
  EXPECT_FALSE(points[2].limit_error) << "the finest has none to be compared with";
  // It converges to the reference: its distance to its own limit is its error, nearly.
  EXPECT_NEAR(*points[0].limit_error, points[0].errors->position, 0.1 * points[0].errors->position);
  EXPECT_LT(*points[1].limit_error, *points[0].limit_error);
}

class Throws final : public Engine {
 public:
  std::string name() const override { return "throws"; }
  Trajectory run(const scene::Scene&, const RunRequest&) const override {
    throw std::runtime_error("this engine holds no rotor");
  }
};

// A failure is a point with its reason, and the others go on.
TEST_F(ErrorPass, WhatFailsSaysWhy) {
  Setting refused = setting(scene::Integrator::kVerlet, 1e-5);
  refused.refusal = "no such variant";
  Setting throws = refused;
  throws.refusal = "";
  throws.runner = std::make_shared<Throws>();
  auto points = error_pass({refused, throws, setting(scene::Integrator::kVerlet, 1e-2),
                            setting(scene::Integrator::kVerlet, 1e-5)},
                           reference_, kSilent, nullptr);
  ASSERT_EQ(points.size(), 4u);
  EXPECT_EQ(points[0].judgement.outcome, Outcome::kRefused);
  EXPECT_EQ(points[0].judgement.reason, "no such variant");
  EXPECT_EQ(points[1].judgement.outcome, Outcome::kRefused);
  EXPECT_EQ(points[1].judgement.reason, "this engine holds no rotor");
  EXPECT_EQ(points[2].judgement.outcome, Outcome::kRefused) << "beyond the limit of the step";
  EXPECT_NE(points[2].judgement.reason.find("limit"), std::string::npos)
      << points[2].judgement.reason;
  EXPECT_FALSE(points[2].finished());
  EXPECT_TRUE(points[3].finished());

  timing_pass(points, {2, 1, 1.0}, kSilent, nullptr);
  EXPECT_EQ(points[0].wall.repeats, 0) << "nothing to time";
  EXPECT_EQ(points[2].wall.repeats, 0);
  EXPECT_EQ(points[3].wall.repeats, 2);
  EXPECT_GT(points[3].wall.median, 0.0);
}

}  // namespace
}  // namespace rotorub::bench
