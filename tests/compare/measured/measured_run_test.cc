#include "compare/measured/measured_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "compare/measured/figures.h"
#include "compare/measured/output.h"
#include "native_model/trajectory/output.h"
#include "tests/compare/columns.h"
#include "tests/compare/hand_made.h"
#include "tests/compare/measurement.h"
#include "tests/support/native_run.h"
#include "tests/support/temporary_folder.h"

namespace rotorub::test {
namespace {

const MeasuredFigure& figure_of(const MeasuredRun& run, const std::string& key) {
  for (const MeasuredFigure& f : run.figures) {
    if (f.key == key) return f;
  }
  throw std::out_of_range(key);
}
const ColumnFit& column_of(const MeasuredRun& run, const std::string& name) {
  for (const ColumnFit& c : run.columns) {
    if (c.what->name == name) return c;
  }
  throw std::out_of_range(name);
}

// The run's own series.csv is the measurement. The file's numbers read back to the same bits, so
// the residual is the round-off of the fit.
TEST(MeasuredRun, ARunsOwnSeriesLeavesNothing) {
  const scene::Scene scene = short_rig();
  const Trajectory run = run_event(scene);
  const TemporaryFolder folder;
  write_series(run, folder / "series.csv");
  const MeasuredRun m =
      align_record(read_measured(folder / "series.csv"), {}, scene, {{"native", &run}});
  EXPECT_NEAR(m.alignment.shift, 0.0, 1e-12);
  EXPECT_NEAR(m.alignment.angle, 0.0, 1e-12);
  ASSERT_GE(m.columns.size(), 6u);
  for (const ColumnFit& c : m.columns) {
    if (c.runs.front().share) {
      EXPECT_LT(*c.runs.front().share, 1e-9) << c.what->name;
    }
    EXPECT_EQ(c.missing + c.clipped, 0u) << c.what->name;
    EXPECT_EQ(c.good, run.rows()) << c.what->name;
  }
  ASSERT_GE(m.figures.size(), 8u);
  for (const MeasuredFigure& f : m.figures) {
    EXPECT_NEAR(f.measured, f.runs.front(), 1e-9 * std::abs(f.measured) + 1e-14) << f.key;
  }
}

// The figures of a circle are known; the record is in a turned frame.
TEST(MeasuredRun, FiguresAreThoseOfTheMotion) {
  constexpr double kRadius = 200e-6, kRate = 10e3, kHertz = 47.3;
  const double w = -2.0 * std::numbers::pi * kHertz;  // backward
  const Trajectory run = hand_made(20001, 1e-5, [&](double t) {
    Row row;
    row.x = kRadius * std::cos(w * t);
    row.y = kRadius * std::sin(w * t);
    row.vx = -w * row.y;
    row.vy = w * row.x;
    row.gap = 300e-6 + 1e-6 * t;
    return row;
  });
  std::string text = "t [ms], rotor_x [um], rotor_y [um], gap [um]\n";
  for (int k = 0; k < 1500; ++k) {
    const double t = 0.02 + k / kRate, held = 0.95 * kRadius;
    text += fmt::format("{:.17g},{:.17g},{:.17g},{}\n", 1e3 * t,
                        1e6 * std::clamp(kRadius * std::cos(w * t), -held, held),
                        1e6 * kRadius * std::sin(w * t), k == 70 ? 2.0 : 300.0);
  }
  const scene::Scene scene = short_rig();  // clearance 0.5 mm
  const MeasuredRun m = align_record(parse_measured(text, "m.csv"), {.shift = 0.0, .angle = 0.0},
                                     scene, {{"native", &run}});

  EXPECT_EQ(figure_of(m, "rotor_frequency").bound, Bound::kNone);
  for (const double f :
       {figure_of(m, "rotor_frequency").measured, figure_of(m, "rotor_frequency").runs.front()}) {
    EXPECT_NEAR(f, -kHertz, 0.1 / 0.15) << "a tenth of the resolution";
  }
  EXPECT_NEAR(figure_of(m, "rotor_amplitude").runs.front(), kRadius, 0.02 * kRadius);
  const MeasuredFigure& largest = figure_of(m, "rotor_largest");
  EXPECT_EQ(largest.bound, Bound::kAtLeast);
  EXPECT_NEAR(largest.runs.front(), kRadius, 0.02 * kRadius);
  EXPECT_NEAR(figure_of(m, "least_gap").measured, 2e-6, 1e-12);
  EXPECT_NEAR(figure_of(m, "contact_fraction").measured, 1.0 / 1500.0, 1e-9)
      << "one sample below 5 um";
  EXPECT_EQ(figure_of(m, "contact_fraction").runs.front(), 0.0);
  const ColumnFit& x = column_of(m, "rotor_x");
  EXPECT_GT(x.clipped, 200u);
  EXPECT_LT(x.runs.front().rms, 1e-9) << "the clipped ones are left out";
  EXPECT_NE(m.remarks.size(), 0u);
  // The run's gap rises by 1 um a second for 0.15 s, which gives an even distribution.
  const ColumnResidual& gap = column_of(m, "gap").runs.front();
  EXPECT_NEAR(gap.share.value() * 0.15e-6 / std::sqrt(12.0), gap.rms, 2e-3 * gap.rms);
  EXPECT_NEAR(gap.offset, -298e-6 / 1500.0 - 1e-6 * (0.02 + 0.075), 1e-9);
}

TEST(MeasuredRun, AnAxisAloneHasItsRms) {
  const Trajectory run = moving(10001, 1e-5, [](double t) {
    return 30e-6 + 100e-6 * std::sin(2.0 * std::numbers::pi * 50.0 * t);
  });
  std::string text = "t [s],rotor_x [um]\n";
  for (int k = 0; k < 1600; ++k)
    text += fmt::format("{},{}\n", 5e-5 * k,
                        100.0 * std::sin(2.0 * std::numbers::pi * 50.0 * 5e-5 * k));
  const MeasuredRun m = align_record(parse_measured(text, "m.csv"), {.shift = 0.0, .angle = {}},
                                     short_rig(), {{"native", &run}});
  ASSERT_EQ(m.figures.size(), 1u);
  EXPECT_NEAR(figure_of(m, "rotor_x_rms").measured, 100e-6 / std::sqrt(2.0), 1e-9)
      << "four whole turns, whatever the zero";
  EXPECT_NEAR(figure_of(m, "rotor_x_rms").runs.front(), 100e-6 / std::sqrt(2.0), 1e-9);
}

// A force exceeds the sensor's limit: sums and maxima are bounds, and the run is not clipped.
TEST(MeasuredRun, AClippedForceIsABound) {
  const auto force = [](double t) { return std::max(0.0, 50.0 * std::sin(400.0 * t) * (1.0 + t)); };
  const Trajectory run = hand_made(10001, 1e-5, [&](double t) {
    Row row;
    row.normal = force(t);
    return row;
  });
  std::string text = "t [s], force [N]\n";
  for (int k = 0; k < 1900; ++k)
    text += fmt::format("{:.17g},{:.17g}\n", 5e-5 * (k + 1), std::min(40.0, force(5e-5 * (k + 1))));
  const scene::Scene scene = short_rig();
  const MeasuredRun m = align_record(parse_measured(text, "m.csv"), {.shift = 0.0, .angle = {}},
                                     scene, {{"native", &run}});
  EXPECT_GT(column_of(m, "force").clipped, 100u);
  for (const char* key : {"mean_force", "peak_force"}) {
    EXPECT_EQ(figure_of(m, key).bound, Bound::kAtLeast) << key;
    EXPECT_GT(figure_of(m, key).runs.front(), figure_of(m, key).measured) << key;
  }
  EXPECT_EQ(figure_of(m, "peak_force").measured, 40.0);
  EXPECT_LT(column_of(m, "force").runs.front().rms, 0.05)
      << "a mean over 50 us of a sine is near its value";
  EXPECT_EQ(measured_value(figure_of(m, "peak_force")), "≥ 40");
}

// The force of a sample is the momentum transferred in its interval, divided by the interval, with
// all impacts of the run.
TEST(MeasuredRun, AForceIsAveragedOverItsSample) {
  Trajectory run = hand_made(10001, 1e-5, [](double) {
    Row row;
    row.normal = 3.0;
    return row;
  });
  run.contact_model = "rigid";
  Impact hit;
  hit.t = 0.0500031;
  hit.normal_impulse = 0.02;
  run.impacts = {hit};
  std::string text = "t [ms], force [N]\n";
  for (int k = 0; k < 900; ++k)
    text += fmt::format("{:.17g},{}\n", 5.0 + 0.1 * k, k == 450 ? 203.0 : 3.0);
  const scene::Scene scene = short_rig();
  const MeasuredRun m = align_record(parse_measured(text, "m.csv"), {}, scene, {{"native", &run}});
  EXPECT_EQ(m.alignment.by, std::vector<std::string>{"force"});
  ASSERT_EQ(m.forces.size(), 1u);
  const MeasuredFigure& peak = figure_of(m, "peak_force");
  EXPECT_NEAR(peak.runs.front(), 203.0, 1e-6) << "0.02 N s in 100 us, and the lasting 3 N";
  EXPECT_NEAR(figure_of(m, "mean_force").runs.front(), 3.0 + 0.02 / (900 * 1e-4), 1e-6);
  EXPECT_NEAR(figure_of(m, "mean_force").measured, figure_of(m, "mean_force").runs.front(), 1e-6);
}

// Over a whole run the forces of the samples add up to the run's own impulse, up to the trapezoidal
// rule over rows.
TEST(MeasuredRun, NoMomentumIsLostBetweenSamples) {
  const scene::Scene scene = short_rig();
  std::vector<double> rows, t;
  for (int k = 0; k <= 20000; ++k) rows.push_back(k * 5e-6);
  const Trajectory run = run_at(scene, rows);
  for (int k = 0; k < 2000; ++k) t.push_back(25e-6 + k * 50e-6);
  const Measurable* force = nullptr;
  for (const Measurable& m : measurables()) force = m.name == kContactForce ? &m : force;
  double sum = 0.0;
  for (const double f : SampledRun(run).values(*force, sample_times(t, 50e-6))) sum += 50e-6 * f;
  EXPECT_NEAR(sum, run.statistics.impulse_total, 2e-3 * run.statistics.impulse_total);
}

// Noise and another clock change the measured figures, not those of the runs at the samples.
TEST(MeasuredRun, HoldsEveryRunAtTheSameSamples) {
  const scene::Scene scene = short_rig();
  const Sensors sensors{.to = 0.095, .shift = 2.5e-3, .angle = 0.4, .noise = 4e-6};
  std::vector<double> rows;
  for (int k = 0; k <= 10000; ++k) rows.push_back(k * 1e-5);
  const Trajectory seen = run_at(scene, instants(sensors)), native = run_at(scene, rows);
  const MeasuredRun m =
      align_record(record_of(seen, sensors), {}, scene, {{"native", &native}, {"again", &native}});
  EXPECT_EQ(m.labels, (std::vector<std::string>{"native", "again"}));
  for (const ColumnFit& c : m.columns) {
    // rms of n normal numbers: within 5 / sqrt(2 n) of their deviation, and what the fit is off by
    // is less.
    const double room = 5.0 / std::sqrt(2.0 * static_cast<double>(c.good)) + 0.03;
    EXPECT_NEAR(c.runs[0].rms / sensors.noise, 1.0, room) << c.what->name;
    EXPECT_EQ(c.runs[0].rms, c.runs[1].rms) << c.what->name;
  }
  // In the scene's frame and clock.
  const MeasuredColumn* x = m.laid.find("rotor_x");
  ASSERT_TRUE(x);
  EXPECT_NEAR(m.laid.t.front(), sensors.from, 0.2 / sensors.rate);
  EXPECT_NEAR(x->value[1000], seen.column("rotor_x")[1000], 6.0 * sensors.noise);
}

TEST(MeasuredRun, SaysWhatItLeavesOut) {
  const scene::Scene scene = short_rig();
  const Trajectory run = run_event(scene);
  std::string text = "t [ms], gap [um], current_1 [A]\n";
  for (std::size_t i = 0; i < run.rows(); ++i) {
    text += fmt::format("{:.17g},{},1\n", 1e3 * run.column("t")[i],
                        i % 7 == 0 ? "" : fmt::format("{:.17g}", 1e6 * run.column("gap")[i]));
  }
  const MeasuredRun m = align_record(parse_measured(text, "m.csv"), {}, scene, {{"native", &run}});
  ASSERT_EQ(m.columns.size(), 1u);
  EXPECT_GT(m.columns.front().missing, run.rows() / 8);
  EXPECT_LT(m.columns.front().runs.front().share.value(), 1e-9);
  std::string remarks;
  for (const std::string& r : m.remarks) remarks += r + "\n";
  EXPECT_NE(remarks.find("current_1 is left out"), std::string::npos) << remarks;

  std::string nothing = "t [ms], current_1 [A]\n";
  for (int k = 0; k < 20; ++k) nothing += fmt::format("{},1\n", k);
  EXPECT_THROW(align_record(parse_measured(nothing, "m.csv"), {}, scene, {{"native", &run}}),
               MeasuredError);
}

// A frequency beyond the sample rate is left out, with the reason.
TEST(MeasuredRun, AFrequencyNeedsASampleRate) {
  const double w = 2.0 * std::numbers::pi * 300.0;
  const Trajectory run = moving(20001, 1e-5, [&](double t) { return std::polar(1e-4, w * t); });
  std::string text = "t [ms], rotor_x [um], rotor_y [um]\n";
  for (int k = 0; k < 80; ++k)
    text += fmt::format("{},{},{}\n", 2.0 * k, 100.0 * std::cos(w * 2e-3 * k),
                        100.0 * std::sin(w * 2e-3 * k));
  const MeasuredRun m = align_record(parse_measured(text, "m.csv"), {.shift = 0.0, .angle = 0.0},
                                     short_rig(), {{"native", &run}});
  EXPECT_THROW(figure_of(m, "rotor_frequency"), std::out_of_range);
  EXPECT_NE(m.remarks.back().find("sample rate"), std::string::npos) << m.remarks.back();
}

void collect_keys(const nlohmann::json& object, const std::string& prefix,
                  std::set<std::string>& keys) {
  for (const auto& [key, value] : object.items()) {
    const bool named = (prefix == "columns." || prefix == "columns.<name>.runs.");
    const std::string name = prefix + (named ? (prefix == "columns." ? "<name>" : "<run>") : key);
    if (prefix == "figures.") {
      keys.insert(name);
      keys.insert("figures.<name>.bound");
    } else if (value.is_object() && prefix != "alignment.") {
      collect_keys(value, name + ".", keys);
    } else {
      keys.insert(name);
    }
  }
}

// Every key of compare.json is documented, and every documented key occurs or may occur.
TEST(MeasuredRun, KeysAreDocumented) {
  const scene::Scene scene = short_rig();
  const Trajectory run = run_event(scene);
  const Sensors sensors{.to = 0.09, .rate = 1e4};
  const MeasuredRun m = align_record(record_of(run_at(scene, instants(sensors)), sensors), {},
                                     scene, {{"native", &run}});
  std::set<std::string> found, documented;
  collect_keys(result::json_of(measured_section(m)), "", found);
  for (const ColumnMeaning& key : measured_keys()) documented.insert(std::string(key.name));
  for (const std::string& key : found) EXPECT_TRUE(documented.contains(key)) << key;
  for (const std::string& key : documented)
    EXPECT_TRUE(found.contains(key) || key.starts_with("figures.")) << key;
  EXPECT_LE(widest_line(result::text_of(measured_section(m))), 80u);
}

}  // namespace
}  // namespace rotorub::test
