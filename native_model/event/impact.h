// An impact of the event-driven run, (15)-(19): at once, or over compression and expansion times.
#pragma once

#include "native_model/event/observer.h"
#include "native_model/system/finite_impact.h"

namespace rotorub {

class EventImpact {
 public:
  // All must outlive it.
  EventImpact(const Model& model, const EventParameters& parameters, Phase& phase,
              Constraint& constraint, Observer& observer);

  struct Outcome {
    Status status = Status::kOk;
    enum { kParts, kRests, kInside } after = kRests;  // on the circle; kInside: not on it
    bool stuck = false;                               // gdot_T = 0 exactly
  };
  // At a contact that closes alone. Moves the motion on, at most to `end` (s); tells the observer.
  Outcome run(std::size_t contact, Motion& motion, const ContactPoint& touch, double end);

 private:
  Outcome at_once(Motion& motion, const ContactPoint& touch, const ImpactLaw& law);
  Outcome over_time(Motion& motion, const ContactPoint& touch, double end);
  bool rebound_lasts(const Motion& motion, const ContactPoint& touch) const;

  const ContactParameters& parameters_of_contact() const { return *model_->auxiliary[contact_].contact; }

  const Model* model_;
  std::size_t contact_ = 0;
  const EventParameters* parameters_;
  Phase* phase_;
  Constraint* constraint_;
  Observer* observer_;
  FiniteImpact finite_;
};

}  // namespace rotorub
