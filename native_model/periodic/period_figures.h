// Figures of one period of a motion, from its stretches; the values within a stretch are those at
// kSamples instants.
#pragma once

#include <vector>

#include "native_model/periodic/periodic_motion.h"
#include "native_model/trajectory/keyphasor.h"

namespace rotorub::periodic {

// Figures of one contact in a period.
struct ContactFigures {
  double mean_force = 0.0;       // N, normal impulse (impacts included) / period
  double largest_force = 0.0;    // N, normal force outside rigid impacts
  double largest_impulse = 0.0;  // N s, normal, of one rigid impact
  int impacts = 0;               // rigid impacts and touches of a compliant contact
  double contact_share = 0.0;    // of the period, in [0, 1], in which the contact has a force
  double stuck_share = 0.0;      // of the period, in [0, 1], in which it sticks or rolls
  double least_gap = 0.0;        // m, negative: penetration
  double amplitude = 0.0;        // m, largest distance of the rotor's centre from its place at rest
  // rad/s, mean speed at which the rotor's centre goes around the ring's centre; negative:
  // backward.
  double whirl = 0.0;
};

struct PeriodFigures {
  Status status = Status::kOk;
  std::vector<ContactFigures> contacts;  // one per auxiliary bearing
  std::vector<KeyphasorPass> passes;     // of the rotor's mark
};

PeriodFigures period_figures(const Model& model, const PeriodicMotion& motion,
                             const EventParameters& parameters = {});

}  // namespace rotorub::periodic
