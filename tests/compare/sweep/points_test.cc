// Points as ensembles and by themselves.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "compare/engine/engine.h"
#include "compare/sweep/ensemble_points.h"
#include "compare/sweep/point_run.h"
#include "compare/sweep/sample.h"
#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

using test::lasting;
using test::of_ring;
using test::sampled;
using test::StudyFolder;

const std::atomic<bool> kGoOn{false};

std::string frictions(const std::string& values) {
  return of_ring() + sampled("grid", {{"contact.friction", values}}) + lasting("60 ms", "20 us");
}

// A study in a folder of its own, and its points.
struct Made {
  StudyFolder folder;
  Study study;
  PointScenes scenes;
  explicit Made(const std::string& text, std::span<const std::string> set = {})
      : study(folder.study(text)), scenes(study, set) {}
};

std::vector<PointScene> all_points(const PointScenes& scenes) {
  std::vector<PointScene> points;
  for (std::int64_t i = 0; i < scenes.sample().size(); ++i) points.push_back({i, scenes.at(i)});
  return points;
}

std::vector<PointResult> ordered(std::vector<PointResult> results) {
  std::sort(results.begin(), results.end(),
            [](const PointResult& a, const PointResult& b) { return a.point < b.point; });
  return results;
}

std::unique_ptr<Engine> verlet() { return native_engine(scene::Integrator::kVerlet); }

// check(many, one): each point of an ensemble, and its run alone.
template <typename Check>
void expect_runs(const PointScenes& scenes, const Check& check) {
  const auto together = run_ensembles(all_points(scenes), kGoOn);
  ASSERT_EQ(together.size(), static_cast<std::size_t>(scenes.sample().size()));
  for (const PointResult& many : together) {
    SCOPED_TRACE(many.point);
    const auto one = run_single(many.point, scenes.at(many.point), *verlet(), kGoOn);
    ASSERT_TRUE(one && one->ok() && many.ok()) << many.reason;
    check(many, *one);
  }
}

// Every column, bit for bit.
void expect_same(const PointResult& a, const PointResult& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.reason, b.reason);
  ASSERT_EQ(a.ok(), b.ok());
  if (!a.ok()) return;
  for (const ResultColumn& column : result_columns()) {
    EXPECT_EQ(column.value(*a.figures).dump(), column.value(*b.figures).dump()) << column.name;
  }
}

TEST(EnsemblePoints, APointAmongOthersIsThePointAlone) {
  const Made made(frictions("[0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6]"));
  const auto points = all_points(made.scenes);
  const auto together = ordered(run_ensembles(points, kGoOn));
  ASSERT_EQ(together.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto alone = run_ensembles({points[i]}, kGoOn);
    ASSERT_EQ(alone.size(), 1u);
    expect_same(together[i], alone[0]);
  }
}

// `rotorub run` adds each impulse in two halves, and its time in contact is a sum of times where
// the ensemble counts steps: these figures agree to round-off. The first touch of an ensemble is
// the begin of its step.
TEST(EnsemblePoints, AreTheRunsOfTheEngine) {
  constexpr double kRoundOff = 1e-12;  // relative, of sums over 3000 steps
  const Made made(frictions("[0.1, 0.3]"));
  expect_runs(made.scenes, [&](const PointResult& many, const PointResult& one) {
    const Metrics &a = *many.figures, &b = *one.figures;
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(a.impacts, b.impacts);
    EXPECT_EQ(a.settled.attractor, b.settled.attractor);
    EXPECT_NEAR(a.settled.whirl_frequency, b.settled.whirl_frequency, 1e-6);
    EXPECT_NEAR(a.impulse_total, b.impulse_total, kRoundOff * b.impulse_total);
    EXPECT_NEAR(a.peak_force, b.peak_force, kRoundOff * b.peak_force);
    EXPECT_LE(*a.first_touch, *b.first_touch);
    EXPECT_NEAR(*a.first_touch, *b.first_touch, 20e-6);
  });
}

// Points of several contacts are in no lane, and in every figure the run alone.
TEST(EnsemblePoints, OfSeveralContactsAreTheirRuns) {
  const Made made(
      "scene = \"" ROTORUB_SOURCE_DIR "/tests/native_model/event/two_rings/rub.toml\"\n" +
      sampled("grid", {{"contact.friction", "[0.05, 0.2]"}}) + lasting("30 ms", "20 us"));
  std::vector<double> work;
  expect_runs(made.scenes, [&](const PointResult& many, const PointResult& one) {
    EXPECT_GT(many.figures->impacts, 0);
    expect_same(many, one);
    work.push_back(many.figures->friction_work);
  });
  ASSERT_EQ(work.size(), 2u);
  EXPECT_NE(work[0], work[1]);
}

