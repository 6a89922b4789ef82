// Contact by contact: distributions by hand, predictions against closed forms, and the contact
// models of MuJoCo from the same onsets.
#include "compare/study/resync.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/study/answer.h"
#include "compare/study/result.h"
#include "compare/study/resync_text.h"
#include "native_model/control/library.h"
#include "tests/compare/columns.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

// The tests open only their own libraries.
[[maybe_unused]] const bool resync_trusts = (set_scene_libraries(SceneLibraries::kAllowed), true);

using test::shipped;

// ---------------------------------------------------------------- distributions

// At `touch` with 10 ms to itself: native 2 N s in one impact, 1000 N, 1 ms, 0.1 m/s out of 0.2.
PredictedOnset made(double touch) {
  PredictedOnset o;
  o.touch = touch;
  o.end = touch + 0.01;
  o.closing = 0.2;
  o.native = {2.0, 1000.0, 1e-3, 0.1};
  o.mujoco = o.native;
  o.largest_impact = 2.0;
  return o;
}

const ResyncRow& row(const Resync& r, const std::string& key) {
  for (const ResyncRow& row : r.rows) {
    if (key == row.figure->key) return row;
  }
  throw std::invalid_argument(key);
}

TEST(JudgeResync, DistributionsByHand) {
  std::vector<PredictedOnset> onsets;
  for (int k = 0; k < 10; ++k) {
    onsets.push_back(made(k));
    onsets.back().mujoco.impulse *= 1.0 + 1e-3 * k;  // 0 to 0.9 %
  }
  onsets[4].mujoco.impulse = 2.0 * (1.0 - 0.02);
  const Resync r = judge_resync(onsets, true, 0.01);
  const ResyncRow& impulse = row(r, "impulse");
  // 0, 1, 2, 3, 5, 6, 7, 8, 9 and 20 thousandths.
  EXPECT_NEAR(impulse.median, 0.005, 1e-12);
  EXPECT_NEAR(impulse.ninetieth, 0.009, 1e-12);
  EXPECT_NEAR(impulse.worst, 0.02, 1e-12);
  EXPECT_NEAR(impulse.worst_signed, -0.02, 1e-12);
  EXPECT_EQ(impulse.worst_time, 4.0);
  EXPECT_NEAR(impulse.native, 2.0, 1e-12);
  EXPECT_NEAR(impulse.bias, (0.041 - 0.02) / 10.0, 1e-12);
  EXPECT_EQ(impulse.verdict, FigureVerdict::kOutside);
  EXPECT_EQ(row(r, "window_impulse").worst, 0.0);
  EXPECT_EQ(row(r, "window_impulse").verdict, FigureVerdict::kWithin);
  // One contact is off, but the sum is not.
  EXPECT_EQ(r.trust, Trust::kAveragesOnly);
  EXPECT_NE(why(r, 0.01).find("impulse -2 %"), std::string::npos) << why(r, 0.01);
}

// A grazing touch counts relative to the other contacts of the run, a long contact relative to
// itself.
TEST(JudgeResync, WhatADifferenceIsAShareOf) {
  std::vector<PredictedOnset> onsets{made(0.0), made(1.0), made(2.0)};
  onsets[1].native = {0.02, 10.0, 0.0, 0.001};  // a hundredth of the others
  onsets[1].largest_impact = 0.02;
  onsets[1].mujoco = {0.03, 20.0, 5e-4, 0.003};  // half as much again, twice, late, thrice
  onsets[2].native.impulse = 40.0;               // it lasts
  onsets[2].mujoco.impulse = 40.2;
  const Resync r = judge_resync(onsets, true, 0.01);
  EXPECT_NEAR(r.largest_impact, 2.0, 1e-15);
  EXPECT_NEAR(row(r, "impulse").worst, 0.01 / 2.0, 1e-12);  // the third: 0.2 / 40, as much
  EXPECT_NEAR(row(r, "window_impulse").worst, 10.0 / 1000.0, 1e-12);
  EXPECT_NEAR(row(r, "duration").worst, 5e-4 / 0.01, 1e-12);
  EXPECT_NEAR(row(r, "rebound").worst, 0.002 / 0.2, 1e-12);
}

