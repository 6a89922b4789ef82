#include <gtest/gtest.h>

#include "compare/measured/output.h"
#include "tests/compare/columns.h"
#include "tests/compare/measurement.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

// All that a comparison runs beside a record, in 80 columns that do not run together.
TEST(MeasuredTable, KeepsItsColumnsApart) {
  // From rest: a steady circle has no instant of its own.
  const scene::Scene scene =
      shipped("paper_passive",
              {"run.end=0.1", "run.step=1e-5", "run.output_step=1e-4", "initial.steady=false"});
  const Trajectory run = run_event(scene);
  std::vector<RunToHold> runs;
  for (const char* label : {"native", "rigid", "coulomb", "cone", "cone-coulomb", "cone-default"})
    runs.push_back({label, &run});
  Sensors sensors;
  sensors.from = 0.01;
  sensors.to = 0.09;
  sensors.noise = 1e-6;
  const std::string text = measured_table(lay_in(record_of(run, sensors), {}, scene, runs));
  EXPECT_LE(widest_line(text), 80u);
  EXPECT_NE(text.find("measured  native   rigid coulomb    cone  cone-c\n"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace rotorub::test
