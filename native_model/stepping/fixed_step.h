// What a fixed step of one run did.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "native_model/contact/located_impact.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// The impacts of one step, in order.
struct ImpactList {
  int count = 0;
  std::array<Impact, StepImpacts::kMost> impact;
  void add(const Impact& i) {
    if (count < StepImpacts::kMost) impact[static_cast<std::size_t>(count++)] = i;
  }
  std::span<const Impact> view() const { return {impact.data(), static_cast<std::size_t>(count)}; }
};

// A command that jumps within a step: the share of the step before, in (0, 1), and the means before
// and after. Share 0: none.
struct CommandJump {
  double share = 0.0;
  Eigen::Vector2d before{0.0, 0.0}, after{0.0, 0.0};
};

struct FixedStep {
  Status status = Status::kOk;
  Mode mode = Mode::kFree;          // of lasting contact
  bool reversed = false;            // the slip changed its sign without sticking
  double normal_impulse = 0.0;      // N s over the step, impacts and lasting contact alike
  double friction_impulse = 0.0;    // N s, on the rotor along e_t
  std::span<const Impact> impacts;  // in order; until the stepper's next call
  // Of an impact that takes time: how long, in the step that it begins in (s); where it was under
  // way at the step's begin, normal and friction force there (N).
  double impact_time = 0.0;
  Eigen::Vector2d impact_force{0.0, 0.0};
  // J, where asked for: of contact on the coordinates, of all forces but springs and contact.
  double contact_work = 0.0, external_work = 0.0;
};

}  // namespace rotorub