TEST(JudgeResync, EveryKindOfTrust) {
  EXPECT_EQ(judge_resync({made(0.0)}, true, 0.01).trust, Trust::kYes);
  EXPECT_EQ(judge_resync({}, false, 0.01).trust, Trust::kYes) << "nothing touches";
  EXPECT_EQ(judge_resync({}, true, 0.01).trust, Trust::kUndecidable) << "contact without an onset";

  PredictedOnset off = made(0.0);
  off.mujoco.impulse *= 1.5;
  EXPECT_EQ(judge_resync({off}, true, 0.01).trust, Trust::kNo);

  PredictedOnset failed = made(0.0);
  failed.status = Status::kNoSolution;
  failed.message = "jammed";
  const Resync r = judge_resync({made(1.0), failed}, true, 0.01);
  EXPECT_EQ(r.trust, Trust::kNo);
  EXPECT_EQ(r.failed, 1);
  EXPECT_NE(why(r, 0.01).find("jammed"), std::string::npos);
  EXPECT_EQ(row(r, "impulse").native, 2.0) << "of those that ended well";
}

// ---------------------------------------------------------------- predictions

// bench_drop, 2 kg under 19.62 N against a fixed ring with restitution 1/2: from a state before the
// touch the speed there is sqrt(v^2 + 2 a g), the impulse 3/2 m of it and the rebound half of it.
TEST(Predict, TheDropByItsClosedForm) {
  const scene::Scene scene = shipped("bench_drop", {"run.end=0.05"});
  const Model model = prepare(scene);
  Onset onset;
  onset.before = initial_state(model);
  onset.before.t = 0.013;
  onset.before.q[0] = 4.9e-4;
  onset.before.v[0] = 0.05;
  onset.touch = 0.0131;
  onset.end = 0.014;
  const Eigen::Vector2d load = model.forces.front().vector;
  if (std::abs(load.y()) > std::abs(load.x())) {  // along whichever axis it falls
    std::swap(onset.before.q[0], onset.before.q[1]);
    std::swap(onset.before.v[0], onset.before.v[1]);
  }
  const double sign = load.sum() > 0.0 ? 1.0 : -1.0;
  onset.before.q *= sign;
  onset.before.v *= sign;
  const auto predicted = predict(scene, {onset}, nullptr, 1e-5);
  ASSERT_EQ(predicted.size(), 1U);
  const PredictedOnset& o = predicted[0];
  ASSERT_EQ(o.status, Status::kOk) << o.message;
  const double v = std::sqrt(0.05 * 0.05 + 2.0 * 9.81 * 1e-5);
  EXPECT_NEAR(o.native.impulse, 2.0 * 1.5 * v, 1e-11);
  EXPECT_NEAR(o.native.rebound, 0.5 * v, 1e-11);
  EXPECT_EQ(o.native.window_impulse, o.native.impulse);
  EXPECT_EQ(o.native.duration, 0.0);
  EXPECT_EQ(o.largest_impact, o.native.impulse);
}

// ---------------------------------------------------------------- whole comparisons

SceneComparison resync_of(const std::string& name, const std::vector<std::string>& overrides) {
  CompareOptions options;
  options.mode = CompareMode::kResync;
  options.timing_repeats = 1;
  return compare_scene(shipped(name, overrides), options);
}

const SceneComparison& ring() {
  static const SceneComparison c = resync_of("bench_ring", {"run.end=0.03"});
  return c;
}

// From the same state the same law gives the same impact; a soft contact spreads it.
TEST(Resync, RigidIsRightContactByContactAndSoftIsNot) {
  const SceneComparison& c = ring();
  ASSERT_EQ(c.models.size(), 5U);
  const Resync& rigid = *c.models[0].resync;
  ASSERT_GE(rigid.onsets.size(), 4U);
  EXPECT_LT(row(rigid, "impulse").worst, 1e-3);
  EXPECT_LT(row(rigid, "rebound").worst, 1e-3);
  EXPECT_EQ(c.models[0].trust, Trust::kYes) << why(rigid, c.tolerance);
  EXPECT_TRUE(c.within());
  const Resync& coulomb = *c.models[1].resync;
  ASSERT_EQ(c.models[1].run.label, "coulomb");
  EXPECT_LT(row(coulomb, "window_impulse").median, 0.05)
      << "however many steps an impact is spread over";
  EXPECT_GT(row(coulomb, "duration").median, row(rigid, "duration").median);
  EXPECT_NE(c.models[1].trust, Trust::kYes);
}

// An elastic billiard is chaos for a long run, and 1 + eps on every single impact of it.
TEST(Resync, EveryImpactOfTheBilliard) {
  const SceneComparison c = resync_of("bench_billiard", {"run.end=0.05"});
  const Resync& rigid = *c.models[0].resync;
  ASSERT_GT(rigid.onsets.size(), 10U);
  EXPECT_LT(row(rigid, "impulse").worst, 1e-6);
  EXPECT_LT(row(rigid, "rebound").worst, 1e-6);
  // From (0.1 mm, 0) with (0.3, 0.4) m/s: momentum about the centre and speed are kept.
  const double tangential = 1e-4 * 0.4 / 5e-4, normal = std::sqrt(0.25 - tangential * tangential);
  for (const PredictedOnset& o : rigid.onsets) EXPECT_NEAR(o.native.rebound, normal, 1e-9);
}

