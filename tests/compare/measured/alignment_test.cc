#include "compare/measured/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <random>

#include "compare/measured/record.h"
#include "tests/compare/hand_made.h"
#include "tests/compare/measurement.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// The passive rig from rest into its rub, 0.15 s: it bounces, and no two turns are alike.
const scene::Scene& rig() {
  static const scene::Scene scene = shipped("paper_passive", {"run.end=0.15", "run.step=1e-5"});
  return scene;
}

std::vector<double> every(double apart, double end) {
  std::vector<double> t;
  for (double k = 0.0; k * apart <= end * (1.0 + 1e-12); k += 1.0)
    t.push_back(std::min(end, k * apart));
  return t;
}

// The run that is aligned, with rows every 10 us.
const Trajectory& native() {
  static const Trajectory run = run_at(rig(), every(1e-5, 0.15));
  return run;
}

// Exact samples: rows of the reference integrator at the sampling times themselves.
const Trajectory& seen(const Sensors& sensors) {
  static std::map<std::pair<double, double>, Trajectory> known;
  auto& run = known[{sensors.rate, sensors.from}];
  if (run.rows() == 0) run = run_at(rig(), instants(sensors));
  return run;
}

Alignment aligned(const Sensors& sensors, const AlignmentOptions& options = {}) {
  MeasuredRecord record = record_of(seen(sensors), sensors);
  mark_clipped(record);
  return align(record, SampledRun(native()), options);
}

double turned(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

// Without noise what is left is the cubic between rows 10 us apart, and at the jump of a speed v
// within a row no more than v 10 us / 4, some um at 200 impacts of 0.15 s: far below a thousandth
// of a sample at the rig's speeds.
TEST(Alignment, FindsTheClockAndTheFrame) {
  for (const double rate : {20e3, 51.2e3}) {
    for (const double shift : {0.0, 12.3456789e-3, -7.7e-3, 1234.567890123}) {
      for (const double angle : {0.0, 30.0, -135.0, 179.0}) {
        Sensors sensors;
        sensors.rate = rate;
        sensors.shift = shift;
        sensors.angle = angle * kDegree;
        SCOPED_TRACE(fmt::format("{} Hz, {} s, {} deg", rate, shift, angle));
        const Alignment a = aligned(sensors);
        EXPECT_NEAR(a.shift, shift, 1e-3 / rate);
        EXPECT_NEAR(turned(a.angle - sensors.angle), 0.0, 1e-5);
        EXPECT_GT(a.correlation.value(), 0.9999999);
        EXPECT_LT(a.residual.value(), 1e-4);
        EXPECT_TRUE(a.shift_found);
        EXPECT_EQ(a.angle_from, AngleFrom::kFound);
        EXPECT_EQ(a.by, (std::vector<std::string>{"rotor", "ring", "gap"}));
      }
    }
  }
}

// The error that it states is the error that it makes: over seeds, squares of error / stated follow
// chi^2 with as many freedoms; 99.9 % of it lies between the bounds.
TEST(AlignmentLong, EstimatesTheErrorOfNoise) {
  constexpr int kSeeds = 40;
  constexpr double kLow = 17.9 / kSeeds,
                   kHigh = 73.4 / kSeeds;  // 0.1 % and 99.9 % of chi^2 with 40
  double shift = 0.0, angle = 0.0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    Sensors sensors;
    sensors.shift = 3.21e-3;
    sensors.angle = 0.5;
    sensors.noise = 5e-6;
    sensors.seed = seed;
    const Alignment a = aligned(sensors);
    ASSERT_TRUE(a.shift_error && a.angle_error);
    EXPECT_LT(*a.shift_error, 0.2 / sensors.rate);
    shift += std::pow((a.shift - sensors.shift) / *a.shift_error, 2) / kSeeds;
    angle += std::pow((a.angle - sensors.angle) / *a.angle_error, 2) / kSeeds;
  }
  EXPECT_GT(shift, kLow);
  EXPECT_LT(shift, kHigh);
  EXPECT_GT(angle, kLow);
  EXPECT_LT(angle, kHigh);
}

