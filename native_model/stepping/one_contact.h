// The contact in a fixed step, of one run or of many that have one contact or none: where the
// straight path of a step leaves the circle, lasting contact goes on or an impact begins. Lasting
// contact ends the step on the circle (contact/step_contact.h): sliding on as in the step before
// in all lanes at once, anything else lane by lane. Impacts: verlet_step.h. Several contacts:
// several_contacts.h.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "native_model/stepping/contact_response.h"
#include "native_model/stepping/fixed_step.h"

namespace rotorub {

template <class M>
class OneContact {
 public:
  using T = typename M::Scalar;
  using Mask = lanes::Mask<T>;
  using Centre = equations::Pair<T>;
  using State = StepState<M>;
  static constexpr int kLanes = State::kLanes;

  // Lasting contact: as the step before left it, and from go_on() on of this step.
  struct Lasting {
    T lasts{};               // 1 or 0
    T slip_sign{};           // sliding: +1, -1; 0: free or sticking
    T normal{}, friction{};  // N s, of the step
    // N s, were the forces of its end those of the whole step.
    T normal_at_end{}, friction_at_end{};
  };

  OneContact(State& x, LoadKick<M>& loads, const std::vector<const Model*>& models)
      : response_(x.m), ended_(State::make(x.m)) {
    exists_ = models.front()->first().contact.has_value();
    if (!exists_) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      const ContactParameters& c = *models[static_cast<std::size_t>(lane)]->first().contact;
      lanes::set(clearance_, lane, c.clearance);
      lanes::set(radius_, lane, c.radius);
      const double none = std::numeric_limits<double>::quiet_NaN();
      lanes::set(friction_, lane, c.friction.is_constant() ? c.friction.coefficient : none);
    }
    response_.find(x, loads, radius_);
  }

  Lasting now;
  // Of each lane. Large, and rarely touched: apart from what every step reads.
  std::vector<ImpactList> impacts = std::vector<ImpactList>(kLanes);
  bool impacted = false;   // in a lane at least
  bool held_open = false;  // in a lane at least an impact that takes time is under way
  T flying{};              // 0 in those lanes, else 1

  bool exists() const { return exists_; }
  // N s, what the step did, impacts and lasting contact alike.
  const T& normal_impulse() const { return impacted ? with_impacts_.normal : now.normal; }
  const T& friction_impulse() const { return impacted ? with_impacts_.friction : now.friction; }
  bool lasts() const { return lanes::any(now.lasts > T{}); }

  // The step's beginning.
  ROTORUB_INLINE void forget_last() {
    if (!impacted) return;
    for (ImpactList& list : impacts) list.count = 0;
    impacted = false;
  }
  // A state has been written: what stands on the circle and does not close is lasting contact.
  void begin(const State& x);

  // 1 where x.free may come to go_on() unsettled: beside lanes in lasting contact, which iterate it
  // anyway, the others do so with them.
  ROTORUB_INLINE T settles() const { return lanes::all<T>(lasts() ? 1.0 : 0.0); }

  // Lasting contact over the step, where the straight path from x.seen with x.free would leave the
  // circle: x.after from x.free. Gives the lanes in which the path leaves the circle out of flight.
  // In the lanes where `unsettled` is 1, x.free is without what is iterated.
  ROTORUB_INLINE Mask go_on(State& x, LoadKick<M>& loads, const T& unsettled = T{}) {
    const T zero{}, one = lanes::all<T>(1.0), lasted = now.lasts, sign = now.slip_sign;
    const Centre d = equations::separation(x.m, x.seen.data());
    Centre w = equations::relative(x.m, x.free.data());
    T outside = leaving(x, d, w);
    const Mask rests = (outside > zero) & (lasted > zero);
    now.lasts = outside * lasted;
    now.slip_sign = now.lasts * sign;
    now.normal = now.friction = T{};
    Mask on = rests;
    T open = lanes::select(rests, one, unsettled);
    bool again = lanes::any(open > zero);
    for (bool late = false; again; late = true) {
      press_on(on, open, x, loads, d, w);
      if (late) {
        for (std::size_t i = 0; i < x.after.size(); ++i) {
          x.after[i] = lanes::select(on, x.after[i], ended_[i]);
        }
      }
      if (late || !loads.iterates()) break;
      // Now that they are settled: who leaves the circle, in flight or out of lasting contact.
      const Mask waited = (unsettled > zero) & !rests;
      w = equations::relative(x.m, x.free.data());
      outside = lanes::select(waited, leaving(x, d, w), outside);
      on = waited & (outside > zero) & (lasted > zero);
      again = lanes::any(on);
      if (!again) break;
      now.lasts = lanes::select(on, one, now.lasts);
      now.slip_sign = lanes::select(on, sign, now.slip_sign);
      open = lanes::select(on, one, zero);
      for (std::size_t i = 0; i < x.after.size(); ++i) ended_[i] = x.after[i];
    }
    now.normal_at_end = now.normal;
    now.friction_at_end = now.friction;
    return (outside > zero) & (lasted == zero);
  }

