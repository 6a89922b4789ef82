// The results of `modes` for every shipped scene do not depend on the axes in which the scene is
// written.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "native_model/scene/diagnostic.h"
#include "tests/compare/shipped/engines.h"
#include "tests/support/symmetry.h"

namespace rotorub::test {
namespace {

using nlohmann::json;

// Keys of what has a direction: shapes of the planes, and sums over x and y apart.
bool has_direction(const std::string& key) {
  return key == "mode_shapes" || key == "notes" || key == "levitation";
}

void expect_alike(const json& a, const json& b, const std::string& where) {
  ASSERT_EQ(a.type_name(), std::string(b.type_name())) << where;
  if (a.is_object()) {
    for (const auto& [key, value] : a.items()) {
      if (has_direction(key)) continue;
      ASSERT_TRUE(b.contains(key)) << where << key;
      expect_alike(value, b.at(key), where + key + ".");
    }
  } else if (a.is_array()) {
    ASSERT_EQ(a.size(), b.size()) << where;
    for (std::size_t k = 0; k < a.size(); ++k) {
      expect_alike(a[k], b[k], where + std::to_string(k) + ".");
    }
  } else if (a.is_number()) {
    const double x = a.get<double>(), y = b.get<double>();
    EXPECT_NEAR(x, y, 1e-6 * std::abs(x) + 1e-9) << where;
  } else {
    EXPECT_EQ(a, b) << where;
  }
}

class TurnedModes : public ::testing::TestWithParam<std::string> {};

TEST_P(TurnedModes, AreThoseOfTheMachine) {
  std::optional<scene::Scene> scene;
  try {
    scene = shipped(GetParam());
  } catch (const scene::SceneError&) {
    return;  // one that is there to be refused
  }
  const Transformed by(*scene, Symmetry::kAskew);
  if (!by.not_expressible().empty()) return;
  const scene::Scene turned = shipped(GetParam(), by.overrides());
  expect_alike(result::json_of(modes_result("", analyse_rotor(*scene, {}))),
               result::json_of(modes_result("", analyse_rotor(turned, {}))), "");
}

INSTANTIATE_TEST_SUITE_P(Shipped, TurnedModes, ::testing::ValuesIn(scenes_of("")),
                         [](const auto& shown) { return shown.param.substr(1); });

}  // namespace
}  // namespace rotorub::test
