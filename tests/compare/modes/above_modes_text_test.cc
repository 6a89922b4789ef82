// Rubs whose whirl is faster than the modes kept are marked, since their forces depend on them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/starter/starter.h"
#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using nlohmann::json;
using test::contains;

result::Section modes_of(const std::vector<std::string>& overrides) {
  const scene::Scene pump = scene::parse_scene(starter_scene({}), "pump.toml", overrides);
  return modes_result("pump", analyse_rotor(pump, {}));
}

// The rotor rolls at some 12,000 rad/s; three modes end below this, 24 above.
TEST(AboveModesText, MarksARubFasterThanTheModesKept) {
  const result::Section found = modes_of({"rotor.modes=3"});
  const json rub = result::json_of(found)["speeds"][0]["rub"];
  const json& rolling = rub["rubs"].back();
  ASSERT_EQ(rolling["kind"], "rolling");
  ASSERT_EQ(rub["notes"].size(), 1U);
  const std::string note = rub["notes"][0];
  EXPECT_TRUE(contains(note, {"marked *", "faster than the highest mode kept (",
                              "not reliable; raise rotor.modes and compare"}));
  const std::string text = result::text_of(found);
  EXPECT_TRUE(contains(text, {"\n* rolling", "\n  note: the whirl"}));
  EXPECT_FALSE(contains(text, "\n* forced"));
}

TEST(AboveModesText, MarksNoRubBelowTheModesKept) {
  const result::Section found = modes_of({"rotor.modes=24"});
  EXPECT_EQ(result::json_of(found)["speeds"][0]["rub"]["notes"], json::array());
  EXPECT_FALSE(contains(result::text_of(found), "\n* "));
}

// Modal data count as the exact rotor.
TEST(AboveModesText, MarksNothingWithoutAShaft) {
  const scene::Scene whip = test::shipped("bench_whip");
  const result::Section found = modes_result("whip", analyse_rotor(whip, {}));
  EXPECT_EQ(result::json_of(found)["speeds"][0]["rub"]["notes"], json::array());
}

}  // namespace
}  // namespace rotorub
