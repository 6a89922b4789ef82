// What all views show of one instant, to the scales of the film: one for all runs that are shown
// together, so that lengths and heights can be compared.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renders/machine.h"
#include "renders/playback.h"

namespace rotorub::renders {

// From a value to a share of a height or length.
struct ValueScale {
  double low = 0.0, high = 1.0;      // value at share 0 and at share 1; low < high
  bool logarithmic = false;          // then low > 0
  double share(double value) const;  // [0, 1]: what is beyond is clipped
  bool clips(double value) const { return value > high; }
};

struct Scales {
  ValueScale force;    // N, normal force; high 0: no contact. Logarithmic where runs are far apart
  ValueScale control;  // N, size of the control force; high 0: there is none
  ValueScale current;  // A, of a coil, either sign; high 0: there is none
  ValueScale gap;      // um
  ValueScale impulse;  // N s, normal, of an impact
  bool impulses = false;  // a run has impacts and no lasting contact: impulses say more than forces
};

// Over the rows from `from` to `to`, s. `clearance` in m, 0 without a contact. Forces and gaps
// leave out the largest 2 % and 1 % of each run's rows in contact and from the first touch on.
Scales make_scales(std::span<const Playback* const> runs, double from, double to, double clearance);

// "14,050 N", "0.0512 N s", "3.1 µm": four digits at most, thousands apart.
std::string value_text(double value, const std::string& unit);
std::string length_text(double metres);  // in mm from 0.1 mm on, else in µm

// A recent impact: where on the ring, and how bright it still is.
struct Spark {
  Eigen::Vector2d e_r{1.0, 0.0};
  double strength = 0.0;    // (0, 1], of its impulse against the film's largest, by square root
  double brightness = 0.0;  // (0, 1], falls with time
};

// An arrow's length against the longest one, by the film's scale.
struct ArrowShare {
  double share = 0.0;  // [0, 1]
  bool clipped = false;
};
inline constexpr double kArrowShare = 0.85;  // of the rotor's radius: the longest arrow

// A second view of time: pose now, path of the last while, recent impacts.
struct Instant {
  Pose pose;
  std::vector<Eigen::Vector2d>
      trail;  // m, centres of the rotor, oldest first, the last is now; empty: rows do not show it
  std::vector<Spark> sparks;
  std::optional<Strobe> strobe;  // why there is no trail, or why frames do not show the whirl
  ArrowShare normal, friction, control;
  Eigen::Vector2d current{0.0, 0.0};  // [-1, 1], of the coils of each axis, by the film's scale
};

struct InstantOptions {
  double trail_time = 0.02;   // s
  double frame_time = 0.0;    // s of the run, between frames; 0: a picture
  double spark_time = 0.005;  // s, until an impact has faded
};
Instant instant_at(const Playback& playback, double t, const Scales& scales,
                   const InstantOptions& options);

// The drawn circles: centre of the ring and of the rotor, point of contact; in the plane (Y, Z).
struct DrawnSection {
  Eigen::Vector2d ring{0.0, 0.0};
  Eigen::Vector2d rotor{0.0, 0.0};
  Eigen::Vector2d e_r{0.0, 0.0};
  Eigen::Vector2d e_t{0.0, 0.0};
  Eigen::Vector2d touch{0.0, 0.0};  // on the ring's bore, where the rotor is nearest
  bool in_contact = false;
};
DrawnSection drawn_section(const Machine& machine, const Pose& pose);

}  // namespace rotorub::renders
