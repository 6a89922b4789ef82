// [magnetic_bearing]: a bearing that holds the rotor by magnets, with a feedback of its own. The
// law: bearing/magnetic_feedback.h.
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

// Of a linear law that is asked once a sample (control/linear_controller.h), row by row.
struct ControlMatrices {
  std::vector<double> state, input, output, feedthrough;  // A, B, C, D; D: A/m
};

enum class ControlForm { kPid, kTransferFunction, kStateSpace, kShared };  // its law

// On each of x and y; `shared`: what [magnetic_control] asks for.
struct BearingControl {
  double force_per_current = 0.0;  // linear: N/A, k_i > 0
  // A/m, P >= 0; of another form than pid the spring alone of which the modes of a shaft are made.
  double proportional = 0.0;
  double integral = 0.0;        // pid: A/(m s), I >= 0, needs P > 0
  double derivative = 0.0;      // pid: A s/m, D >= 0
  double derivative_lag = 0.0;  // pid: s, >= 0, of the derivative's filter
  // A, > 0, on each axis; of an electromagnet at most its bias.
  double current_limit = std::numeric_limits<double>::infinity();
  // It works for works_from <= t < fails_at and for returns_at <= t; in between it has no current
  // and no negative stiffness. s, >= 0.
  double works_from = 0.0, fails_at = kNever, returns_at = kNever;
  ControlForm form = ControlForm::kPid;
  double sample_time = 0.0;  // s, >= 0; 0: continuous, of pid alone
  double delay = 0.0;        // s, >= 0, whole samples
  // transfer_function: of powers of 1/z, from the 0th; A/m and 1.
  std::vector<double> numerator{}, denominator{};
  ControlMatrices matrices{};  // state_space: of one axis

  bool sampled() const { return sample_time > 0.0 || form == ControlForm::kShared; }
  bool works_at(double t) const { return t >= returns_at || (t >= works_from && t < fails_at); }
  // At some time.
  bool works() const { return works_from < fails_at || returns_at < kNever; }
};

enum class SharedLaw { kMatrices, kLibrary };  // the scene's matrices, or the user's library

// One law for all bearings of form `shared`, in the order of the scene, two ports of each: x, y.
struct SharedControl {
  SharedLaw kind = SharedLaw::kMatrices;
  double sample_time = 0.0;  // s, > 0
  double delay = 0.0;        // s, >= 0, whole samples
  ControlMatrices matrices{};
  // library: file, beside the scene's or absolute, and what it is given
  std::string library{};
  std::vector<ConfigEntry> config{};

  bool by_library() const { return kind == SharedLaw::kLibrary; }
};

// Between the current that the control asks for and the coil's.
struct Amplifier {
  double bandwidth = 0.0;                                          // rad/s, > 0
  double voltage_limit = std::numeric_limits<double>::infinity();  // V, > 0
  double inductance = 0.0;                                         // H, > 0 with a voltage_limit
  double resistance = 0.0;                                         // Ohm, >= 0
};

enum class MagnetKind { kLinear, kElectromagnet };  // the force over current and gap

// linear: adds the force + negative_stiffness * deflection at its station, and what `control` does;
// electromagnet: two magnets that pull against each other on each axis (bearing/opposed_magnets.h),
// with the control's current.
struct MagneticBearing {
  double station = 0.0;                     // m, geometry form
  std::vector<double> shape;                // modal form: mode values at the station, default all 1
  double negative_stiffness = 0.0;          // linear: N/m, >= 0
  std::optional<BearingControl> control{};  // absent: it holds nothing
  // Where the control sees the deflection; absent: where the bearing is.
  std::optional<double> sensor_station{};  // m, geometry form
  std::vector<double> sensor_shape{};      // modal form; empty: as `shape`
  std::optional<Amplifier> amplifier{};    // absent: the current is at once what is asked for
  MagnetKind kind = MagnetKind::kLinear;
  double force_constant = 0.0;  // electromagnet: N m^2/A^2, k_m > 0
  double bias_current = 0.0;    // electromagnet: A, i_0 > 0
  double air_gap = 0.0;         // electromagnet: m, s_0 > 0

  // A constant negative stiffness, and nothing else.
  bool is_spring() const { return !control && kind == MagnetKind::kLinear; }
  bool senses_elsewhere() const { return sensor_station || !sensor_shape.empty(); }
  // N/m, k_s, and with a control N/A, k_i: of an electromagnet about the middle.
  double pull() const {
    if (kind == MagnetKind::kLinear) return negative_stiffness;
    return 4.0 * force_constant * bias_current * bias_current / (air_gap * air_gap * air_gap);
  }
  double force_per_current() const {
    if (kind == MagnetKind::kLinear) return control->force_per_current;
    return 4.0 * force_constant * bias_current / (air_gap * air_gap);
  }
  // A, of the control's current.
  double current_limit() const {
    if (kind == MagnetKind::kLinear) return control->current_limit;
    return control ? std::min(control->current_limit, bias_current) : bias_current;
  }
};
inline constexpr std::size_t kMaxMagneticBearings = 8;

}  // namespace rotorub::scene