// A model that is wrong leaves what is not noise, and is laid in wrongly by more than noise would:
// stated is what stretches of the record scatter by.
TEST(Alignment, EstimatesTheErrorOfAWrongModel) {
  double most = 0.0;
  for (const char* wrong : {"contact.friction=0.33", "contact.friction=0.27",
                            "contact.restitution=0.4", "stator.stiffness=1.2e5"}) {
    Sensors sensors;
    sensors.shift = 20e-3;
    sensors.angle = 12.0 * kDegree;
    sensors.noise = 1e-6;
    scene::Scene machine = shipped("paper_passive", {"run.end=0.15", "run.step=1e-5", wrong});
    MeasuredRecord record = record_of(run_at(machine, instants(sensors)), sensors);
    const Alignment a = align(record, SampledRun(native()), {});
    ASSERT_TRUE(a.shift_error && a.angle_error) << wrong;
    const double off_shift = std::abs(a.shift - sensors.shift) / *a.shift_error;
    const double off_angle = std::abs(a.angle - sensors.angle) / *a.angle_error;
    EXPECT_LT(off_shift, 4.0) << wrong << ": " << a.shift << " +- " << *a.shift_error;
    EXPECT_LT(off_angle, 4.0) << wrong << ": " << a.angle / kDegree << " +- "
                              << *a.angle_error / kDegree;
    most = std::max({most, off_shift, off_angle});
  }
  EXPECT_GT(most, 0.1) << "something is off";
}

// Clipped samples are left out; with them the error of the fit would be larger.
TEST(Alignment, ClippedSamplesDoNotPull) {
  Sensors sensors;
  sensors.shift = -2.2e-3;
  sensors.angle = 1.0;
  sensors.limit = 300e-6;
  MeasuredRecord record = record_of(seen(sensors), sensors);
  const Alignment naive = align(record, SampledRun(native()), {});
  mark_clipped(record);
  ASSERT_GT(record.find("rotor_x")->count(Sample::kClipped), 100u);
  const Alignment a = align(record, SampledRun(native()), {});
  EXPECT_NEAR(a.shift, sensors.shift, 1e-3 / sensors.rate);
  EXPECT_NEAR(a.angle, sensors.angle, 1e-5);
  EXPECT_LT(a.residual.value(), 1e-4);
  EXPECT_GT(std::abs(naive.angle - sensors.angle), 1e-3);
}

TEST(Alignment, UsesTheGivenShiftAndAngle) {
  Sensors sensors;
  sensors.shift = 2e-3;
  sensors.angle = 0.3;
  const Alignment free = aligned(sensors), told = aligned(sensors, {.shift = 2.2e-3, .angle = 0.3});
  EXPECT_EQ(told.shift, 2.2e-3);
  EXPECT_EQ(told.angle, 0.3);
  EXPECT_FALSE(told.shift_found);
  EXPECT_EQ(told.angle_from, AngleFrom::kGiven);
  EXPECT_GT(told.residual.value(), 100.0 * free.residual.value())
      << "0.2 ms off is a bad fit, and it says so";
  EXPECT_NEAR(aligned(sensors, {.shift = 2e-3, .angle = {}}).angle, 0.3, 1e-5);
  EXPECT_NEAR(aligned(sensors, {.shift = {}, .angle = 0.3}).shift, 2e-3, 1e-3 / sensors.rate);
}

// One signal of any kind is enough.
TEST(Alignment, FindsTheClockFromAnyColumn) {
  Sensors sensors;
  sensors.shift = 1.5e-3;
  const MeasuredRecord whole = record_of(seen(sensors), sensors);
  for (const char* name : {"gap", "rotor_y", "ring_x"}) {
    SCOPED_TRACE(name);
    MeasuredRecord one = whole;
    one.columns = {*whole.find(name)};
    const Alignment a = align(one, SampledRun(native()), {});
    EXPECT_NEAR(a.shift, sensors.shift, 1e-3 / sensors.rate);
    EXPECT_EQ(a.angle_from, AngleFrom::kNoPair);
    EXPECT_EQ(a.angle, 0.0);
  }
}

// Only y, from sensors at a known angle.
TEST(Alignment, TurnsASingleColumnByTheAngleGiven) {
  Sensors sensors;
  sensors.shift = 1.5e-3;
  sensors.angle = 0.9;
  MeasuredRecord record = record_of(seen(sensors), sensors);
  record.columns = {*record.find("rotor_y")};
  const Alignment a = align(record, SampledRun(native()), {.shift = {}, .angle = 0.9});
  EXPECT_NEAR(a.shift, sensors.shift, 1e-3 / sensors.rate);
  EXPECT_LT(a.residual.value(), 1e-4);
}

