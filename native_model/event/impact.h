// An impact of the event-driven run that takes compression and expansion times, (15)-(19); of the
// only contact.
#pragma once

#include "native_model/event/observer.h"
#include "native_model/system/finite_impact.h"

namespace rotorub {

class EventImpact {
 public:
  // All must outlive it.
  EventImpact(const Model& model, const EventParameters& parameters, Phase& phase,
              Observer& observer);

  // Whether it takes its times: not where an accumulation ends, nor where the flight after it would
  // be over before the impact is. Then it is one in no time, without a rebound.
  bool rebounds(const Motion& motion, const ContactPoint& touch) const;

  struct Outcome {
    Status status = Status::kOk;
    enum { kParts, kRests, kInside } after = kRests;  // on the circle; kInside: not on it
  };
  // Moves the motion on, at most to `end` (s); tells the observer.
  Outcome run(Motion& motion, const ContactPoint& touch, double end);

 private:
  const Model* model_;
  const EventParameters* parameters_;
  Phase* phase_;
  Observer* observer_;
  FiniteImpact finite_;
};

}  // namespace rotorub