// What a run watches of its impacts, its friction and its depth, of points that bounce, slide and
// stick. Sums over some thousand steps agree to round-off; the depth of lasting contact is
// round-off itself.
TEST(EnsemblePoints, HaveTheImpactsFrictionAndDepthOfARun) {
  constexpr double kRoundOff = 1e-11, kDepth = 1e-15;  // relative; m
  const Made made(of_ring() +
                  sampled("list", {{"contact.friction", "[0.1, 0.15, 0.3, 0.6, 0.15]"},
                                   {"contact.restitution", "[0.5, 0.9, 0.0, 0.5, 0.5]"},
                                   {"contact.radius", "[0.05, 0.05, 0.05, 0.002, 0.05]"},
                                   {"force[0].amplitude", "[150, 150, 300, 150, 1]"}}) +
                  lasting("60 ms", "20 us"));
  expect_runs(made.scenes, [&](const PointResult& many, const PointResult& one) {
    const Metrics &a = *many.figures, &b = *one.figures;
    EXPECT_NEAR(a.peak_impulse, b.peak_impulse, kRoundOff * b.peak_impulse);
    EXPECT_NEAR(a.friction_work, b.friction_work, kRoundOff * std::abs(b.friction_work));
    EXPECT_NEAR(a.max_penetration, b.max_penetration, kRoundOff * b.max_penetration + kDepth);
    EXPECT_EQ(a.peak_impulse > 0.0, many.point != 4) << "1 N never touches";
    EXPECT_EQ(a.friction_work < 0.0, many.point != 4);
  });
}

// What an ensemble does not keep is had by running one by one, and nothing else changes.
TEST(EnsemblePoints, AStudyMayAskForEveryFigure) {
  const auto results = [](const std::string& figures) {
    const Made made(frictions("[0.05, 0.15]") + "integrator = \"verlet\"\n" + figures);
    const std::vector<std::int64_t> points{0, 1};
    return ordered(run_batch(
        made.study, points, [&](std::int64_t k) { return made.scenes.at(k); }, kGoOn));
  };
  const auto few = results("figures = \"ensemble\"\n"), all = results("figures = \"all\"\n");
  ASSERT_EQ(few.size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_TRUE(std::isnan(few[k].figures->energy_residual));
    EXPECT_GT(all[k].figures->energy_residual, 0.0);
    EXPECT_LT(all[k].figures->energy_residual, 1e-3);
    EXPECT_NEAR(all[k].figures->impulse_total, few[k].figures->impulse_total,
                1e-9 * few[k].figures->impulse_total);
  }
}

// They are in contact as long as they take, with the force of that time.
TEST(EnsemblePoints, ImpactsThatTakeTimeHaveTheirDuration) {
  constexpr double kRoundOff = 1e-11;  // relative
  const Made made(of_ring() +
                  sampled("list", {{"contact.compression_time", R"(["20 us", "1 ms", "3 us"])"},
                                   {"contact.expansion_time", R"(["14 us", "0.5 ms", "2 us"])"}}) +
                  lasting("20 ms", "10 us"));
  expect_runs(made.scenes, [&](const PointResult& many, const PointResult& one) {
    const Metrics &a = *many.figures, &b = *one.figures;
    EXPECT_NEAR(a.peak_force, b.peak_force, kRoundOff * b.peak_force);
    EXPECT_NEAR(a.impulse_total, b.impulse_total, kRoundOff * b.impulse_total);
    // The first touch of an ensemble is the beginning of its step.
    EXPECT_NEAR(a.contact_fraction, b.contact_fraction, 2e-3 * b.contact_fraction);
    EXPECT_EQ(a.settled.contact_share, b.settled.contact_share);
  });
}

TEST(EnsemblePoints, OtherPartsStepsAndEndsComeApart) {
  const Made made(
      of_ring() +
      sampled("list", {{"run.step", R"(["20 us", "20 us", "40 us", "20 us"])"},
                       {"run.end", R"(["20 ms", "20 ms", "20 ms", "30 ms"])"},
                       {"gravity", R"(["none", "{acceleration = [0, -9.81]}", "none", "none"])"}}));
  const auto results = ordered(run_ensembles(all_points(made.scenes), kGoOn));
  ASSERT_EQ(results.size(), 4u);
  for (const PointResult& result : results) ASSERT_TRUE(result.ok()) << result.reason;
  EXPECT_EQ(results[0].figures->steps, 1000);
  EXPECT_NE(results[0].figures->impulse_total, results[1].figures->impulse_total);
  EXPECT_EQ(results[2].figures->steps, 500);
  EXPECT_EQ(results[3].figures->end, 0.03);
}

