// Impacts of an event-driven run, (15)-(19): in no time, where every contact that is closed takes
// part in one compression and one expansion; or, of an only contact, over the times of both.
#pragma once

#include <span>

#include "native_model/event/observer.h"
#include "native_model/model/constraint.h"
#include "native_model/model/finite_impact.h"

namespace rotorub {

class EventImpact {
 public:
  // All must outlive it.
  EventImpact(const Model& model, const EventParameters& parameters, Phase& phase,
              Constraint& constraint, Observer& observer);

  // What became of a contact that was closed.
  struct After {
    std::size_t contact;
    bool struck;          // it takes part with an impulse
    bool rests;           // gdot_N = 0, and
    bool stuck;           // gdot_T = 0; else a flight begins
    Departure departure;  // so
  };
  struct Outcome {
    Status status = Status::kOk;
    ContactList<After> contacts{};
    bool is_last = false;  // an accumulation ends here
  };
  // At contacts on their circles, `closed` with their points; at least one of them closes. Changes
  // the motion, whose clock goes on, at most to `end` (s), where it takes its times; tells the
  // observer.
  Outcome run(Motion& motion, std::span<const ClosedContact> closed, double end);

 private:
  bool takes_time(const Motion& motion, const ClosedContact& touch) const;
  Outcome at_once(Motion& motion, std::span<const ClosedContact> closed);
  Outcome over_time(Motion& motion, const ContactPoint& touch, double end);

  const Model* model_;
  const EventParameters* parameters_;
  Phase* phase_;
  Constraint* constraint_;
  Observer* observer_;
  FiniteImpact finite_;
};

}  // namespace rotorub
