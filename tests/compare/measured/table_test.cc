#include <gtest/gtest.h>

#include "compare/measured/output.h"
#include "tests/compare/columns.h"
#include "tests/compare/measurement.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

// All runs that a comparison has beside a record, in 80 columns that stay apart.
TEST(MeasuredTable, KeepsItsColumnsApart) {
  const scene::Scene scene = short_rig();
  const Trajectory run = run_event(scene);
  std::vector<RunToHold> runs;
  for (const char* label : {"native", "rigid", "coulomb", "cone", "cone-coulomb", "cone-default"})
    runs.push_back({label, &run});
  const Sensors sensors{.to = 0.09, .noise = 1e-6};
  const std::string text =
      result::text_of(measured_section(align_record(record_of(run, sensors), {}, scene, runs)));
  EXPECT_LE(widest_line(text), 80u);
  EXPECT_NE(text.find("measured  native   rigid coulomb    cone  cone-c\n"), std::string::npos)
      << text;
}

// The zero of a sensor is unknown: the residual does not contain it, and it has its own column.
TEST(MeasuredTable, AnOffsetIsNoResidual) {
  const scene::Scene scene = short_rig();
  const Sensors sensors{.to = 0.09};
  const Trajectory run = run_at(scene, instants(sensors));
  MeasuredRecord record = record_of(run, sensors);
  for (MeasuredColumn& c : record.columns) {
    const double zero = c.what->name == "rotor_x"   ? 76.2e-6
                        : c.what->name == "rotor_y" ? -50.8e-6
                                                    : 0.0;
    for (double& value : c.value) value += zero;
  }
  const MeasuredRun m = align_record(record, {}, scene, {{"native", &run}});
  const ColumnResidual& x = m.columns.front().runs.front();
  EXPECT_NEAR(x.offset, 76.2e-6, 1e-9);
  EXPECT_LT(x.rms, 1e-9);
  EXPECT_LT(x.share.value(), 1e-5);
  const std::string text = result::text_of(measured_section(m));
  EXPECT_NE(text.find("record less run, rms          offset  native\n"), std::string::npos) << text;
  EXPECT_NE(text.find("rotor_x, µm                  76.20 "), std::string::npos) << text;
  EXPECT_NE(text.find("rotor_y, µm                 -50.80 "), std::string::npos) << text;
}

}  // namespace
}  // namespace rotorub::test