TEST(EnsemblePoints, FailuresSayWhatARunSays) {
  const Made made(of_ring() + sampled("list", {{"run.step", R"(["20 us", "10 ms"])"}}) +
                  "[run]\nend = \"20 ms\"\n");
  const auto points = all_points(made.scenes);
  const auto results = ordered(run_ensembles(points, kGoOn));
  EXPECT_TRUE(results[0].ok());
  EXPECT_EQ(results[1].status, "step_too_large");
  const auto alone = run_single(1, points[1].scene, *verlet(), kGoOn);
  EXPECT_EQ(results[1].reason, alone->reason);
  EXPECT_FALSE(alone->reason.empty());
}

TEST(EnsemblePoints, InterruptedTheyAreNoResults) {
  const Made made(frictions("[0.1, 0.2]"));
  const std::atomic<bool> stop{true};
  EXPECT_TRUE(run_ensembles(all_points(made.scenes), stop).empty());
}

TEST(PointScenes, AreThoseOfSet) {
  const std::string set[] = {"contact.friction=0.2"};
  const Made made(of_ring() + R"([sample]
kind = "grid"
[[vary]]
key = "rotor.speed"
also = ["drive.speed"]
values = ["40 Hz", 12.5]
)",
                  set);
  const scene::Scene point = made.scenes.at(1);
  EXPECT_EQ(point.rotor.speed, 12.5);
  EXPECT_EQ(point.drive->speed, 12.5);
  EXPECT_EQ(point.first().contact->friction.coefficient, 0.2);
  const std::string twice[] = {"rotor.speed=3"};
  EXPECT_THROW(PointScenes(made.study, twice), scene::SceneError);
}

TEST(PointScenes, OfTheShippedStudies) {
  const auto point_of = [](const std::string& name, std::int64_t size, std::int64_t index) {
    const Study study = read_study(std::string(ROTORUB_MJCF_DIR) + "/studies/" + name);
    const PointScenes scenes(study, {});
    EXPECT_EQ(scenes.sample().size(), size);
    EXPECT_NO_THROW(scenes.check());
    return scenes.at(index);
  };
  const scene::Scene last = point_of("speed_friction.toml", 25 * 31, 25 * 31 - 1);
  EXPECT_EQ(last.rotor.speed, last.drive->speed);
  EXPECT_EQ(last.rotor.speed, last.forces[0].frequency);
  const scene::Scene point = point_of("high_friction.toml", 5 * 15, 2 * 15 + 14);
  EXPECT_DOUBLE_EQ(point.drive->gain, 1.0);
  EXPECT_DOUBLE_EQ(point.first().contact->friction.coefficient, 1.5);
  EXPECT_EQ(point.rotor.torsion->modes, 4);
}

// As in the summary of a run: `event` has no step whose impulse a force could be of.
TEST(ResultColumns, HaveAPeakForceOfAFixedStepAlone) {
  const Made made(frictions("[0.1]"));
  const auto column = std::ranges::find_if(
      result_columns(), [](const ResultColumn& c) { return c.name == "peak_force"; });
  ASSERT_NE(column, result_columns().end());
  for (const auto& [integrator, has] :
       {std::pair{scene::Integrator::kEvent, false}, std::pair{scene::Integrator::kVerlet, true}}) {
    const auto one = run_single(0, made.scenes.at(0), *native_engine(integrator), kGoOn);
    ASSERT_TRUE(one && one->ok());
    EXPECT_EQ(column->value(*one->figures).is_number(), has);
  }
  const auto many = run_ensembles(all_points(made.scenes), kGoOn);
  EXPECT_TRUE(column->value(*many.at(0).figures).is_number());
}

TEST(PointScenes, AStudyThatNothingCanComeOfIsRefused) {
  EXPECT_THROW(Made(frictions("[-1, -2, -3]")).scenes.check(), scene::SceneError);
  EXPECT_NO_THROW(Made(frictions("[-1, 0.1]")).scenes.check());
}

}  // namespace
}  // namespace rotorub::sweep
