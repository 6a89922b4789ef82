// How robust the laws are: every eighth point of the shipped studies
// (mjcf/studies/robustness_*.toml), against the passive bearing at the same point. The shares of
// all 200 points stand in mjcf/docs/findings.md; the bounds here leave room for what 25 points
// scatter (two standard deviations of a share of 90 % are 12 %).
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "compare/sweep/sample.h"
#include "native_model/scene/diagnostic.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

constexpr std::int64_t kEvery = 8;

struct Point {
  double impacts = 0.0, contact = 0.0;
};

// Empty if the scene is refused because its steady orbit touches the ring.
std::optional<Point> point_of(const sweep::PointScenes& scenes, std::int64_t index) {
  try {
    const Trajectory t = run_with(scenes.at(index), scene::Integrator::kVerlet);
    EXPECT_EQ(t.status, Status::kOk) << index << ": " << t.message;
    Point p;
    for (const Impact& impact : t.impacts) p.impacts += counts(impact) ? 1.0 : 0.0;
    p.contact = t.statistics.contact_time / (t.end - t.statistics.first_touch);
    return p;
  } catch (const scene::SceneError&) {
    return std::nullopt;
  }
}

std::vector<std::optional<Point>> points_of(const std::string& law) {
  const sweep::Study study =
      sweep::read_study(std::string(ROTORUB_MJCF_DIR) + "/studies/robustness_" + law + ".toml");
  const sweep::PointScenes scenes(study, {});
  std::vector<std::optional<Point>> all;
  for (std::int64_t i = 0; i < scenes.sample().size(); i += kEvery)
    all.push_back(point_of(scenes, i));
  return all;
}

const std::vector<std::optional<Point>>& passive() {
  static const auto all = points_of("passive");
  return all;
}

// Fractions of the points at which the passive bearing is touched.
struct Shares {
  double closed = 0.0;  // contact over 97 %
  double calm = 0.0;    // at most a 20th of its impacts
};

Shares shares_of(const std::string& law) {
  const auto points = points_of(law);
  double count = 0.0;
  Shares shares;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i] || !passive().at(i) || passive()[i]->impacts == 0.0) continue;
    count += 1.0;
    shares.closed += points[i]->contact > 0.97 ? 1.0 : 0.0;
    shares.calm += 20.0 * points[i]->impacts <= passive()[i]->impacts ? 1.0 : 0.0;
  }
  EXPECT_GE(count, 20.0) << "or these are not the points of a study";
  return {shares.closed / count, shares.calm / count};
}

TEST(LongRobustness, EachLawClosesTheContactNearlyEverywhere) {
  for (const auto& [law, calm] : {std::pair{"sliding", 0.75}, std::pair{"two_phase", 0.8},
                                  std::pair{"cross_coupled", 0.65}}) {
    const Shares shares = shares_of(law);
    EXPECT_GE(shares.closed, 0.85) << law;
    EXPECT_GE(shares.calm, calm) << law;
  }
}

}  // namespace
}  // namespace rotorub::test
