// The page of `modes` says where more modes would change the response, as the text does.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/report/modes_page.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

TEST(ModesPage, HasACardOfTheModesLeftOut) {
  const scene::Scene scene = test::shipped("amb_machine");
  const RotorAnalysis analysis = analyse_rotor(scene, {});
  const auto notes = result::json_of(modes_result("", analysis))["speeds"][0]["notes"];
  ASSERT_EQ(notes.size(), 1u);
  const std::string page = modes_page(scene, campbell_of(scene, analysis));
  EXPECT_TRUE(test::contains(
      page, {"Modes kept, ", "more modes change the response", notes[0].get<std::string>()}));
  EXPECT_EQ(page.find("beyond its current limit"), std::string::npos);
}

}  // namespace
}  // namespace rotorub
