// Quantities with a unit: "0.5 mm", "50 Hz", "1.2 kN/mm", "3 N/(m/s)".
//
//   quantity := number [space] [unit]          number: decimal, "12", "-0.5", ".5", "1e-3"
//   unit     := factor { [space | * | ·] factor | / factor }
//   factor   := (name | 1 | ( unit )) [^ integer | ² | ³]
//
// After a division, a further factor needs brackets or its own slash: "N/m s" is refused because it
// could mean N s/m or N/(m s).
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace rotorub::scene {

// Powers of m, kg, s, A, rad. The radian is dimensionless in the SI but is counted here, so that a
// pure number is not accepted in degrees.
using Dimension = std::array<int, 5>;

// The physical quantity of a key. Messages use `name` ("a length"); `unit` is the SI unit of a
// plain number; `examples` lists accepted units.
struct Quantity {
  std::string_view name;
  std::string_view unit;
  std::string_view examples;
  Dimension dimension{};
};

inline constexpr Quantity kPure{"a pure number", "1", "no unit, or %", {}};
inline constexpr Quantity kAngle{"an angle", "rad", "rad, deg", {0, 0, 0, 0, 1}};
inline constexpr Quantity kTime{"a time", "s", "s, ms, us", {0, 0, 1, 0, 0}};
inline constexpr Quantity kLength{"a length", "m", "m, mm, um, in, mil, cm", {1, 0, 0, 0, 0}};
inline constexpr Quantity kMass{"a mass", "kg", "kg, g", {0, 1, 0, 0, 0}};
inline constexpr Quantity kSpin{
    "a speed of rotation or a frequency", "rad/s", "rad/s, Hz, rpm", {0, 0, -1, 0, 1}};
inline constexpr Quantity kRate{"a rate", "1/s", "1/s, 1/ms, Hz", {0, 0, -1, 0, 0}};
inline constexpr Quantity kRateSquared{"a rate squared", "1/s^2", "1/s^2", {0, 0, -2, 0, 0}};
inline constexpr Quantity kAngularAcceleration{
    "an angular acceleration", "rad/s^2", "rad/s^2, Hz/s, rpm/s", {0, 0, -2, 0, 1}};
inline constexpr Quantity kVelocity{"a velocity", "m/s", "m/s, mm/s", {1, 0, -1, 0, 0}};
inline constexpr Quantity kSlowness{
    "a coefficient per velocity", "s/m", "s/m, s/mm, 1/(m/s)", {-1, 0, 1, 0, 0}};
inline constexpr Quantity kAcceleration{
    "an acceleration", "m/s^2", "m/s^2, mm/s^2", {1, 0, -2, 0, 0}};
inline constexpr Quantity kForce{"a force", "N", "N, kN", {1, 1, -2, 0, 0}};
inline constexpr Quantity kTorque{"a torque", "N m", "N m, N mm", {2, 1, -2, 0, 0}};
inline constexpr Quantity kStaticMoment{
    "a static moment", "kg m", "kg m, kg mm, g mm", {1, 1, 0, 0, 0}};
inline constexpr Quantity kStiffness{"a stiffness", "N/m", "N/m, N/mm, kN/mm", {0, 1, -2, 0, 0}};
// N/m^n; a unit is accepted only for n = 1.
inline constexpr Quantity kContactStiffness{
    "a stiffness", "N/m^exponent", "N/m, kN/mm, for an exponent of 1", {0, 1, -2, 0, 0}};
inline constexpr Quantity kTimePerLength{"a time per length", "s/m", "s/m", {-1, 0, 1, 0, 0}};
inline constexpr Quantity kDamping{
    "a damping", "N s/m", "N s/m, N s/mm, N/(m/s)", {0, 1, -1, 0, 0}};
inline constexpr Quantity kInertia{
    "a moment of inertia", "kg m^2", "kg m^2, kg mm^2, g mm^2", {2, 1, 0, 0, 0}};
inline constexpr Quantity kAngularStiffness{
    "a torsional stiffness", "N m/rad", "N m/rad, N m, kN m/rad", {2, 1, -2, 0, -1}};
inline constexpr Quantity kAngularDamping{
    "a torsional damping", "N m s/rad", "N m s/rad, N m s, N m/(rad/s)", {2, 1, -1, 0, -1}};
inline constexpr Quantity kCurrent{"a current", "A", "A, mA", {0, 0, 0, 1, 0}};
inline constexpr Quantity kCurrentRate{
    "a rate of current", "A/s", "A/s, A/ms, kA/s", {0, 0, -1, 1, 0}};
inline constexpr Quantity kForcePerCurrent{
    "a force per current", "N/A", "N/A, kN/A, N/mA", {1, 1, -2, -1, 0}};
inline constexpr Quantity kCurrentPerLength{
    "a current per length", "A/m", "A/m, A/mm, kA/m", {-1, 0, 0, 1, 0}};
inline constexpr Quantity kCurrentPerLengthTime{
    "a current per length and time", "A/(m s)", "A/(m s), A/(mm s), kA/(m s)", {-1, 0, -1, 1, 0}};
inline constexpr Quantity kCurrentPerVelocity{
    "a current per velocity", "A s/m", "A s/m, A s/mm, A/(m/s)", {-1, 0, 1, 1, 0}};
inline constexpr Quantity kVoltage{"a voltage", "V", "V, kV", {2, 1, -3, -1, 0}};
inline constexpr Quantity kResistance{"a resistance", "Ohm", "Ohm, mOhm, V/A", {2, 1, -3, -2, 0}};
inline constexpr Quantity kInductance{"an inductance", "H", "H, mH, V s/A", {2, 1, -2, -2, 0}};
inline constexpr Quantity kMagnetConstant{
    "a magnet's force constant", "N m^2/A^2", "N m^2/A^2, N mm^2/A^2", {3, 1, -2, -2, 0}};
inline constexpr Quantity kPressure{"a pressure", "Pa", "Pa, MPa, GPa, N/mm^2", {-1, 1, -2, 0, 0}};
inline constexpr Quantity kViscosity{"a viscosity", "Pa s", "Pa s, mPa s", {-1, 1, -1, 0, 0}};
inline constexpr Quantity kDensity{"a density", "kg/m^3", "kg/m^3, g/cm^3", {-3, 1, 0, 0, 0}};

// The SI value (rad for angles, rad/s for speeds), or an error.
struct ParsedQuantity {
  double value = 0.0;  // finite if there is no error
  std::string error;   // empty: success
};

// Parses `text` as a value of `quantity`. Without a unit it is in SI units. Never throws.
ParsedQuantity parse_quantity(std::string_view text, const Quantity& quantity);

}  // namespace rotorub::scene
