#include "compare/study/scene_comparison.h"
#include "compare/base/json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/report/page.h"
#include "compare/study/answer.h"
#include "compare/study/result.h"
#include "compare/study/verdict.h"
#include "native_model/trajectory/recorder.h"
#include "tests/compare/hand_made.h"
#include "tests/support/native_run.h"
#include "tests/support/page.h"

namespace rotorub {
namespace {

// bench_ring settles to a sliding contact at about 10 ms: long enough to compare, quick to run.
const SceneComparison& short_comparison() {
  static const SceneComparison comparison = [] {
    CompareOptions options;
    options.timing_repeats = 1;
    options.tolerance = 0.05;
    return compare_scene(test::shipped("bench_ring", {"run.end=0.06"}), options);
  }();
  return comparison;
}

const ComparedModel& difference(const std::string& label) {
  return *std::ranges::find_if(short_comparison().models,
                               [&](const ComparedModel& m) { return m.run.label == label; });
}

TEST(SceneComparison, RunsAndTimesEverySide) {
  const SceneComparison& c = short_comparison();
  std::vector<std::string> labels;
  for (const Side* s : c.sides()) {
    labels.push_back(s->label);
    EXPECT_EQ(s->trajectory.status, Status::kOk) << s->trajectory.message;
    EXPECT_EQ(s->trajectory.end, 0.06);
    EXPECT_EQ(s->limits.size(), figures().size());
    EXPECT_GT(s->timing.median, 0.0);
    EXPECT_LE(s->timing.lowest, s->timing.median);
    // The shown run was computed beside others, so its time comes from runs that were computed
    // alone.
    ASSERT_EQ(s->timing.us_per_step.size(), 1U) << s->label;
    const double seconds = 1e-6 * s->timing.median * static_cast<double>(s->metrics.steps);
    EXPECT_EQ(s->trajectory.wall_s, seconds) << s->label;
    EXPECT_EQ(s->metrics.us_per_step, s->timing.median) << s->label;
    EXPECT_EQ(s->metrics.real_time_factor, s->metrics.end / seconds) << s->label;
  }
  // Native, then the contact model that decides, then those that are shown beside it.
  EXPECT_EQ(labels[0], "native");
  EXPECT_EQ(labels[1], to_string(kDefaultContact));
  for (const char* label : {"coulomb", "cone"}) {
    EXPECT_EQ(std::count(labels.begin(), labels.end(), label), 1) << label;
  }
  EXPECT_EQ(c.status(), Status::kOk);
  EXPECT_FALSE(c.interrupted);
}

TEST(SceneComparison, SplitsAddUp) {
  for (const ComparedModel& m : short_comparison().models) {
    for (const FigureDifference& f : m.figures) {
      if (std::isnan(f.native) || std::isnan(f.other))
        continue;  // one of the runs has not this figure
      const Split& s = f.split;
      const double scale = std::abs(f.native) + std::abs(f.other) + 1e-300;
      EXPECT_NEAR(s.model_gap + s.step_error - s.native_step_error, f.other - f.native,
                  1e-9 * scale)
          << f.figure->key;
    }
  }
}

TEST(SceneComparison, JsonAndTableHaveWhatTheContractNames) {
  const result::Section told = comparison_result(short_comparison());
  const nlohmann::json j = result::json_of(told);
  EXPECT_EQ(j.at("scene"), "bench_ring");
  for (const char* side : {"native", "rigid", "coulomb", "cone", "cone-coulomb"}) {
    const auto& summary = j.at("runs").at(side).at("summary");
    for (const char* key :
         {"program", "version", "mujoco_version", "scene", "scene_hash", "engine", "integrator",
          "contact_model", "step", "steps", "wall_s", "us_per_step", "max_penetration",
          "contact_fraction", "impulse_total", "energy_residual", "status", "message"}) {
      EXPECT_TRUE(summary.contains(key)) << key;
    }
    EXPECT_EQ(summary.at("status"), "ok");
  }
  EXPECT_TRUE(j.at("differences").at("cone").at("figures").at("mean_force").contains("split"));
  const std::string split =
      result::text_of(told).substr(result::text_of(told).find("split of the"));
  EXPECT_EQ(split.find("rigid    largest impulse"), std::string::npos)
      << "a figure that a run lacks has no row\n"
      << split;
  EXPECT_FALSE(j.dump().empty());
  const std::string table = result::text_of(told);
  for (const char* text :
       {"bench_ring", "native", "rigid", "coulomb", "cone", "mean normal force, N",
        "lasting contact, %", "total impulse, N s", "cone bounces: it is in lasting contact",
        "trusted", "µs a step", "MuJoCo alone? (cone)", "with the corrected cone? (cone-coulomb)",
        "with the rigid law? (rigid)", "The exit code refers to rigid"}) {
    EXPECT_NE(table.find(text), std::string::npos) << text;
  }
}

// Softness takes the force off an impact over a step, which is no number of the rigid law, and
// leaves its impulse.
TEST(SceneComparison, AnImpactIsJudgedByItsImpulse) {
  EXPECT_EQ(difference("rigid").trust, Trust::kYes) << why(difference("rigid").judged(), 0.05);
  EXPECT_EQ(difference("coulomb").trust, Trust::kYes) << why(difference("coulomb").judged(), 0.05);
  for (const FigureDifference& f : difference("coulomb").figures) {
    if (std::string(f.figure->key) != "peak_force") continue;
    EXPECT_LT(f.deviation, -0.5);
    EXPECT_EQ(f.verdict, FigureVerdict::kNotJudged);
  }
}

TEST(SceneComparison, BeginsWithOneRowAContactModel) {
  const SceneComparison& c = short_comparison();
  ASSERT_EQ(c.models.size(), 5U);
  for (const ComparedModel& m : c.models) {
    const AnswerRow row = answer_row(c, m);
    EXPECT_EQ(row.decides, row.contact == "rigid");
    EXPECT_GT(row.us_per_step, 0.0);
    EXPECT_FALSE(row.why.empty());
    EXPECT_EQ(row.evidence.empty(), row.contact != "rigid") << "it alone shares the native step";
  }
  const auto json_rows = result::json_of(comparison_result(c)).at("answer");
  EXPECT_EQ(json_rows.at(0).at("evidence"), answer_row(c, c.models[0]).evidence);
  EXPECT_TRUE(json_rows.at(1).at("evidence").is_null());
  const std::string table = result::text_of(comparison_result(c));
  EXPECT_LT(table.find("MuJoCo alone? (cone)"), table.find("with the rigid law? (rigid)"));
  EXPECT_LT(table.find("with the rigid law? (rigid)"), table.find("mean normal force, N"));
  const std::string text = json_text(result::json_of(comparisons_result({c})));
  EXPECT_EQ(text.find("\"answer\""), text.find('"')) << text.substr(0, 100);
  const std::string page = report_page({{&c, {}, "none in this test."}});
  EXPECT_NE(table.find("rigid has the law and the step of native verlet"), std::string::npos);
  EXPECT_NE(page.find("rigid has the law and the step of native verlet"), std::string::npos);
}

// MuJoCo alone comes first, in words, and the models that the plugin solves come last.
TEST(SceneComparison, AnswersInASentence) {
  const SceneComparison& c = short_comparison();
  std::vector<std::string> order;
  for (const ComparedModel* m : reading_order(c)) order.push_back(m->run.label);
  EXPECT_EQ(order,
            (std::vector<std::string>{"cone", "cone-default", "cone-coulomb", "coulomb", "rigid"}));
  const std::vector<AnswerRow> rows = sentence_rows(c);
  ASSERT_EQ(rows.size(), 4U) << "without the default solref";
  EXPECT_EQ(rows.front().question, "MuJoCo alone");
  EXPECT_STREQ(rows.front().verdict.word, "no");
  EXPECT_FALSE(rows.front().plain.empty());
  EXPECT_EQ(rows.back().question, "with the rigid law");
  EXPECT_STREQ(rows.back().verdict.word, "yes");
  EXPECT_EQ(rows.back().plain, "");
}

// The page: one file, no address that a browser would fetch from, plots and their data inside.
TEST(Report, StandsAlone) {
  const std::string page = report_page({{&short_comparison(), {}, "none in this test."}});
  const std::string own = test::expect_self_contained(page);
  EXPECT_GT(page.size() - own.size(), 800000U) << "the scripts that draw";
  EXPECT_NE(own.find("none in this test."), std::string::npos);

  const std::string open = "<script id=\"data\" type=\"application/json\">";
  const std::size_t from = own.find(open) + open.size();
  const auto data = nlohmann::json::parse(own.substr(from, own.find("</script>", from) - from));
  ASSERT_EQ(data.at("scenes").size(), 1U);
  const auto& native = data.at("scenes")[0].at("sides")[0];
  EXPECT_EQ(native.at("label"), "native");
  for (const char* track :
       {"rotor", "ring", "gap", "normal", "friction", "mode", "spin", "spin_speed", "impacts"}) {
    EXPECT_GT(native.at("tracks").at(track).at("knots"), 1) << track;
    EXPECT_GT(native.at("tracks").at(track).at("data").get<std::string>().size(), 3U) << track;
  }
  ASSERT_EQ(data.at("scenes")[0].at("contacts").size(), 1U);
  EXPECT_TRUE(data.at("scenes")[0].at("contacts")[0].at("ring_moves"));
}

TEST(SceneComparison, AnInterruptKeepsWhatThereIs) {
  const std::atomic<bool> stop{true};
  CompareOptions options;
  options.interrupt = &stop;
  const SceneComparison c = compare_scene(
      test::shipped("bench_ring", {"run.end=0.06", "run.integrator=verlet"}), options);
  EXPECT_TRUE(c.interrupted);
  ASSERT_EQ(c.sides().size(), 1U);
  EXPECT_EQ(c.native.trajectory.status, Status::kInterrupted);
  EXPECT_EQ(c.status(), Status::kInterrupted);
  EXPECT_FALSE(c.within());
}

TEST(DenseTimes, HoldEveryRequestedTimeAndAreBounded) {
  scene::Run run;
  run.end = 0.5;
  run.step = 1e-5;
  run.output_times = {0.1234567};
  const auto times = dense_times(run, 5000);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(std::adjacent_find(times.begin(), times.end()), times.end());
  for (const double t : output_times(run)) {
    EXPECT_TRUE(std::binary_search(times.begin(), times.end(), t)) << t;
  }
  EXPECT_LE(times.size(), 5000U + output_times(run).size() + 1);
  EXPECT_EQ(times.back(), run.end);
}

TEST(RowsAt, KeepsTheWantedRowsAlone) {
  const Trajectory all = test::hand_made(11, 0.5, [](double t) {
    test::Row row;
    row.x = 10.0 * t;
    return row;
  });
  const Trajectory some = rows_at(all, {1.0, 1.1, 2.5});
  EXPECT_EQ(some.column("t"), (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(some.column("rotor_x"), (std::vector<double>{10.0, 25.0}));
}

// Without a touch nothing is judged.
TEST(SceneComparison, NoContactIsNoPraise) {
  CompareOptions options;
  options.timing_repeats = 1;
  SceneComparison c =
      compare_scene(test::shipped("bench_ring", {"run.end=0.02", "force[0].amplitude=1"}), options);
  ASSERT_FALSE(c.models.empty());
  EXPECT_TRUE(c.within());
  const std::string said = headline(c, c.models[0]);
  EXPECT_EQ(said.find("trusted"), std::string::npos) << said;
  EXPECT_NE(said.find("Nothing touches"), std::string::npos) << said;
  for (const ComparedModel& m : c.models)
    EXPECT_STREQ(answer_row(c, m).verdict.word, "no contact") << m.run.label;
  const std::string text = result::text_of(comparison_result(c));
  EXPECT_NE(text.find("no contact     Nothing touches in 20 ms (least gap "), std::string::npos);
  EXPECT_NE(text.find("least gap, µm"), std::string::npos) << text;
  // There is neither a table of zeros, nor the same sentence for every contact model.
  EXPECT_EQ(text.find("mean normal force"), std::string::npos) << text;
  EXPECT_EQ(text.find("Nothing touches", text.find("Nothing touches") + 1), std::string::npos);
  EXPECT_TRUE(result::json_of(comparison_result(c))
                  .at("differences")
                  .at("cone")
                  .at("figures")
                  .contains("mean_force"));
  // Nor are there headings of a table without rows.
  EXPECT_NE(text.find("split of the difference"), std::string::npos);
  for (ComparedModel& m : c.models)
    for (FigureDifference& d : m.figures) d.split.difference = std::nan("");
  const std::string bare = result::text_of(comparison_result(c));
  EXPECT_EQ(bare.find("split of the difference"), std::string::npos) << bare;
}

// One unit in the last place of the clearance survives the first sums, whatever the start.
TEST(Perturbed, MovesTheStartByAlmostNothing) {
  const scene::Scene scene = test::shipped("bench_ring");
  const scene::Scene moved = perturbed(scene, 1);
  ASSERT_FALSE(moved.initial.x.empty());
  const double by = moved.initial.x[0] - (scene.initial.x.empty() ? 0.0 : scene.initial.x[0]);
  EXPECT_GT(by, 0.0);
  EXPECT_LT(by, 1e-18);
  EXPECT_EQ(perturbed(scene, 0).initial.x, scene.initial.x);
}

}  // namespace
}  // namespace rotorub
