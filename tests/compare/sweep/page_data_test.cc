#include "compare/sweep/page_data.h"

#include <nlohmann/json.hpp>

#include "compare/sweep/linear_map.h"
#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

using nlohmann::json;

const std::string kFrictions =
    test::sampled("list", {{"contact.friction", "[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]"}});

class SweepData : public testing::Test {
 protected:
  // Six points, of which the last failed; the mean force is the point's number.
  void open(const std::string& sample) {
    study = folder.study(test::of_ring() + sample);
    scenes = std::make_unique<PointScenes>(study, std::span<const std::string>());
    store = std::make_unique<Store>(folder.path() / "results.sqlite", study, StudyIdentity{"h", 6},
                                    Shard{});
    std::vector<PointResult> results;
    for (std::int64_t i = 0; i < 6; ++i) {
      PointResult r;
      r.point = i;
      if (i < 5) {
        r.figures.emplace().mean_force = static_cast<double>(i);
      } else {
        r.status = "diverged";
        r.reason = "<b>nowhere</b>";
      }
      results.push_back(r);
    }
    store->add(results, scenes->sample());
  }
  static json column(const json& plots, const std::string& name) {
    for (std::size_t k = 0; k < plots["figures"].size(); ++k) {
      if (plots["figures"][k]["name"] == name) return plots["columns"][k];
    }
    return nullptr;
  }

  test::StudyFolder folder;
  Study study;
  std::unique_ptr<PointScenes> scenes;
  std::unique_ptr<Store> store;
};

TEST_F(SweepData, CellsOfAGrid) {
  open(R"([sample]
kind = "grid"
[[vary]]
key = "rotor.speed"
from = "10 Hz"
to = "20 Hz"
count = 3
[[vary]]
key = "contact.friction"
values = [0.1, 0.3]
)");
  const json plots = sweep_plots(*scenes, *store, study);
  EXPECT_EQ(plots["kind"], "grid");
  EXPECT_EQ(plots["keys"][0]["values"], json({10.0, 15.0, 20.0}));
  EXPECT_EQ(plots["keys"][0]["unit"], "Hz");
  EXPECT_EQ(plots["keys"][0]["even"], true);
  EXPECT_EQ(plots["keys"][1]["even"], false);
  EXPECT_FALSE(plots.contains("values")) << "its points are in order";
  EXPECT_EQ(column(plots, "mean_force"), json({0.0, 1.0, 2.0, 3.0, 4.0, nullptr}));
  EXPECT_EQ(plots["status"], json({0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(plots["statuses"], json({"ok", "diverged"}));
}

TEST_F(SweepData, MarksOfAList) {
  open(kFrictions);
  const json plots = sweep_plots(*scenes, *store, study);
  EXPECT_EQ(plots["kind"], "marks");
  EXPECT_EQ(plots["values"][0], json({0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
}

TEST_F(SweepData, HasItsFailures) {
  open(kFrictions);
  const json kept = sweep_json(*scenes, *store, study);
  const json failed = page_data(*scenes, *store, study, kept, {}, {}).at("failed");
  EXPECT_EQ(failed, json::parse(R"([{"status": "diverged", "reason": "<b>nowhere</b>", "points": 1,
                                     "first": 5}])"));
}

// Every point of a grid over friction has its lasting rubs beside its run, even if the run failed.
TEST_F(SweepData, HasTheLinearMapOfAGridOverFriction) {
  open(R"([sample]
kind = "grid"
[[vary]]
key = "contact.friction"
values = [0.05, 0.15, 0.3]
[[vary]]
key = "rotor.speed"
also = ["force[0].frequency"]
values = ["50 Hz", "60 Hz"]
)");
  const LinearMap map = linear_map(*scenes);
  ASSERT_EQ(map.points.size(), 6U);
  EXPECT_EQ(map.refused, "");
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_TRUE(map.points[i]);
    const scene::Scene scene = scenes->at(static_cast<std::int64_t>(i));
    EXPECT_EQ(map.points[i]->friction, scene.first().contact->friction.coefficient) << i;
    EXPECT_EQ(map.points[i]->speed, scene.rotor.speed) << i;
    EXPECT_TRUE(map.points[i]->attractors() & rub::kForcedRub) << i;
  }
  const json rubs = sweep_json(*scenes, *store, study).at("plots").at("linear");
  EXPECT_EQ(rubs.at("attractors").size(), 6U);
}

TEST_F(SweepData, HasNoLinearMapOfOtherStudies) {
  open(kFrictions);
  EXPECT_FALSE(linear_map(*scenes).any());
  EXPECT_FALSE(sweep_json(*scenes, *store, study).at("plots").contains("linear"));
}

// A report reads later what the page of the sweep shows.
TEST_F(SweepData, IsKeptForAReport) {
  open(R"([sample]
kind = "grid"
[[vary]]
key = "rotor.speed"
from = "10 Hz"
to = "20 Hz"
count = 6
)");
  const json kept = sweep_json(*scenes, *store, study);
  const json plots = sweep_plots(*scenes, *store, study);
  for (const char* name : {"kind", "keys", "status", "statuses", "every"}) {
    EXPECT_EQ(kept.at("plots").at(name), plots.at(name)) << name;
  }
  EXPECT_EQ(column(kept.at("plots"), "mean_force"), json({0.0, 1.0, 2.0, 3.0, 4.0, nullptr}));
  EXPECT_EQ(kept.at("answer"),
            json({"Unknown everywhere.", "5 of 6 points ran to their end; 1 diverged."}));
}

}  // namespace
}  // namespace rotorub::sweep
