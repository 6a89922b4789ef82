// What both views show of the contact at one instant, in drawing units.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "renders/machine.h"
#include "renders/playback.h"
#include "renders/scales.h"

namespace rotorub::renders {

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
  std::vector<Eigen::Vector2d> trail;  // m, centres of the rotor, oldest first, the last is now
  std::vector<Spark> sparks;
  ArrowShare normal, friction, control;
  Eigen::Vector2d current{0.0, 0.0};  // [-1, 1], of the coils of each axis, by the film's scale
};

struct InstantOptions {
  double trail_time = 0.02;   // s
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
