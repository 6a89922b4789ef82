// One step of `midpoint`: the loads act at the middle of the step, q_m = q + h/2 v, v+ from the
// forces at (t + h/2, q_m), q+ = q_m + h/2 v+; the contact's normal is that at q_m and lasting
// contact ends on the circle at the next middle (SHAKE on the midpoints). An impact is not located:
// order 1. Of several contacts all that close in a step and all that last take part in one impact
// at its middle.
#pragma once

#include "native_model/stepping/compliant_contacts.h"
#include "native_model/stepping/one_contact.h"
#include "native_model/stepping/several_contacts.h"

namespace rotorub {

template <class M, class Contacts = OneContact<M>>
struct MidpointStep {
  using T = typename M::Scalar;
  using Mask = lanes::Mask<T>;
  static constexpr int kLanes = lanes::kWidth<T>;

  // `models`: those of the lanes, all of the same structure; they and `m` must outlive this.
  MidpointStep(const M& m, const std::vector<const Model*>& models, double h)
      : x(m, h),
        loads(m, models, h),
        contact(x, loads, models, false),
        samples(!models.front()->samplers.empty()) {}

  StepState<M> x;  // x.seen: the middle
  LoadKick<M> loads;
  Contacts contact;
  bool samples;  // of magnetic bearings' controls, as a step begins

  // From t = origin + k h to origin + (k + 1) h. A lane with a status stays where it was.
  ROTORUB_INLINE void step(std::int64_t k) {
    const T half = lanes::all<T>(0.5 * x.h);
    if (samples) sample(x.time_of(k));
    for (int i = 0; i < x.nq(); ++i) {
      const auto c = static_cast<std::size_t>(i);
      x.seen[c] = x.q[c] + half * x.v[c];
      x.start[c] = x.v[c];
    }
    contact.forget_last();
    if (contact.exists()) contact.back_to_circle(x, loads);
    const double t = x.time_of(k);
    const T unsettled = loads.iterates() ? contact.settles() : T{};
    loads.free_velocity(x, k, t, t + 0.5 * x.h, unsettled);
    for (int i = 0; i < x.nq(); ++i) {
      x.after[static_cast<std::size_t>(i)] = x.free[static_cast<std::size_t>(i)];
    }
    if (contact.exists()) {
      const Mask hits = contact.go_on(x, loads, unsettled);
      if (lanes::any(hits)) collide(hits, k);
    }
    x.move(half);
  }

  // A state has been written.
  void restart() {
    loads.forget(x.m);
    contact.begin(x);
  }

  // m/s, as the step ended.
  ROTORUB_INLINE T slip_of_last() const { return contact.slip_at_end(x); }
  // J, of the step's loads on the coordinates; one run.
  double external_work() { return loads.external_work(x, x.after.data()); }
  // s, at the share of step k that is over.
  double time_within(std::int64_t k, double share) const {
    return x.origin + (static_cast<double>(k) + share) * x.h;
  }
  // The scheme keeps nothing beside state and contact.
  template <class Action>
  void for_each_kept(Action) {}

 private:
  ROTORUB_SLOW void sample(double t) {
    double q[kMaxCoordinates], v[kMaxCoordinates];
    for (int lane = 0; lane < kLanes; ++lane) {
      if (x.status[lane] != Status::kOk) continue;
      read_lane(x, x.q, lane, q);
      read_lane(x, x.v, lane, v);
      if (!take_samples(lane_model(x.m, lane), t, x.h, q, v)) continue;
      for (int i = 0; i < x.nq(); ++i) lanes::set(x.v[static_cast<std::size_t>(i)], lane, v[i]);
    }
  }
  // Poisson's law where the contact closes, at the step's middle. Without a flight after it
  // (contact/impact.h) contact lasts from here on.
  ROTORUB_SLOW void collide(const Mask& hits, std::int64_t k);
};

template <>
void MidpointStep<Model, SeveralContacts>::collide(const bool& hits, std::int64_t k);
template <>
inline void MidpointStep<Model, CompliantContacts>::collide(const bool&, std::int64_t) {}

}  // namespace rotorub
