#include "compare/study/trust.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "compare/study/answer.h"
#include "compare/study/verdict.h"

namespace rotorub {
namespace {

// The verdict on made-up figures.

constexpr double kPercent = 0.01;

// A figure of two groups of 17 runs whose difference has a confidence interval of +-interval.
JudgedFigure made(const char* key, double deviation, double interval = 0.0) {
  const auto group = [&](double mean) {
    return FigureSample{mean, mean, 100.0 * interval / 0.698649, 17};
  };
  return judged(figure(key), group(100.0), group(100.0 * (1.0 + deviation)), kPercent);
}

TEST(FigureVerdict, ToleranceAndIntervalDecide) {
  struct Case {
    double deviation, interval;
    FigureVerdict expected;
    const char* what;
  };
  for (const Case& c :
       {Case{0.005, 0.0, FigureVerdict::kWithin, "near, and repeatable"},
        Case{-0.02, 0.0, FigureVerdict::kOutside, "far, and repeatable"},
        Case{-0.0173, 0.0054, FigureVerdict::kOutside, "the whole interval is beyond"},
        Case{0.003, 0.005, FigureVerdict::kWithin, "the whole interval is within"},
        Case{0.012, 0.005, FigureVerdict::kUndecidable, "the border is in the interval"},
        Case{0.001, 0.03, FigureVerdict::kUndecidable, "near by luck"},
        Case{3.0, 0.03, FigureVerdict::kOutside, "no twin is that far"}}) {
    EXPECT_EQ(made("mean_force", c.deviation, c.interval).verdict, c.expected) << c.what;
  }
}

TEST(FigureVerdict, IsSettledWhereTheIntervalIsFarFromTheTolerance) {
  EXPECT_TRUE(is_settled(made("mean_force", 0.0), kPercent));
  EXPECT_TRUE(is_settled(made("mean_force", 0.002, 0.0039), kPercent));
  EXPECT_FALSE(is_settled(made("mean_force", 0.002, 0.0041), kPercent)) << "within, but just so";
  EXPECT_FALSE(is_settled(made("mean_force", -0.03, 0.011), kPercent)) << "outside, but just so";
  EXPECT_TRUE(is_settled(made("mean_force", -0.5, 0.1), kPercent));
  EXPECT_TRUE(is_settled(made("force_deviation", 0.01, 0.1), kPercent)) << "is not judged";
}

TEST(FigureVerdict, OfTwoSingleRuns) {
  using enum FigureVerdict;
  constexpr double kInfinite = std::numeric_limits<double>::infinity(),
                   kNone = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    const char* key;
    double native, other;
    FigureVerdict expected;
    const char* what;
  };
  for (const Case& c : {
           Case{"mean_force", 1.0, kInfinite, kOutside, "no number"},
           Case{"window_impulse", 0.0, 1.0, kOutside, "no share of nothing"},
           Case{"gap_rate_rms", 0.0, 1e-8, kWithin, "below the resolution"},
           Case{"whirl_frequency", -501.9, 501.9, kOutside, "the sense counts"},
           Case{"friction_work", 0.0, 0.0, kNotJudged, "neither has it"},
           Case{"hard_impacts", 0.0, 0.0, kNotJudged, "neither has any"},
           Case{"hard_impacts", 0.0, 1.0, kUndecidable, "a soft start counts one"},
           Case{"hard_impacts", 2.0, 1.0, kUndecidable, "half of them, but one"},
           Case{"hard_impacts", 6.0, 6.0, kWithin, "as many"},
           Case{"hard_impacts", 6.0, 3.0, kOutside, "three fewer"},
           Case{"hard_impacts", 0.0, 2.0, kOutside, "two more"},
           Case{"hard_impacts", 600.0, 601.0, kWithin, "one more of many"},
           Case{"hard_impacts", 600.0, 605.0, kWithin, "less than 1 %"},
           Case{"hard_impacts", 600.0, 610.0, kOutside, "more than 1 %"},
           Case{"near_miss", 8e-6, 8.05e-6, kWithin, "as near"},
           Case{"near_miss", 8e-6, 24e-6, kOutside, "further off"},
           Case{"near_miss", 8e-6, 2.5e-6, kOutside, "nearer"},
           Case{"near_miss", 8e-6, kNone, kNotJudged, "it touches: the mean force decides"},
           Case{"near_miss", kNone, kNone, kNotJudged, "both touch"},
       }) {
    EXPECT_EQ(judged(figure(c.key), c.native, c.other, kPercent).verdict, c.expected)
        << c.key << ": " << c.what;
  }
}

// If the gap is almost at rest, the ratio of its rates has no meaning.
TEST(FigureVerdict, ASmallGapRateIsJudgedByItsResolution) {
  const Figure& rate = figure("gap_rate_rms");
  EXPECT_DOUBLE_EQ(deviation(rate, 0.0, 1e-5), 0.01);
  EXPECT_DOUBLE_EQ(deviation(rate, 1e-3, 2e-3), 1.0);
}

// A percentage of a value near 0 would hide the size of the error.
TEST(FigureVerdict, ASmallGapRateIsWrittenAsItIs) {
  const JudgedFigure f = judged(figure("gap_rate_rms"), 0.196e-3, 0.157e-3, kPercent);
  EXPECT_EQ(f.verdict, FigureVerdict::kOutside);
  EXPECT_EQ(difference_text(f), "0.1570 mm/s instead of 0.1960");
  EXPECT_EQ(deviation_text(f), "-0.039 mm/s");
  EXPECT_EQ(size_text(f, 0.02), "0.02 mm/s");
}

TEST(FigureVerdict, SmallCountsAreWrittenAsCounts) {
  const Figure& hard = figure("hard_impacts");
  const JudgedFigure more = judged(hard, 30.0, 42.0, kPercent);
  EXPECT_DOUBLE_EQ(more.deviation, 0.4) << "of 30, not of 100";
  EXPECT_EQ(difference_text(more), "42 instead of 30");
  EXPECT_EQ(deviation_text(more), "+12");
  EXPECT_EQ(
      why({judged(hard, 2.0, 1.0, kPercent)}, kPercent),
      "undecidable at 1 %: hard impacts 1 instead of 2 (a difference of one cannot be judged)");
  EXPECT_EQ(difference_text(judged(hard, 600.0, 610.0, kPercent)), "+1.67 %");
  EXPECT_EQ(difference_text(judged(hard, 6.0, 6.0, kPercent)), "0");
}

// Student's t from tables: 2.0369 of 32 degrees of freedom, 2.3060 of 8, 2.0860 of 20.
TEST(FigureSample, TheIntervalIsWelchs) {
  const auto of = [](int n) { return FigureSample{0.0, 0.0, 1.0, n}; };
  EXPECT_NEAR(interval(of(17), of(17)).half, 2.0369 * std::sqrt(2.0 / 17.0), 1e-4);
  EXPECT_NEAR(interval(of(5), of(5)).half, 2.3060 * std::sqrt(2.0 / 5.0), 1e-3);
  EXPECT_NEAR(interval(of(21), FigureSample{}).half, 2.0860 * std::sqrt(1.0 / 21.0 + 1.0), 1e-3);
  EXPECT_EQ(interval(FigureSample{}, FigureSample{}).half, 0.0);
  // t of 0.8 and 32 degrees of freedom: 0.853.
  EXPECT_NEAR(interval(of(17), of(17)).least_detectable, (2.0369 + 0.8530) * std::sqrt(2.0 / 17.0),
              1e-3);
}

TEST(FigureSample, OfEqualRunsIsTheRun) {
  Metrics m;
  m.mean_force = 0.1 + 0.2;
  const FigureSample s = figure_sample(figure("mean_force"), m, std::vector(20, m));
  EXPECT_EQ(s.mean, m.mean_force);
  EXPECT_EQ(s.deviation, 0.0);
}

TEST(Trust, PeaksAloneLeaveTheAverages) {
  const auto all = [](double mean, double peak, double impacts, double interval) {
    return std::vector{made("mean_force", mean), made("window_impulse", peak),
                       made("hard_impacts", impacts, interval)};
  };
  EXPECT_EQ(trust(all(0.0, 0.0, 0.0, 0.0)), Trust::kYes);
  EXPECT_EQ(trust(all(0.001, -0.89, 0.0, 0.0)), Trust::kAveragesOnly);
  EXPECT_EQ(trust(all(0.001, 0.0, 0.2, 0.0)), Trust::kAveragesOnly);
  EXPECT_EQ(trust(all(0.001, 0.0, 0.02, 0.07)), Trust::kYes) << "undecidable does not decide";
  EXPECT_EQ(trust(all(0.2, 0.0, 0.0, 0.0)), Trust::kNo);
  EXPECT_EQ(trust({made("mean_force", 0.0, 0.1)}), Trust::kUndecidable) << "nothing decided";
}

TEST(Why, NamesTheFurthestFirstAndWhatWasNotDecided) {
  const std::string text = why({made("mean_force", 0.001), made("hard_impacts", 0.2),
                                made("window_impulse", -0.89), made("gap_rate_rms", 0.03, 0.07)},
                               kPercent);
  EXPECT_EQ(
      text,
      "largest impulse -89 %, hard impacts +20 %; within 1 %: mean normal force; undecidable at 1 "
      "%: rms gap rate +3.00 % ± 7.00 % (9.93 % would be detected)");
}

// In a replay the open loop drifts by more than equal twins scatter, so 0 % is not the detection
// limit.
TEST(Why, SaysThatADriftHidesWhatIsSmaller) {
  const FigureSample native{.value = 100.0, .mean = 100.0, .replay_floor = 0.021};
  const FigureSample other{100.5, 100.5};
  EXPECT_EQ(why({judged(figure("mean_force"), native, other, kPercent)}, kPercent),
            "undecidable at 1 %: mean normal force +0.50 % ± 2.10 % (2.10 % would be detected)");
}

// The three errors of a comparison made by hand.

// One judged figure, in points: a share of time.
SceneComparison made_by_hand() {
  SceneComparison c;
  c.native.label = "native";
  c.native.metrics.contact_fraction = 0.9;
  ComparedModel& m = c.models.emplace_back();
  m.run.label = "rigid";
  for (const Figure& f : figures()) {
    if (!f.is_judged() || !f.split || f.scale != Scale::kPoints) continue;
    FigureDifference difference;
    difference.figure = &f;
    difference.split.model_gap = -0.05;
    difference.split.step_error = 0.03;
    difference.split.native_step_error = 0.01;
    difference.split.valid = true;
    m.figures.push_back(difference);
  }
  return c;
}

// A controller that fails, or a native run that fails, says nothing about a contact model.
TEST(AnswerRow, BlamesNoContactModelForAnotherPartsFailure) {
  for (const bool native : {true, false}) {
    SceneComparison c = made_by_hand();
    ComparedModel& m = c.models[0];
    c.native.metrics.first_touch = m.run.metrics.first_touch = 0.1;
    EXPECT_STREQ(answer_row(c, c.models[0]).verdict.word, to_string(m.trust));
    Trajectory& failed = (native ? c.native : m.run).trajectory;
    failed.status = Status::kControllerFailed;
    failed.message = "no law";
    m.trust = Trust::kNo;
    EXPECT_STREQ(answer_row(c, c.models[0]).verdict.word, "not known");
    EXPECT_NE(answer_row(c, c.models[0]).why.find("controller_failed"), std::string::npos);
    EXPECT_EQ(whose_verdict(c), "The exit code is 3: a run did not come to its end.");
    EXPECT_EQ(headline(c, m).find("outside"), std::string::npos);
  }
  // A contact that fails by itself is a fault of its model.
  SceneComparison c = made_by_hand();
  c.models[0].run.trajectory.status = Status::kOutOfRange;
  c.models[0].trust = Trust::kNo;
  EXPECT_STREQ(answer_row(c, c.models[0]).verdict.word, "no");
}

// With several contacts the modal chain has no cone, which readers expect first.
TEST(AnswerRow, GivesTheReasonForALeftOutMujocoAlone) {
  SceneComparison c = made_by_hand();
  c.scene.auxiliary.resize(2);
  for (scene::AuxiliaryBearing& at : c.scene.auxiliary) at.contact.emplace();
  EXPECT_NE(cone_note(c).find("MuJoCo alone is not shown: its cone supports only one contact"),
            std::string::npos);
  c.scene.mujoco.rotor = scene::MujocoRotor::kSegments;
  EXPECT_EQ(cone_note(c), "");
}

// A reader who sees that MuJoCo alone bounces needs its solref.
TEST(AnswerRow, SaysTheSolrefOfTheSoftContacts) {
  SceneComparison c = made_by_hand();
  EXPECT_EQ(solref_note(c), "");
  c.models[0].run.label = "cone";
  c.models[0].run.solref = "-2e+08 -1e+04";
  ComparedModel& by_default = c.models.emplace_back(c.models[0]);
  by_default.run.label = "cone-default";
  by_default.run.solref = "0.02 1";
  EXPECT_EQ(solref_note(c),
            "The soft contacts use solref \"-2e+08 -1e+04\" (cone), \"0.02 1\" (cone-default, "
            "MuJoCo's default).");
}

TEST(ThreeErrors, AreThoseOfTheFigureThatIsFurthestOff) {
  SceneComparison c = made_by_hand();
  ASSERT_FALSE(c.models[0].figures.empty());
  FigureDifference further = c.models[0].figures[0];
  further.split.model_gap = 0.2;
  further.split.step_error = 0.01;
  c.models[0].figures.push_back(further);
  const ThreeErrors errors = three_errors(c, c.models[0]);
  EXPECT_DOUBLE_EQ(errors.contact.share, 0.2);
  EXPECT_NEAR(errors.step.share, 0.02, 1e-15) << "MuJoCo's less the native one's";
  EXPECT_FALSE(errors.modes.has_value());
  EXPECT_STREQ(errors.contact.figure->label, "lasting contact");
}

// A share of 0 % beside a verdict that fails says nothing about the failure.
TEST(ThreeErrors, NameTheFailingFiguresThatAreNotKnown) {
  SceneComparison c = made_by_hand();
  ComparedModel& m = c.models[0];
  EXPECT_EQ(error_text(three_errors(c, m).contact), "-5.00 points lasting contact");
  FigureDifference count;
  static_cast<JudgedFigure&>(count) = judged(figure("hard_impacts"), 7.0, 5.0, kPercent);
  ASSERT_EQ(count.verdict, FigureVerdict::kOutside);
  m.figures.push_back(count);
  EXPECT_EQ(error_text(three_errors(c, m).contact),
            "-5.00 points lasting contact; not known for hard impacts");
  FigureDifference rate;
  static_cast<JudgedFigure&>(rate) = judged(figure("gap_rate_rms"), 0.5e-3, 0.6e-3, kPercent);
  rate.split.valid = true;
  rate.split.step_error = 0.1e-3;
  m.figures = {rate};
  EXPECT_EQ(error_text(three_errors(c, m).step), "+0.1 mm/s rms gap rate");
  m.figures = {count};
  EXPECT_EQ(error_text(three_errors(c, m).step), "not known for hard impacts");
}

TEST(ThreeErrors, SayWhatCannotBeTold) {
  SceneComparison c = made_by_hand();
  c.models[0].figures.push_back(c.models[0].figures[0]);
  c.models[0].figures[0].split.valid = false;
  EXPECT_EQ(three_errors(c, c.models[0]).contact.unknown, 1);
  EXPECT_NE(three_errors(c, c.models[0]).contact.figure, nullptr);
  c.models[0].figures[1].split.valid = false;
  EXPECT_EQ(three_errors(c, c.models[0]).contact.figure, nullptr);
}

// A scene without a near miss has no such figure, which does not make it undecidable.
TEST(ThreeErrors, LeaveOutWhatTheSceneHasNot) {
  SceneComparison c = made_by_hand();
  c.native.metrics.first_touch = c.models[0].run.metrics.first_touch = 0.1;
  ASSERT_TRUE(is_absent(c, figure("near_miss")));
  FigureDifference missing;
  missing.figure = &figure("near_miss");
  c.models[0].figures.push_back(missing);
  EXPECT_EQ(three_errors(c, c.models[0]).contact.unknown, 0);
  EXPECT_EQ(three_errors(c, c.models[0]).step.unknown, 0);
}

TEST(ThreeErrors, HaveTheModesOfTheLadder) {
  SceneComparison c = made_by_hand();
  c.model_error.emplace();
  EXPECT_FALSE(three_errors(c, c.models[0]).modes.has_value())
      << "it has no figures: there is a reason why not";
  FigureLimit seen, unseen;
  seen.figure = unseen.figure = c.models[0].figures[0].figure;
  seen.error = -0.12;
  c.model_error->figures = {unseen, seen};
  const ThreeErrors errors = three_errors(c, c.models[0]);
  ASSERT_TRUE(errors.modes.has_value());
  EXPECT_DOUBLE_EQ(errors.modes->share, -0.12);
  EXPECT_EQ(errors.modes->unknown, 1);
}

// The reasons of a verdict, on runs made by hand.
class Reasons : public testing::Test {
 protected:
  Reasons() {
    c_.native.label = "native";
    c_.scene.run.step = 1e-5;
    c_.tolerance = kPercent;
    ComparedModel& m = c_.models.emplace_back();
    m.run.label = "cone";
    for (Metrics* metrics : {&c_.native.metrics, &m.run.metrics}) {
      metrics->first_touch = 0.0;
      metrics->mean_force = 1.0;
    }
    for (const Figure& f : figures()) {
      FigureDifference difference;
      difference.figure = &f;
      m.figures.push_back(difference);
    }
  }
  FigureDifference& set(const char* key, double native, double other) {
    for (FigureDifference& f : c_.models[0].figures) {
      if (f.figure->key != std::string(key)) continue;
      static_cast<JudgedFigure&>(f) = judged(*f.figure, native, other, kPercent);
      f.split.difference = other - native;
      return f;
    }
    throw std::out_of_range(key);
  }
  std::string said() {
    ComparedModel& m = c_.models[0];
    m.trust = trust(m.judged());
    std::string all;
    for (const std::string& reason : reasons(c_, m)) all += reason + "\n";
    return all;
  }
  SceneComparison c_;
};

TEST_F(Reasons, OnlyABouncingRotorBounces) {
  Side& cone = c_.models[0].run;
  c_.native.metrics.lasting_fraction = 0.95;
  cone.metrics.lasting_fraction = 0.53;
  cone.metrics.force_deviation = 1.83;
  c_.native.metrics.force_deviation = 3.77;
  cone.metrics.settled.attractor = Attractor::kBackwardWhip;
  EXPECT_EQ(said().find("bounces"), std::string::npos);
  EXPECT_NE(said().find("cone is in lasting contact 53 % of the time instead of 95 %\n"),
            std::string::npos);
  cone.metrics.settled.attractor = Attractor::kBouncing;
  EXPECT_NE(said().find("cone bounces: it is in lasting contact 53 % of the time instead of 95 %, "
                        "with a force scatter of 183 % of the mean (native: 377 %)"),
            std::string::npos)
      << said();
}

// The worst figure is a count, which cannot be split; the next one can.
TEST_F(Reasons, AFigureThatCanBeSplitSaysWhatToDo) {
  set("mean_force", 26.96, 26.97);
  set("hard_impacts", 7.0, 5.0);
  EXPECT_EQ(
      said(),
      "a smaller step shows whether the difference in hard impacts (5 instead of 7) is due to "
      "the step: --step 5us\n");
  Split& split = set("gap_rate_rms", 0.5301e-3, 0.5688e-3).split;
  split.valid = true;
  split.step_error = 0.0403e-3;
  split.model_gap = -0.0016e-3;
  EXPECT_EQ(said(),
            "the difference in rms gap rate (0.5688 mm/s instead of 0.5301) is due to the step "
            "(+0.0403 mm/s), so try a smaller one: --step 2us\n");
}

TEST(PlainDifference, IsInWordsOfEveryDay) {
  const auto plain = [](const char* key, double native, double other) {
    return plain_difference(judged(figure(key), native, other, kPercent));
  };
  EXPECT_EQ(plain("lasting_fraction", 0.988, 0.0), "lasting contact 0 % instead of 98.8 %");
  EXPECT_EQ(plain("gap_rate_rms", 6.5e-3, 0.105), "rms gap rate 16 times as large");
  EXPECT_EQ(plain("mean_force", 100.0, 90.0), "mean normal force 10 % too small");
  EXPECT_EQ(plain("mean_force", 100.0, 101.6), "mean normal force 1.6 % too large");
  EXPECT_EQ(plain("whirl_frequency", -501.9, -11287.0), "whirl 22 times as fast");
  EXPECT_EQ(plain("whirl_frequency", 300.0, -285.0), "whirl 5 % too slow and the other way round");
  EXPECT_EQ(plain("mean_force", 244.84, 118012.0), "mean normal force 482 times as large");
  // Too small for a share of itself.
  EXPECT_EQ(plain("hard_impacts", 8.0, 309.0), "hard impacts 309 instead of 8");
  EXPECT_EQ(plain("gap_rate_rms", 0.0, 0.017), "rms gap rate 17 mm/s instead of 0 mm/s");
}

}  // namespace
}  // namespace rotorub
