#include "native_model/scene/units.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

namespace rotorub::scene {
namespace {

struct Good {
  const char* text;
  Quantity quantity;
  double value;
};

TEST(Units, GiveTheSiValueToTheLastBits) {
  const std::vector<Good> cases = {
      {"0.5 mm", kLength, 0.5e-3},
      {"0.5mm", kLength, 0.5e-3},
      {"18 mm", kLength, 0.018},
      {"20 um", kLength, 20e-6},
      {"20 \u00b5m", kLength, 20e-6},
      {"20 \u03bcm", kLength, 20e-6},
      {"-1.5e-3 m", kLength, -1.5e-3},
      {"+2 m", kLength, 2.0},
      {".5 m", kLength, 0.5},
      {"  7 m ", kLength, 7.0},
      {"3", kLength, 3.0},
      {"10us", kTime, 10e-6},
      {"8 ms", kTime, 0.008},
      {"1e-5s", kTime, 1e-5},
      {"50 Hz", kSpin, 100.0 * std::numbers::pi},
      {"-50 Hz", kSpin, -100.0 * std::numbers::pi},
      {"4000 rpm", kSpin, 4000.0 * 2.0 * std::numbers::pi / 60.0},
      {"12 rad/s", kSpin, 12.0},
      {"12 1/s", kSpin, 12.0},
      {"12 s^-1", kSpin, 12.0},
      {"180 deg/s", kSpin, std::numbers::pi},
      {"90 deg", kAngle, std::numbers::pi / 2.0},
      {"2 rad", kAngle, 2.0},
      {"30 %", kPure, 0.3},
      {"0.6 kN", kForce, 600.0},
      {"500 g", kMass, 0.5},
      {"210 GPa", kPressure, 210e9},
      {"210e3 N/mm^2", kPressure, 210e9},
      {"12 mil", kLength, 3.048e-4},
      {"1.5 in", kLength, 0.0381},
      {"2 ft", kLength, 0.6096},
      {"100 lb", kMass, 45.359237},
      {"1000 lbf/in", kStiffness, 175126.835246476377952},
      {"1 lbf s/in", kDamping, 175.126835246476377952},
      {"30e6 psi", kPressure, 206842718795.050840101},
      {"2 oz in", kStaticMoment, 0.001440155774750},
      {"72 gmm", kStaticMoment, 72e-6},
      {"3 lb in^2", kInertia, 0.0008779189602876},
      {"7.85 g/cm^3", kDensity, 7850.0},
      {"20 kN/mm", kStiffness, 20e6},
      {"300 N s/m", kDamping, 300.0},
      {"30 mPa s", kViscosity, 0.03},
      {"300 N*s/m", kDamping, 300.0},
      {"300 N\u00b7s/m", kDamping, 300.0},
      {"300 N/(m/s)", kDamping, 300.0},
      {"0.3 N s/mm", kDamping, 300.0},
      {"300 kg/s", kDamping, 300.0},
      {"1800 kg mm^2", kInertia, 1.8e-3},
      {"1 kg m\u00b2", kInertia, 1.0},
      {"0.5 N m s", kAngularDamping, 0.5},
      {"0.5 N m s/rad", kAngularDamping, 0.5},
      {"0.5 Nm/(rad/s)", kAngularDamping, 0.5},
      {"60 N m/rad", kAngularStiffness, 60.0},
      {"60 N m", kAngularStiffness, 60.0},
      {"2 Nm", kTorque, 2.0},
      {"20 mm/s", kVelocity, 0.02},
      {"9.81 m/s^2", kAcceleration, 9.81},
      {"9.81 m/s/s", kAcceleration, 9.81},
      {"2000 1/s", kRate, 2000.0},
      {"4 1/ms^2", kRateSquared, 4e6},
  };
  constexpr double kRoundOff = 4.5e-16;  // relative: two roundings, number and factor
  for (const Good& good : cases) {
    const ParsedQuantity parsed = parse_quantity(good.text, good.quantity);
    EXPECT_EQ(parsed.error, "") << good.text;
    EXPECT_NEAR(parsed.value, good.value, kRoundOff * std::abs(good.value)) << good.text;
  }
  // A decimal unit adds no error of its own: the same double as the literal.
  EXPECT_EQ(parse_quantity("18 mm", kLength).value, 0.018);
  EXPECT_EQ(parse_quantity("20 um", kLength).value, 20e-6);
  EXPECT_EQ(parse_quantity("50 Hz", kSpin).value, 100.0 * std::numbers::pi);
}

struct Bad {
  const char* text;
  Quantity quantity;
  const char* reason;  // must stand in the message
};

TEST(Units, RefuseWhatDoesNotFitAndSayWhatWould) {
  const std::vector<Bad> cases = {
      {"50 Hz", kLength, "m, mm, um"},
      {"0.5 mm", kSpin, "rad/s, Hz, rpm"},
      {"5 m/s", kAcceleration, "an acceleration"},
      {"5 N", kTorque, "N m"},
      {"17 deg", kPure, "a pure number"},
      {"30 %", kAngle, "an angle"},
      {"3 rad m", kPure, "a pure number"},
      {"", kLength, "a length"},
      {"mm", kLength, "a length"},
      {"inf m", kLength, "a length"},
      {"nan", kLength, "a length"},
      {"-inf", kLength, "a length"},
      {"+-1 m", kLength, "a length"},
      {"--1 m", kLength, "a length"},
      {"0x10 m", kLength, "unknown unit 'x'"},
      {"1,5 mm", kLength, "write a decimal point: 1.5 mm"},
      {"0,15", kPure, "write a decimal point: 0.15"},
      {"5 mn", kLength, "unknown unit 'mn' (all units: mjcf/README.md)"},
      {"5 Mm", kLength, "did you mean \"5 mm\"?"},
      {"5 N/m s", kDamping, "ambiguous"},
      {"5 N/(m", kStiffness, "not closed"},
      {"5 N/", kForce, "a unit is missing"},
      {"5 m)", kLength, "unexpected ')'"},
      {"5 m^", kLength, "whole number"},
      {"5 m^1.5", kLength, "unknown unit '.'"},
      {"5 m^99", kLength, "between -9 and 9"},
      {"5 m^99999999999999", kLength, "between -9 and 9"},
      {"1e999 m", kLength, "range of a double"},
      {"1e308 km", kLength, "range of a double"},
      {"5 ((((((((((((((((((((m))))))))))))))))))))", kLength, "too many brackets"},
      // Engineers write pounds for a force, and US units in other spellings.
      {"200000 lb/in", kStiffness, "did you mean \"200000 lbf/in\"? (lb is a mass, lbf a force)"},
      {"5 lbs", kForce, "did you mean \"5 lbf\"? (lb is a mass"},
      {"3lb-in", kTorque, "did you mean \"3lbf in\"? (lb is a mass"},
      {"30e6 lb/in2", kPressure, "did you mean \"30e6 lbf/in^2\"? (lb is a mass"},
      {"0.1 oz-in", kStaticMoment, "did you mean \"0.1 oz in\"?"},
      {"0.1 ozin", kStaticMoment, "did you mean \"0.1 oz in\"?"},
      {"0.283 lb/in3", kDensity, "did you mean \"0.283 lb/in^3\"?"},
      {"7850 kg/m3", kDensity, "did you mean \"7850 kg/m^3\"?"},
      // Other cases and misspelt names.
      {"8500 RPM", kSpin, "did you mean \"8500 rpm\"?"},
      {"50 HZ", kSpin, "did you mean \"50 Hz\"?"},
      // On nameplates they are revolutions.
      {"3000 1/min", kSpin, "write rpm, Hz or rad/s"},
      {"3000 min^-1", kSpin, "write rpm, Hz or rad/s"},
      {"210 gpa", kPressure, "did you mean \"210 GPa\"?"},
      {"2 KG", kMass, "did you mean \"2 kg\"?"},
      {"2 kilogramms", kMass, "did you mean \"2 kg\"?"},
      {"3 milimeter", kLength, "did you mean \"3 mm\"?"},
      {"3 microns", kLength, "did you mean \"3 um\"?"},
      {"3 Meters", kLength, "did you mean \"3 m\"?"},
      {"5 N/MM", kStiffness, "did you mean \"5 N/mm\"?"},
      {"5 N-M", kTorque, "did you mean \"5 N m\"?"},
      {"1800 kg (mm2)", kInertia, "did you mean \"1800 kg (mm^2)\"?"},
  };
  for (const Bad& bad : cases) {
    const ParsedQuantity parsed = parse_quantity(bad.text, bad.quantity);
    EXPECT_NE(parsed.error.find(bad.reason), std::string::npos)
        << "'" << bad.text << "' gave '" << parsed.error << "'";
    EXPECT_EQ(parsed.value, 0.0) << bad.text;
  }
  // A unit that would not fit either is not proposed.
  for (const char* text : {"5 lb", "5 lb/in3", "5 oz-in", "5 x2", "5 2"}) {
    const std::string error = parse_quantity(text, kLength).error;
    EXPECT_NE(error, "") << text;
    EXPECT_EQ(error.find("did you mean"), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace rotorub::scene
