// An impact of the event-driven run, (15)-(19): at once, or over compression and expansion times.
#pragma once

#include <vector>

#include "native_model/contact/impact_map.h"
#include "native_model/event/observer.h"

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
  // At a contact that closes. Moves the motion on, at most to `end` (s); tells the observer.
  Outcome run(Motion& motion, const ContactPoint& touch, double end);

 private:
  Outcome at_once(Motion& motion, const ContactPoint& touch, const ImpactLaw& law,
                  const ImpactInput& in, Impact& record);
  Outcome over_time(Motion& motion, const ContactPoint& touch, const ImpactLaw& law,
                    ImpactInput& in, Impact& record, double end);
  void phase_of(Motion& motion, const Eigen::Vector2d& e_r, double tau, double normal,
                double friction, Impact& record, double end);
  bool impact_longer_than_flight(const Motion& motion, const ContactPoint& touch);
  Eigen::Vector3d contact_velocity(const Motion& motion) const;

  const Model* model_;
  const EventParameters* parameters_;
  Phase* phase_;
  Constraint* constraint_;
  Observer* observer_;
  // nq each: the loads held over an impact that takes time, their accelerations, v_0 and v_1.
  std::vector<double> force_, acceleration_, before_, after_;
};

}  // namespace rotorub