  // x.free with the forces of the last step's end, by the normal of now.
  ROTORUB_INLINE void hold_on(State& x, LoadKick<M>& loads) {
    if (!lasts()) return;
    const Centre d = equations::separation(x.m, x.seen.data());
    const T one = lanes::all<T>(1.0), square = d.x * d.x + d.y * d.y;
    const T delta = lanes::square_root(lanes::select(square > T{}, square, one));
    response_.couple(x, loads);
    response_.push(x, loads, x.free.data(), x.free.data(), {d.x / delta, d.y / delta},
                   now.normal_at_end, now.friction_at_end, now.lasts > T{});
  }

  // Of two parts of a step, `first` for `share` of it and this one for `rest`, the lasting contact
  // of the whole in the lanes of `other`; in those that only go on as they `were`, that of the mean
  // loads.
  Mask alike(const Lasting& part, const Lasting& was) const {
    return (part.lasts > T{}) & (part.slip_sign == was.slip_sign);
  }
  void join_parts(const Mask& other, const T& share, const T& rest, const Lasting& first,
                  const Lasting& mean) {
    const Lasting last = now;
    const auto choose = [&](const T& a, const T& b, const T& whole) {
      return lanes::select(other, share * a + rest * b, whole);
    };
    now.lasts = lanes::select(other, last.lasts, mean.lasts);
    now.slip_sign = lanes::select(other, last.slip_sign, mean.slip_sign);
    now.normal = choose(first.normal, last.normal, mean.normal);
    now.friction = choose(first.friction, last.friction, mean.friction);
    now.normal_at_end = lanes::select(other, last.normal, mean.normal_at_end);
    now.friction_at_end = lanes::select(other, last.friction, mean.friction_at_end);
  }
  static Lasting second_part(const Lasting& was, const Lasting& first) {
    Lasting second;
    second.lasts = was.lasts;
    second.slip_sign = first.slip_sign;
    return second;
  }
  // 1 in the lanes in which contact `lasted`, 0 in the others.
  static T lasted(const Lasting& was) { return was.lasts; }

  // Of one lane: an impact has come; contact lasts from here on, or does not.
  void note_impact(int lane, const Impact& impact) {
    if (!impacted) with_impacts_ = now;
    add_to_lane(with_impacts_.normal, lane, impact.normal_impulse);
    add_to_lane(with_impacts_.friction, lane, impact.friction_impulse);
    // After an impact without restitution the gap closes by round-off, which is no second one.
    constexpr double kLeastRate = 1e-9;  // m/s
    if (impact.gap_rate_before < -kLeastRate) impacts[static_cast<std::size_t>(lane)].add(impact);
    impacted = true;
  }
  void set_lasting(int lane, bool lasts) {
    lanes::set(now.lasts, lane, lasts ? 1.0 : 0.0);
    lanes::set(now.slip_sign, lane, 0.0);
  }

  // m^2, |d|^2 as the step ended.
  ROTORUB_INLINE T square_of_relative(const State& x) const {
    const Centre d = equations::separation(x.m, x.q.data());
    return d.x * d.x + d.y * d.y;
  }
  // m/s, of the relative velocity w and the spin, by the normal of the last lasting contact.
  ROTORUB_INLINE T slip_of(const Centre& w, const T& spin) const {
    return normal_.x * w.y - normal_.y * w.x + radius_ * spin;
  }
  // ------------------------------------------------------------------ one run
  // What outlives a step, and the forces.
  template <class Action>
  void for_each_kept(Action action) {
    action(now.lasts);
    action(now.slip_sign);
  }
  template <class Action>
  void for_each_force_kept(Action action) {
    action(now.normal_at_end);
    action(now.friction_at_end);
  }
  // Velocities at the step's end as they would be without its impacts.
  const T* end_without_impacts(const State& x) const {
    return impacted ? x.free.data() : x.after.data();
  }
  // The sign of the slip.
  T slip_sign() const { return now.slip_sign; }
  // What the step did; sign_before: of the slip.
  void tell(FixedStep& out, const T& sign_before) const {
    out.normal_impulse = normal_impulse();
    out.friction_impulse = friction_impulse();
    if (impacted) {
      out.impacts = impacts[0].view();
      return;
    }
    out.lasting = {out.normal_impulse, out.friction_impulse};
    if (!(now.lasts > 0.0)) return;
    out.mode = now.slip_sign == 0.0 ? Mode::kStick : Mode::kSlide;
    out.reversed = sign_before * now.slip_sign < 0.0;
  }
  // J, on the coordinates: of lasting contact, from velocities x.start to x.after.
  double lasting_work(const State& x) const;

