// An impact of an event-driven run in no time: every contact that is closed takes part in one
// compression and one expansion, (15)-(19).
#pragma once

#include <array>
#include <span>

#include "native_model/dynamics/closed_contacts.h"
#include "native_model/event/observer.h"

namespace rotorub {

struct CoupledImpactOutcome {
  Status status = Status::kOk;
  // Of each that was closed, after it: takes part with an impulse; gdot_N = 0; gdot_T = 0.
  std::array<bool, kMaxContacts> struck{}, rests{}, stuck{};
};

// At contacts on their circles, `closed` with their points; at least one of them closes. Changes
// the velocities, tells the observer.
CoupledImpactOutcome coupled_impact(const Model& model, const EventParameters& parameters,
                                    std::span<const ClosedContact> closed, Motion& motion,
                                    Constraint& constraint, Observer& observer);

}  // namespace rotorub
