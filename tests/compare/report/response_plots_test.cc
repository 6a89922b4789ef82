// What the page is given of the response, before and after a loss.
#include "compare/report/response_plots.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

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