constexpr double kWhirl = 2.0 * std::numbers::pi * 50.0;  // rad/s
Trajectory circle() {
  return moving(20001, 1e-5, [](double t) { return std::polar(1e-4, kWhirl * t); });
}

// On a circle a turn of the frame equals a shift: the frame is taken as the scene's, and all turns
// of the run look alike.
TEST(Alignment, ReportsThatACircleLeavesTheAngleOpen) {
  const Trajectory run = circle();
  std::string text = "t [s],rotor_x [m],rotor_y [m]\n";
  for (int k = 0; k < 1200; ++k) {
    const double t = 0.031 + k / 20e3;
    text += fmt::format("{:.17g},{:.17g},{:.17g}\n", t - 7.3e-3, 1e-4 * std::cos(kWhirl * t),
                        1e-4 * std::sin(kWhirl * t));
  }
  const MeasuredRecord record = parse_measured(text, "circle.csv");
  const Alignment a = align(record, SampledRun(run), {});
  EXPECT_EQ(a.angle_from, AngleFrom::kCircle);
  EXPECT_EQ(a.angle, 0.0);
  EXPECT_NEAR(std::remainder(a.shift - 7.3e-3, 0.02), 0.0, 1e-8);
  ASSERT_TRUE(a.next);
  EXPECT_TRUE(a.ambiguous());
  EXPECT_NEAR(std::remainder(a.next->shift - a.shift, 0.02), 0.0, 1.0 / 20e3)
      << "another whole turn";
  EXPECT_NE(alignment_text(a).find("ambiguous"), std::string::npos);
  EXPECT_NE(alignment_text(a).find("circle"), std::string::npos);
}

// So near to a circle that a turn makes up for a shift but for a percent of its effect; what is
// left tells them apart all the same, an angle of 0 too. With noise within its own error. What dies
// away makes every instant its own.
TEST(Alignment, TellsShiftAndTurnApartNearACircle) {
  const auto whirl = [](double t) {
    return 1e-4 * (std::polar(1.0, kWhirl * t) +
                   std::polar(0.03 * std::exp(-10.0 * t), -0.37 * kWhirl * t));
  };
  const Trajectory run = moving(20001, 1e-5, whirl);
  std::mt19937 bits(11);
  for (const auto& [noise, degrees] :
       {std::pair{0.0, 25.0}, std::pair{0.0, 0.0}, std::pair{2e-7, 25.0}}) {
    std::normal_distribution<double> error(0.0, noise > 0.0 ? noise : 1.0);
    std::string text = "t [s],rotor_x [m],rotor_y [m]\n";
    for (int k = 0; k < 2400; ++k) {
      const double t = 0.031 + k / 20e3;
      const std::complex<double> z = whirl(t) * std::polar(1.0, -degrees * kDegree);
      const double ex = noise > 0.0 ? error(bits) : 0.0, ey = noise > 0.0 ? error(bits) : 0.0;
      text +=
          fmt::format("{:.17g},{:.17g},{:.17g}\n", t - 12.3456e-3, z.real() + ex, z.imag() + ey);
    }
    const Alignment a = align(parse_measured(text, "near.csv"), SampledRun(run), {});
    EXPECT_EQ(a.angle_from, AngleFrom::kFound) << noise;
    const double shift_room = noise > 0.0 ? 5.0 * a.shift_error.value() : 1e-8;
    EXPECT_NEAR(a.shift, 12.3456e-3, shift_room) << noise;
    EXPECT_NEAR(a.angle, degrees * kDegree, noise > 0.0 ? 5.0 * a.angle_error.value() : 1e-5)
        << noise;
    EXPECT_TRUE(a.turn_for_shift) << "and says how near to a circle it is";
  }
}

TEST(Alignment, RefusesAMotionAtRest) {
  std::string text = "t [s],rotor_x [m],rotor_y [m]\n";
  for (int k = 0; k < 100; ++k) text += fmt::format("{},0,0\n", k * 1e-3);
  EXPECT_THROW(align(parse_measured(text, "still.csv"), SampledRun(circle()), {}), MeasuredError);
  const Alignment a =
      align(parse_measured(text, "still.csv"), SampledRun(circle()), {.shift = 0.01, .angle = {}});
  EXPECT_TRUE(a.by.empty());
  EXPECT_FALSE(a.correlation);
}

}  // namespace
}  // namespace rotorub::test
