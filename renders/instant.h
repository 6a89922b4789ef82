// The state that all views show at one instant, in the scales of the film. All runs shown together
// share the scales, so that lengths and heights can be compared.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renders/machine.h"
#include "renders/playback.h"

namespace rotorub::renders {

// Maps a value to a fraction of a height or length.
struct ValueScale {
  double low = 0.0, high = 1.0;      // values at fractions 0 and 1; low < high
  bool logarithmic = false;          // requires low > 0
  double share(double value) const;  // [0, 1]; values outside are clipped
  bool clips(double value) const { return value > high; }
};

struct Scales {
  ValueScale force;    // N, normal force; high 0: no contact; logarithmic if runs differ greatly
  ValueScale control;  // N, magnitude of the control force; high 0: none
  ValueScale current;  // A, magnitude of a coil's current; high 0: none
  ValueScale gap;      // um
  ValueScale impulse;  // N s, normal impulse of an impact
  // True if a run has impacts but no lasting contact, so that impulses are more useful than forces.
  bool impulses = false;
};

// Scales of the rows from `from` to `to`, s. `clearance`: m, 0 without a contact. The scales ignore
// the largest 2 % of each run's forces in contact, and the largest 1 % of its gaps after the first
// contact.
Scales make_scales(std::span<const Playback* const> runs, double from, double to, double clearance);

// "14,050 N", "0.0512 N s", "3.1 µm": at most four digits, grouped by thousands.
std::string value_text(double value, const std::string& unit);
std::string length_text(double metres);  // in mm from 0.1 mm on, else in µm

// A recent impact: its place on the ring and its remaining brightness.
struct Spark {
  Eigen::Vector2d e_r{1.0, 0.0};
  double strength = 0.0;    // (0, 1], square root of the impulse relative to the film's largest
  double brightness = 0.0;  // (0, 1], decreases with time
};

// Length of an arrow relative to the longest one, in the film's scale.
struct ArrowShare {
  double share = 0.0;  // [0, 1]
  bool clipped = false;
};
inline constexpr double kArrowShare = 0.85;  // longest arrow relative to the rotor's radius

// The content of all views at one time: the present pose, the recent path and recent impacts.
struct Instant {
  Pose pose;
  // m, centres of the rotor, from the oldest to the present one; empty if they undersample it.
  std::vector<Eigen::Vector2d> trail;
  std::vector<Spark> sparks;
  std::optional<Strobe> strobe;  // why there is no trail, or why frames undersample the whirl
  ArrowShare normal, friction, control;
  Eigen::Vector2d current{0.0, 0.0};  // [-1, 1], of the coils of each axis, in the film's scale
};

struct InstantOptions {
  double trail_time = 0.02;   // s
  double frame_time = 0.0;    // s of the run, between frames; 0: undersampling is no fault
  double spark_time = 0.005;  // s, until the spark of an impact has faded
};
Instant instant_at(const Playback& playback, double t, const Scales& scales,
                   const InstantOptions& options);

// The drawn circles: centres of ring and rotor and the point of contact, in the plane (Y, Z).
struct DrawnSection {
  Eigen::Vector2d ring{0.0, 0.0};
  Eigen::Vector2d rotor{0.0, 0.0};
  Eigen::Vector2d e_r{0.0, 0.0};
  Eigen::Vector2d e_t{0.0, 0.0};
  Eigen::Vector2d touch{0.0, 0.0};  // on the ring's bore, nearest to the rotor
  bool in_contact = false;
};
DrawnSection drawn_section(const Machine& machine, const Pose& pose);

}  // namespace rotorub::renders