 private:
  // 1 where the path from d with the velocity w ends outside the circle, of what flies.
  ROTORUB_INLINE T leaving(const State& x, const Centre& d, const Centre& w) const {
    const T h = lanes::all<T>(x.h), c = clearance_;
    const T px = d.x + h * w.x, py = d.y + h * w.y;
    const T outside = lanes::select(px * px + py * py > c * c, lanes::all<T>(1.0), T{});
    return held_open ? outside * flying : outside;
  }
  // Lasting contact in the lanes of `on`, from d at the step's begin: x.after from x.free, whatever
  // the iteration needs; in flight it is iterated where `open` is 1. Slides on as in the step
  // before where it can, in all lanes at once.
  ROTORUB_INLINE void press_on(const Mask& on, const T& open, State& x, LoadKick<M>& loads,
                               const Centre& d, Centre w) {
    response_.couple(x, loads);
    last_sign_ = now.slip_sign;
    const T zero{}, one = lanes::all<T>(1.0);
    const T square = d.x * d.x + d.y * d.y;
    const T inverse = one / lanes::square_root(lanes::select(square > zero, square, one));
    normal_.x = lanes::select(on, d.x * inverse, normal_.x);
    normal_.y = lanes::select(on, d.y * inverse, normal_.y);
    if (loads.iterates()) loads.begin_iteration(open);
    for (bool settled = false;;) {
      press(on, x, d, w);
      response_.push(x, loads, x.free.data(), x.after.data(), normal_, now.normal, now.friction,
                     on);
      // Once more after the last round: a lane's end must not depend on how long the others went
      // on.
      if (!loads.iterates() || settled) break;
      settled = !loads.improve(x, x.after.data());
      w = equations::relative(x.m, x.free.data());
    }
    now.lasts = lanes::select(on, lanes::select(now.normal > zero, one, zero), now.lasts);
  }

  // The impulses for the present x.free; see contact/step_contact.h.
  ROTORUB_INLINE void press(const Mask& on, State& x, const Centre& d, const Centre& w) {
    const M& m = x.m;
    const T zero{}, one = lanes::all<T>(1.0), h = lanes::all<T>(x.h);
    const T ex = normal_.x, ey = normal_.y;
    const T spin = equations::contact_spin(m, x.free.data());
    const T r = radius_;
    const T ratio = -friction_ * last_sign_;
    // Response to N with T = ratio N.
    const T lx = -ex - ey * ratio, ly = -ey + ex * ratio, lz = r * ratio;
    const auto& a = response_.admittance;
    const T gx = a[0][0] * lx + a[0][1] * ly + a[0][2] * lz;
    const T gy = a[1][0] * lx + a[1][1] * ly + a[1][2] * lz;
    const T gz = a[2][0] * lx + a[2][1] * ly + a[2][2] * lz;
    const T px = d.x + h * w.x, py = d.y + h * w.y, hx = h * gx, hy = h * gy;
    const T square = hx * hx + hy * hy, along = px * hx + py * hy;
    const T circle = clearance_ * clearance_;
    const T depth = px * px + py * py - circle;
    const T root = along * along - square * depth;
    const T normal = depth / (lanes::square_root(lanes::select(root > zero, root, one)) - along);
    const T slip = ex * (w.y + normal * gy) - ey * (w.x + normal * gx) + r * (spin + normal * gz);
    const T turned = d.x * px + d.y * py;
    // Once iterated, the path may end inside: no adhesion.
    const Mask slides = (depth > zero) & (root > zero) & (along < zero) &
                        (slip * last_sign_ > zero) & (turned >= lanes::all<T>(0.5) * circle);
    now.normal = lanes::select(on, normal, now.normal);
    now.friction = lanes::select(on, ratio * normal, now.friction);
    now.slip_sign = lanes::select(on, last_sign_, now.slip_sign);
    const T other = lanes::select(on, lanes::select(slides, zero, one), zero);
    if (!lanes::any(other > zero)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(other, lane) > 0.0) press_lane(lane, x, d, w);
    }
  }
  ROTORUB_SLOW void press_lane(int lane, State& x, const Centre& d, const Centre& w);

  bool exists_ = false;
  T clearance_{}, radius_{};
  // mu. Where it depends on the slip not a number, with which nothing slides on: such a lane is
  // solved by itself.
  T friction_{};
  ContactResponse<M> response_;
  typename State::Coordinates ended_;  // x.after of the other lanes, while some press on late
  Lasting with_impacts_;               // of a step with impacts
  T last_sign_{};
  Centre normal_{};
};

// (ddot, spin) of one lane.
template <class M>
Eigen::Vector3d rates_of_lane(const StepState<M>& x, const typename StepState<M>::Coordinates& v,
                              int lane) {
  const auto w = equations::relative(x.m, v.data());
  return {lanes::get(w.x, lane), lanes::get(w.y, lane),
          lanes::get(equations::contact_spin(x.m, v.data()), lane)};
}

}  // namespace rotorub
