// [magnetic_bearing]: a magnetic bearing that carries the rotor by its own feedback. Its law is in
// bearing/magnetic_feedback.h.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "native_model/scene/config_entry.h"

namespace rotorub::scene {

inline constexpr double kNever = 1e300;  // s, a switching time that is never reached

// Matrices of a linear sampled law (control/linear_controller.h), stored row by row.
struct ControlMatrices {
  std::vector<double> state, input, output, feedthrough;  // A, B, C, D; D in A/m
};

enum class ControlForm { kPid, kTransferFunction, kStateSpace, kShared };  // the control law

// Control of each axis, x and y. With `shared`, [magnetic_control] gives the current.
struct BearingControl {
  double force_per_current = 0.0;  // linear: N/A, k_i > 0
  // A/m, P >= 0. Forms other than pid use it only as the spring with which the shaft's modes
  // are computed.
  double proportional = 0.0;
  double integral = 0.0;        // pid: A/(m s), I >= 0, needs P > 0
  double derivative = 0.0;      // pid: A s/m, D >= 0
  double derivative_lag = 0.0;  // pid: s, >= 0, of the derivative's filter
  // A, > 0, on each axis; at most the bias of an electromagnet.
  double current_limit = std::numeric_limits<double>::infinity();
  // The bearing works for works_from <= t < fails_at and for t >= returns_at. Otherwise it has
  // neither current nor negative stiffness. s, >= 0.
  double works_from = 0.0, fails_at = kNever, returns_at = kNever;
  ControlForm form = ControlForm::kPid;
  double sample_time = 0.0;  // s, >= 0; 0: continuous, for pid only
  double delay = 0.0;        // s, >= 0, a whole number of samples
  // transfer_function: coefficients of powers of 1/z, from the 0th; A/m and 1.
  std::vector<double> numerator{}, denominator{};
  ControlMatrices matrices{};  // state_space: of one axis

  bool sampled() const { return sample_time > 0.0 || form == ControlForm::kShared; }
  bool works_at(double t) const { return t >= returns_at || (t >= works_from && t < fails_at); }
  // True if the bearing works at any time.
  bool works() const { return works_from < fails_at || returns_at < kNever; }
};

enum class SharedLaw { kMatrices, kLibrary };  // the scene's matrices, or the user's library

// One law for all bearings of form `shared`, in the order of the scene, with two ports each: x, y.
struct SharedControl {
  SharedLaw kind = SharedLaw::kMatrices;
  double sample_time = 0.0;  // s, > 0
  double delay = 0.0;        // s, >= 0, a whole number of samples
  ControlMatrices matrices{};
  // library: path of the file, absolute or relative to the scene's, and the settings passed to it
  std::string library{};
  std::vector<ConfigEntry> config{};

  bool by_library() const { return kind == SharedLaw::kLibrary; }
};

// The amplifier, between the current that the control asks for and the current of the coil.
struct Amplifier {
  double bandwidth = 0.0;                                          // rad/s, > 0
  double voltage_limit = std::numeric_limits<double>::infinity();  // V, > 0
  double inductance = 0.0;                                         // H, > 0 with a voltage_limit
  double resistance = 0.0;                                         // Ohm, >= 0
};

enum class MagnetKind { kLinear, kElectromagnet };  // force as a function of current and gap

// linear: the force at the station is negative_stiffness * deflection + force_per_current * current
// of `control`. electromagnet: two opposed magnets on each axis (bearing/opposed_magnets.h), driven
// by that current.
struct MagneticBearing {
  double station = 0.0;                     // m, geometry form
  std::vector<double> shape;                // modal form: mode values at the station, default all 1
  double negative_stiffness = 0.0;          // linear: N/m, >= 0
  std::optional<BearingControl> control{};  // absent: no feedback
  // Position of the sensor. Absent: at the bearing.
  std::optional<double> sensor_station{};  // m, geometry form
  std::vector<double> sensor_shape{};      // modal form; empty: same as `shape`
  std::optional<Amplifier> amplifier{};    // absent: the current follows at once
  MagnetKind kind = MagnetKind::kLinear;
  double force_constant = 0.0;  // electromagnet: N m^2/A^2, k_m > 0
  double bias_current = 0.0;    // electromagnet: A, i_0 > 0
  double air_gap = 0.0;         // electromagnet: m, s_0 > 0

  // True if the bearing is only a constant negative stiffness.
  bool is_spring() const { return !control && kind == MagnetKind::kLinear; }
  bool senses_elsewhere() const { return sensor_station || !sensor_shape.empty(); }
  // N/m, negative stiffness k_s; linearised about the centre for an electromagnet.
  double pull() const {
    if (kind == MagnetKind::kLinear) return negative_stiffness;
    return 4.0 * force_constant * bias_current * bias_current / (air_gap * air_gap * air_gap);
  }
  // N/A, k_i, likewise. A linear bearing must have a control.
  double force_per_current() const {
    if (kind == MagnetKind::kLinear) return control->force_per_current;
    return 4.0 * force_constant * bias_current / (air_gap * air_gap);
  }
  // A, limit of the control's current.
  double current_limit() const {
    if (kind == MagnetKind::kLinear) return control->current_limit;
    return control ? std::min(control->current_limit, bias_current) : bias_current;
  }
};
inline constexpr std::size_t kMaxMagneticBearings = 8;

}  // namespace rotorub::scene
