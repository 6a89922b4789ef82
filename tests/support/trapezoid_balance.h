// The energy balance of an engine for which only the states at the ends of its steps are known.
// Works are computed from mean rates and powers at these ends, the work of an impact from its own
// rates.
#pragma once

#include "native_model/model/dynamics.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::test {

class TrapezoidBalance {
 public:
  // The model must outlive this.
  explicit TrapezoidBalance(const Model& model) : model_(&model) {}

  void begin(const Snapshot& start) { last_ = at(start); }
  // normal, friction: impulses over the step up to `now`, N s.
  StepBalance step(const Snapshot& now, double normal, double friction, const Impact* impact) {
    const End end = at(now);
    double gap_rates = last_.gap_rate + end.gap_rate, slips = last_.slip + end.slip;
    if (impact) {
      gap_rates = impact->gap_rate_before + impact->gap_rate_after;
      slips = impact->slip_before + impact->slip_after - 2.0 * held();
    }
    const StepBalance balance{energy(*model_, now.t, now.q, now.v),
                              0.5 * (normal * gap_rates + friction * slips),
                              0.5 * (end.t - last_.t) * (last_.power + end.power)};
    last_ = end;
    return balance;
  }

 private:
  struct End {
    double t = 0.0, gap_rate = 0.0, slip = 0.0, power = 0.0;
  };
  // m/s: the part of the slip at which the machine that holds the prescribed speed does the work,
  // and not the coordinates.
  double held() const {
    const bool moves = model_->layout.spin || !model_->first().contact;
    return moves ? 0.0 : model_->first().contact->radius * model_->speed;
  }
  End at(const Snapshot& now) const {
    const ContactPoint p = contact_point(*model_, now.q, now.v);
    return {now.t, p.gap_rate, p.slip - held(),
            external_power(*model_, now.t, now.q, now.v, now.contacts[0].actuator.force)};
  }

  const Model* model_;
  End last_;
};

}  // namespace rotorub::test
