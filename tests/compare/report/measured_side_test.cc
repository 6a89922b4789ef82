// A measured run on the page of a report: which run each of its curves belongs to.
#include "compare/report/measured_side.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "compare/measured/measured_run.h"
#include "compare/report/plots.h"

namespace rotorub {
namespace {

// align_record() leaves out runs with fewer than two rows, here "rigid".
TEST(MeasuredSide, EachForceBelongsToTheRunOfItsLabel) {
  MeasuredRun measured;
  measured.laid.t = {0.0, 1e-3, 2e-3};
  measured.labels = {"native", "cone"};
  measured.forces = {{1.0, 2.0, 3.0}, {40.0, 50.0, 60.0}};
  const ShownRuns shown{
      nullptr, {{"native", nullptr}, {"rigid", nullptr}, {"cone", nullptr}}, &measured};
  EXPECT_TRUE(sampled_force(shown, "rigid").is_null());

  MeasuredRun alone = measured;
  alone.labels = {"cone"};
  alone.forces = {measured.forces[1]};
  const nlohmann::json cone = sampled_force(shown, "cone");
  ASSERT_FALSE(cone.is_null());
  EXPECT_EQ(cone, sampled_force({nullptr, {{"cone", nullptr}}, &alone}, "cone"));
  EXPECT_NE(cone, sampled_force(shown, "native"));
}

}  // namespace
}  // namespace rotorub