// The commands are those that MuJoCo used.
TEST(Resync, ReplaysTheCommandsInside) {
  const SceneComparison c =
      resync_of("bench_ring", {"run.end=0.02", "controller.kind=passive",
                               "controller.stiffness=5e4", "controller.damping=100"});
  EXPECT_TRUE(c.commands);
  EXPECT_NE(mode_note(c).find("MuJoCo's commands"), std::string::npos);
  const Resync& rigid = *c.models[0].resync;
  ASSERT_GE(rigid.onsets.size(), 3U);
  EXPECT_LT(row(rigid, "impulse").worst, 1e-3);
}

// Restarted from the same state before each impact, under every law: its impulse within 1 % of the
// largest.
void expect_right_impulses(const std::string& name, const std::vector<std::string>& more) {
  SCOPED_TRACE(name + (more.empty() ? "" : " " + more.front()));
  // With the excitation 80 ms earlier, what comes before it is not a contact.
  std::vector<std::string> overrides{"run.end=0.04", "run.step=2.5us", "force[0].on=0.02"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const SceneComparison c = resync_of(name, overrides);
  ASSERT_EQ(c.status(), Status::kOk);
  const Resync& rigid = *c.models[0].resync;
  ASSERT_GE(rigid.onsets.size(), 1U);
  EXPECT_EQ(rigid.failed, 0) << rigid.failure;
  EXPECT_LT(row(rigid, "impulse").worst, 0.01) << "at " << row(rigid, "impulse").worst_time;
}

// A sampled law behind coils that lag, and a user's law.
TEST(ResyncLong, ImpulsesUnderSampledLawsAreRight) {
  expect_right_impulses("paper_magnetic", {"controller.on=0.023", "controller.sample_time=100us",
                                           "actuator.coil_lag=0.1ms", "controller.preload=30"});
  expect_right_impulses("examples/own_controller", {std::string("controller.library=") +
                                                    ROTORUB_LIBRARIES + "/own_controller.so"});
}

TEST(ResyncNightly, EveryLawsImpulsesAreRight) {
  const std::pair<const char*, std::vector<std::string>> laws[] = {
      {"paper_passive", {}},
      {"paper_emulated", {}},
      {"paper_sliding", {"controller.on=0.023"}},
      {"paper_sliding",
       {"controller.on=0.023", "controller.sample_time=100us", "controller.preload=30"}},
      {"paper_two_phase", {}},
      {"paper_cross_coupled", {}},
      {"paper_passive",
       {"controller.kind=pd", "controller.on=0.023", "controller.stiffness=5e4",
        "controller.damping=300"}}};
  for (const auto& [name, more] : laws) expect_right_impulses(name, more);
}

TEST(Resync, IsToldByTableJsonAndPage) {
  const SceneComparison& c = ring();
  const std::string table = result::text_of(comparison_result(c));
  for (const char* part : {"resync", "onset", "median", "90 %", "worst", "rebound"}) {
    EXPECT_NE(table.find(part), std::string::npos) << part;
  }
  EXPECT_LE(test::widest_line(table), 80U) << table;
  const nlohmann::json all = result::json_of(comparisons_result({c}));
  EXPECT_EQ(all.at("mode"), "resync");
  const auto& rigid = all.at("scenes")[0].at("differences").at("rigid");
  for (const char* figure : {"impulse", "window_impulse", "duration", "rebound"}) {
    for (const char* key : {"native", "other", "bias", "median", "ninetieth", "worst", "worst_time",
                            "verdict", "relative_to"}) {
      EXPECT_TRUE(rigid.at("resync").at("figures").at(figure).contains(key)) << figure << key;
    }
  }
  EXPECT_EQ(rigid.at("resync").at("onsets").size(), c.models[0].resync->onsets.size());
  EXPECT_EQ(rigid.at("trusted"), "yes");
  std::vector<std::string> sections;
  for (const nlohmann::json& part : page_json(comparison_result(c)))
    sections.push_back(part.value("id", ""));
  EXPECT_EQ(std::ranges::count(sections, "resync"), 1);
  EXPECT_EQ(std::ranges::count(sections, "differences"), 0) << "those of lockstep";
}

}  // namespace
}  // namespace rotorub
