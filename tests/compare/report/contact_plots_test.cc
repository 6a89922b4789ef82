// What the page is given of impulses and of the response, before and after a loss.
#include "compare/report/contact_plots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/report/response_plots.h"
#include "native_model/scene/reader.h"
#include "tests/compare/hand_made.h"

namespace rotorub {
namespace {

// Steps of 0.1 ms; in contact from 0.1 s to 0.2 s, and for one step at 0.5 s.
Trajectory rubbing(const char* contact_model) {
  Trajectory run = test::hand_made(8001, 1e-4, [](double t) {
    test::Row row;
    row.normal = (t > 0.1 && t < 0.2) || std::abs(t - 0.5001) < 2e-5 ? 10.0 : 0.0;
    return row;
  });
  run.contact_model = contact_model;
  for (const auto& [t, impulse] : {std::pair(0.1, 1.0), std::pair(0.5, 1e-3)}) {
    Impact impact;
    impact.t = t;
    impact.normal_impulse = impulse;
    impact.gap_rate_before = -0.1;
    run.impacts.push_back(impact);
  }
  return run;
}

// The soft contact's 0.1 s are a rub of 1 N s; the rigid law has its impulses at an instant.
TEST(ContactPlots, TheExceedanceHasNoLastingContactOfASoftOne) {
  using Numbers = std::vector<double>;
  const auto impulses = [](const char* contact_model) {
    return contact_distribution(rubbing(contact_model), 0, false)
        .at("impulse")
        .at("value")
        .get<Numbers>();
  };
  EXPECT_EQ(impulses("cone"), Numbers{1.0});
  EXPECT_EQ(impulses("rigid"), (Numbers{1000.0, 1.0}));
}

// One mode with an unbalance of 1e-5 kg m, to which the blade adds nine times as much.
TEST(ResponsePlots, ShowBeforeAndAfterTheLossOfABlade) {
  const scene::Scene scene = scene::parse_scene(R"(
[run]
end = 0.01
[rotor]
speed = 250.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[[force]]
kind = "unbalance"
static_moment = 1e-5
[[force]]
kind = "unbalance"
static_moment = 9e-5
on = 0.005
[contact]
radius = 0.02
clearance = 0.5e-3
friction = 0.1
restitution = 0.3
)",
                                                "scene.toml", {});
  const nlohmann::json bode = bode_data(scene, 600.0);
  ASSERT_EQ(bode.at("curves").size(), 2U);
  const nlohmann::json &before = bode.at("curves")[0], &after = bode.at("curves")[1];
  EXPECT_EQ(before.at("name"), "contact, before the loss");
  EXPECT_EQ(after.at("name"), "contact, after it");
  const auto a = before.at("amplitude").get<std::vector<double>>(),
             b = after.at("amplitude").get<std::vector<double>>();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(b[k], 10.0 * a[k], 5e-3 * b[k]) << k;
}

}  // namespace
}  // namespace rotorub
