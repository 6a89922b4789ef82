// Points of a study, each its own run.
#include <algorithm>
#include <atomic>
#include <nlohmann/json.hpp>
#include <span>

#include "compare/sweep/point_run.h"
#include "compare/sweep/sample.h"
#include "native_model/scene/diagnostic.h"
#include "tests/compare/sweep/studies.h"
#include "tests/support/native_run.h"

namespace rotorub::sweep {
namespace {

using test::of_ring;
using test::StudyFolder;

const std::atomic<bool> kGoOn{false};

std::string frictions(const std::string& values) {
  return of_ring() +
         "[sample]\nkind = \"grid\"\n[[vary]]\nkey = \"contact.friction\"\nvalues = " + values +
         "\n[run]\nend = \"60 ms\"\nstep = \"20 us\"\n";
}

// A study in a folder of its own, and its points.
struct Made {
  StudyFolder folder;
  Study study;
  PointScenes scenes;
  explicit Made(const std::string& text, std::span<const std::string> set = {})
      : study(folder.study(text)), scenes(study, set) {}
};

std::vector<PointResult> all_points(const Made& made, const std::atomic<bool>& interrupt = kGoOn) {
  return run_points(
      made.study, made.scenes.sample().size(), [&](std::int64_t k) { return made.scenes.at(k); },
      interrupt);
}

PointResult alone(const Made& made, std::int64_t point) {
  const auto result = run_point(
      made.study, point, [&](std::int64_t k) { return made.scenes.at(k); }, kGoOn);
  EXPECT_TRUE(result);
  return result.value_or(PointResult{});
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

// On whichever thread it ran, a point equals the run alone.
TEST(Points, APointAmongOthersIsThePointAlone) {
  const Made made(frictions("[0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6]") +
                  "integrator = \"verlet\"\n");
  const std::vector<PointResult> together = all_points(made);
  ASSERT_EQ(together.size(), 9u);
  for (const PointResult& many : together) {
    SCOPED_TRACE(many.point);
    expect_same(many, alone(made, many.point));
    EXPECT_GT(many.figures->energy_residual, 0.0);
    EXPECT_LT(many.figures->energy_residual, 1e-3);
  }
}

TEST(Points, OfSeveralContactsAreTheirRuns) {
  const Made made("scene = \"" + std::string(ROTORUB_SOURCE_DIR) +
                  R"(/tests/native_model/event/two_rings/rub.toml"
[sample]
kind = "grid"
[[vary]]
key = "contact.friction"
values = [0.05, 0.2]
[run]
integrator = "verlet"
end = "30 ms"
step = "20 us"
)");
  const std::vector<PointResult> points = all_points(made);
  ASSERT_EQ(points.size(), 2u);
  for (const PointResult& point : points) {
    ASSERT_TRUE(point.ok()) << point.reason;
    EXPECT_GT(point.figures->impacts, 0);
  }
  EXPECT_NE(points[0].figures->friction_work, points[1].figures->friction_work);
}

TEST(Points, MayDifferInPartsStepsAndEnds) {
  const Made made(of_ring() + R"([sample]
kind = "list"
[[vary]]
key = "run.step"
values = ["20 us", "20 us", "40 us", "20 us"]
[[vary]]
key = "run.end"
values = ["20 ms", "20 ms", "20 ms", "30 ms"]
[[vary]]
key = "gravity"
values = ["none", "{acceleration = [0, -9.81]}", "none", "none"]
[run]
integrator = "verlet"
)");
  const auto results = all_points(made);
  ASSERT_EQ(results.size(), 4u);
  for (const PointResult& result : results) ASSERT_TRUE(result.ok()) << result.reason;
  EXPECT_EQ(results[0].figures->steps, 1000);
  EXPECT_NE(results[0].figures->impulse_total, results[1].figures->impulse_total);
  EXPECT_EQ(results[2].figures->steps, 500);
  EXPECT_EQ(results[3].figures->end, 0.03);
}

TEST(Points, FailuresSayWhatARunSays) {
  const Made made(of_ring() + R"([sample]
kind = "list"
[[vary]]
key = "run.step"
values = ["20 us", "10 ms"]
[run]
integrator = "verlet"
end = "20 ms"
)");
  const auto results = all_points(made);
  EXPECT_TRUE(results[0].ok());
  EXPECT_EQ(results[1].status, "step_too_large");
  EXPECT_EQ(results[1].reason,
            test::attempt_with(made.scenes.at(1), scene::Integrator::kVerlet, 10e-3).message);
  EXPECT_FALSE(results[1].reason.empty());
}

TEST(Points, InterruptedTheyAreNoResults) {
  const std::atomic<bool> stop{true};
  for (const PointResult& point : all_points(Made(frictions("[0.1, 0.2]")), stop)) {
    EXPECT_EQ(point.status, "");
  }
}

// The key selected between runs side by side, with few figures, and single runs.
TEST(Points, AStudyMaySayWhichFiguresAreKeptAsBefore) {
  testing::internal::CaptureStderr();
  const Made made(frictions("[0.1]") + "figures = \"ensemble\"\n");
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("note: run.figures: this key has no effect"), std::string::npos) << said;
  EXPECT_TRUE(all_points(made).at(0).ok());
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

TEST(PointScenes, OfTheShippedStudy) {
  const Study study = read_study(std::string(ROTORUB_MJCF_DIR) + "/studies/speed_friction.toml");
  const PointScenes scenes(study, {});
  EXPECT_EQ(scenes.sample().size(), 25 * 31);
  EXPECT_NO_THROW(scenes.check());
  const scene::Scene last = scenes.at(scenes.sample().size() - 1);
  EXPECT_EQ(last.rotor.speed, last.drive->speed);
  EXPECT_EQ(last.rotor.speed, last.forces[0].frequency);
}

TEST(PointScenes, OfHighFriction) {
  const Study study = read_study(std::string(ROTORUB_MJCF_DIR) + "/studies/high_friction.toml");
  const PointScenes scenes(study, {});
  EXPECT_EQ(scenes.sample().size(), 5 * 15);
  EXPECT_NO_THROW(scenes.check());
  const scene::Scene point = scenes.at(2 * 15 + 14);
  EXPECT_DOUBLE_EQ(point.drive->gain, 1.0);
  EXPECT_DOUBLE_EQ(point.first().contact->friction.coefficient, 1.5);
  EXPECT_EQ(point.rotor.torsion->modes, 4);
}

// As in the summary of a run: `event` has no fixed step over which to average an impulse.
TEST(ResultColumns, HaveAPeakForceOfAFixedStepAlone) {
  const auto column = std::ranges::find_if(
      result_columns(), [](const ResultColumn& c) { return c.name == "peak_force"; });
  ASSERT_NE(column, result_columns().end());
  for (const auto& [integrator, has] : {std::pair{"event", false}, std::pair{"verlet", true}}) {
    const Made made(frictions("[0.1]") + "integrator = \"" + integrator + "\"\n");
    EXPECT_EQ(column->value(*alone(made, 0).figures).is_number(), has);
  }
}

TEST(PointScenes, AStudyThatNothingCanComeOfIsRefused) {
  EXPECT_THROW(Made(frictions("[-1, -2, -3]")).scenes.check(), scene::SceneError);
  EXPECT_NO_THROW(Made(frictions("[-1, 0.1]")).scenes.check());
}

}  // namespace
}  // namespace rotorub::sweep
