// The loads of [[force]] and of the base's motion over fixed steps. A rotating force turns by a
// fixed angle in each step; its sine and cosine are computed anew every kResync steps, so that
// round-off does not accumulate. A load that is switched, ramped or a pulse counts with the mean of
// its envelope over the step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "native_model/model/loads.h"
#include "native_model/model/model.h"

namespace rotorub {

// s, the next instant after `from` at which a load is switched, at most `end`.
double next_switch(const Model& model, double from, double end);

class SteppedLoads {
 public:
  static constexpr std::int64_t kResync = 256;

  // The model must outlive this object. h: s.
  SteppedLoads(const Model& model, double h);

  // Computes the forces of step k: directions at the instant t (s), envelopes over [begin, end]. A
  // repeated call for the same step does nothing.
  void advance(std::int64_t k, double t, double begin, double end);
  // Call it after advance(): takes the envelopes over another part of the step.
  void weigh(double begin, double end);
  // If there are loads that are synchronous with a free spin, call turn_with() after advance();
  // phi: rad, at the instant of the step.
  bool synchronous() const { return synchronous_; }
  void turn_with(double phi);
  void add(double* f) const {
    for (const Load& load : loads_) {
      equations::add_station_force(model_->layout.modes, load.force->shape, load.x, load.y, f);
    }
    if (model_->base) equations::add_base_load(*model_, base_, f);
  }

  void forget() { now_ = -1; }
  // Calls action for every number that is kept between steps.
  template <class Action>
  void visit_saved(Action& action) {
    for (Load& load : loads_) {
      if (load.force->kind != scene::ForceKind::kRotating) continue;
      action(load.cosine);
      action(load.sine);
    }
  }

 private:
  struct Load {
    const AppliedForce* force = nullptr;
    bool switched = false;                      // or ramped
    double off = 0.0;                           // s, not before `on`
    double cosine = 0.0, sine = 0.0;            // of the present direction
    double turn_cosine = 1.0, turn_sine = 0.0;  // of the turn in one step
    double share = 0.0, x = 0.0, y = 0.0;       // mean envelope in the step; N, present force
  };
  static double mean_envelope(const Load& load, double begin, double end);
  static double mean_pulse(const Load& load, double begin, double end);

  const Model* model_;
  std::int64_t now_ = -1;
  bool synchronous_ = false;
  std::vector<Load> loads_;
  equations::Pair base_{};  // m/s^2, mean acceleration of the base in the step
};

}  // namespace rotorub
