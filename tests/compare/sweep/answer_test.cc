#include "compare/sweep/answer.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

using Answer = std::vector<std::string>;

const std::string kGrid =
    test::sampled("grid", {{"rotor.speed", "[\"10 Hz\", \"20 Hz\", \"30 Hz\"]"},
                           {"contact.friction", "[0.1, 0.2, 0.3, 0.4]"}});

// The answer if each point of a sample settles to attractor(point).
Answer answer(const std::string& sample, std::int64_t count,
              const std::function<Attractor(std::int64_t)>& attractor, double impulse = 0.0) {
  const test::StudyFolder folder;
  const Study study = folder.study(test::of_ring() + sample);
  const PointScenes scenes(study, {});
  Store store(folder.path() / "results.sqlite", study, StudyIdentity{"h", count}, Shard{});
  std::vector<PointResult> results;
  for (std::int64_t i = 0; i < count; ++i) {
    PointResult& r = results.emplace_back();
    r.point = i;
    r.figures.emplace().settled.attractor = attractor(i);
    if (i == 1) r.figures->peak_impulse = impulse;
  }
  store.add(results, scenes.sample());
  return answer_of(store, study);
}

TEST(SweepAnswer, NamesAThresholdThatIsTheSameEverywhere) {
  const auto whip_above = [](std::int64_t i) {
    return i % 4 >= 2 ? Attractor::kBackwardWhip : Attractor::kSynchronousRub;
  };
  EXPECT_EQ(answer(kGrid, 12, whip_above),
            (Answer{"Backward whip from contact friction 0.3 up, at every rotor speed; synchronous "
                    "rub up to contact friction 0.2, at every rotor speed.",
                    "All 12 points ran to their end."}));
}

TEST(SweepAnswer, NamesTheRangeOfAThreshold) {
  // From 0.2, 0.3 and 0.4 up.
  const auto bounces = [](std::int64_t i) {
    return i % 4 > i / 4 ? Attractor::kBouncing : Attractor::kNoContact;
  };
  EXPECT_EQ(answer(kGrid, 12, bounces).front(),
            "Bouncing from contact friction 0.2 to 0.4 up, depending on rotor speed; no contact up "
            "to contact friction 0.1 to 0.3, depending on rotor speed.");
  // Not at 10 Hz.
  const auto partly = [](std::int64_t i) {
    return i / 4 > 0 && i % 4 >= 2 ? Attractor::kBouncing : Attractor::kUnknown;
  };
  EXPECT_EQ(answer(kGrid, 12, partly).front(),
            "Bouncing from contact friction 0.3 up, for rotor speed 20 Hz to 30 Hz; unknown up "
            "to contact friction 0.2 to 0.4, depending on rotor speed.");
}

TEST(SweepAnswer, NamesQuantitiesInWordsAndUsualUnits) {
  const auto above = [](std::int64_t i) {
    return i >= 2 ? Attractor::kBouncing : Attractor::kNoContact;
  };
  const auto over = [&](const char* key, const char* values) {
    return answer(test::sampled("list", {{key, values}}), 3, above, 0.25).back();
  };
  EXPECT_EQ(over("contact.clearance", "[0.3e-3, 0.4e-3, 0.5e-3]"),
            "The largest impact is 0.25 N s, at point 1: contact clearance 0.4 mm.");
  EXPECT_EQ(over("contact.clearance", "[10e-6, 20e-6, 30e-6]"),
            "The largest impact is 0.25 N s, at point 1: contact clearance 20 µm.");
  EXPECT_EQ(over("force[0].amplitude", "[100, 150, 200]"),
            "The largest impact is 0.25 N s, at point 1: force 1 amplitude 150 N.");
  EXPECT_EQ(over("stator.stiffness", "[100e3, 250e3, 500e3]"),
            "The largest impact is 0.25 N s, at point 1: stator stiffness 250 kN/m.");
}

TEST(SweepAnswer, CountsWhereARegionHasNoBound) {
  const auto one = [](std::int64_t i) {
    return i == 5 ? Attractor::kRolling : Attractor::kNoContact;
  };
  EXPECT_EQ(
      answer(kGrid, 12, one, 0.25),
      (Answer{"Rolling at 1 of 12 points: rotor speed 20 Hz, contact friction 0.2; no contact "
              "at 11 of 12 points.",
              "All 12 points ran to their end.",
              "The largest impact is 0.25 N s, at point 1: rotor speed 10 Hz, "
              "contact friction 0.2."}));
  const std::string words = test::sampled("list", {{"run.integrator", "[\"event\", \"verlet\"]"}});
  EXPECT_EQ(answer(words, 2, one, 1.0),
            (Answer{"No contact everywhere.", "All 2 points ran to their end.",
                    "The largest impact is 1 N s, at point 1: run integrator verlet."}));
}

}  // namespace
}  // namespace rotorub::sweep
