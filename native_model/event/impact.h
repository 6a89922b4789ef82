// Impacts of an event-driven run, (15)-(19). They are instantaneous, with all closed contacts in
// one compression and one expansion; or, with only one contact, they take the times of both phases.
#pragma once

#include <span>

#include "native_model/event/observer.h"
#include "native_model/model/constraint.h"
#include "native_model/model/finite_impact.h"

namespace rotorub {

class EventImpact {
 public:
  // All must outlive this object.
  EventImpact(const Model& model, const EventParameters& parameters, SmoothSystem& system,
              Constraint& constraint, Observer& observer);

  // The result for a contact that was closed.
  struct After {
    std::size_t contact;
    bool struck;          // it has an impulse
    bool rests;           // gdot_N = 0 afterwards
    bool stuck;           // and gdot_T = 0
    Departure departure;  // of the flight, if it does not rest
  };
  struct Outcome {
    Status status = Status::kOk;
    ContactList<After> contacts{};
    bool is_last = false;  // an accumulation of impacts ends here
  };
  // Solves an impact at contacts on their circles, given with their points; at least one of them
  // closes. It changes the motion and reports to the observer. If the impact takes time, it
  // advances the time of the motion, at most to `end` (s).
  Outcome run(Motion& motion, std::span<const ClosedContact> closed, double end);

 private:
  bool takes_time(const Motion& motion, const ClosedContact& touch) const;
  Outcome at_once(Motion& motion, std::span<const ClosedContact> closed);
  Outcome over_time(Motion& motion, const ContactPoint& touch, double end);

  const Model* model_;
  const EventParameters* parameters_;
  SmoothSystem* system_;
  Constraint* constraint_;
  Observer* observer_;
  FiniteImpact finite_;
};

}  // namespace rotorub
