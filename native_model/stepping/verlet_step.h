// One step of `verlet`: leapfrog, order 2 through impacts, their accumulation and lasting contact.
// The velocity that goes with q_k is that of half a step before, v_{k-1/2}.
//
//   1. v' = v_{k-1/2} + what the last step's impacts left over; free velocity v_f = v_{k+1/2} from
//      all loads at (t_k, q_k), velocity-dependent ones at the mean of v' and v_f. The first step
//      is half a kick.
//   2. The straight path q_k + h v_f stays in the ring: done.
//   3. Lasting contact: the step ends on the circle (one_contact.h, several_contacts.h).
//   4. Where a load or the command jumps within a step of lasting contact: split().
//   5. The path leaves the circle, out of flight: Poisson's law where it does (verlet_impacts.h).
//
// Of the jump w of the velocities by an impact at the share theta of the step, this step takes (1 -
// theta) w, the next one the rest, and what the loads that depend on velocities miss of it,
// -(theta - 1/2) h M^-1 (F(v + w) - F(v)); without that term order 2 is lost. An impact that takes
// time (system/finite_impact.h) goes on over steps; flight is taken up again where it ends, at any
// share of a step.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "native_model/stepping/compliant_contacts.h"
#include "native_model/stepping/one_contact.h"
#include "native_model/stepping/several_contacts.h"
#include "native_model/system/finite_impact.h"

namespace rotorub {

template <class M, class Contacts = OneContact<M>>
struct VerletStep {
  using T = typename M::Scalar;
  using Mask = lanes::Mask<T>;
  using Lasting = typename Contacts::Lasting;
  using Coordinates = typename StepState<M>::Coordinates;
  static constexpr int kLanes = lanes::kWidth<T>;

  // `models`: those of the lanes, all of the same structure; they and `m` must outlive this.
  VerletStep(const M& m, const std::vector<const Model*>& models, double h)
      : x(m, h),
        loads(m, models, h),
        contact(x, loads, models),
        late(x.q),
        mean_after(x.q),
        part_sum(x.q) {
    for (const Model* model : models) {
      const double instant = next_switch(*model, 0.0, std::numeric_limits<double>::infinity());
      switches = switches || std::isfinite(instant);
    }
    loads.sample(models);
    const auto is_slow = [](const Model* model) {
      return model->first().contact && model->first().contact->impact_time() > 0.0;
    };
    takes_time = std::any_of(models.begin(), models.end(), is_slow);
    for (const Model* model : models) {
      if (takes_time) slow_impacts.emplace_back(*model);
    }
  }

  StepState<M> x;
  LoadKick<M> loads;
  Contacts contact;

  Coordinates late;                // m/s, rad/s: what the last step left over
  double first = 1.0, owes = 0.0;  // 1: the next step is half a kick; `late` holds something
  bool was_first = true;
  // J, of the impacts of the step: what the mean of the step's velocities misses of the loads'
  // work.
  double late_work = 0.0;

  bool switches = false;       // a load is switched some time
  bool command_jumps = false;  // in the step that comes
  static constexpr int kJumps = kLanes > 1 ? kLanes : kMaxContacts;
  CommandJump jumps[kJumps];         // of each lane; of one run of each contact
  Lasting before_parts;              // of a step in parts: contact before it
  Coordinates mean_after, part_sum;  // of a step in parts: x.after of the mean loads, of the parts

  bool takes_time = false;                 // an impact, of a lane at least
  std::vector<FiniteImpact> slow_impacts;  // of each lane, if so
  double impact_time[kLanes] = {};         // s, of one that began in the step; 0: none did
  double last_time = 0.0;                  // s, of the last step, from the origin

  // From t_k = origin + k h to t_{k+1}. A lane with a status stays where it was.
  ROTORUB_INLINE void step(std::int64_t k) {
    late_work = 0.0;
    if (takes_time) std::fill_n(impact_time, kLanes, 0.0);
    contact.forget_last();
    const bool later = loads.iterates() && first == 0.0 && !takes_time;
    const T unsettled = later ? contact.settles() : T{};
    kick(k, unsettled);
    const T* free = x.free.data();
    T* after = x.after.data();
    const int nq = x.nq();
    ROTORUB_APART for (int i = 0; i < nq; ++i) after[i] = free[i];
    if (owes > 0.0) {
      for (T& value : late) value = T{};
      owes = 0.0;
    }
    was_first = first > 0.0;
    if (takes_time) find_slow_impacts();
    if (contact.exists()) {
      const double end = x.time_of(k) + 0.5 * x.h, begin = was_first ? x.time_of(k) : end - x.h;
      const bool parts = jumps_between(begin, end);
      if (parts) before_parts = contact.now;
      x.kick = was_first ? 0.5 : 1.0;
      const Mask hits = contact.go_on(x, loads, unsettled);
      if (parts) split(begin, end);
      if (lanes::any(hits)) collide(hits, k);
      if (contact.held_open) go_on_with_slow_impacts(k);
      x.kick = 1.0;
    }
    if (command_jumps) forget_jumps();
    first = 0.0;
    x.move(lanes::all<T>(x.h));
  }

  // The velocities of t_k before step k: v_{k-1/2} + h/2 a(t_k-), with the command as it stands and
  // the contact force of the step before. For controllers, which see them before there is a
  // command.
  ROTORUB_INLINE void velocity_now(std::int64_t k, T* now) {
    if (first > 0.0) {
      for (int i = 0; i < x.nq(); ++i) now[i] = x.v[at(i)];
      return;
    }
    kick(k);
    if (takes_time) find_slow_impacts();
    if (contact.exists()) contact.hold_on(x, loads);
    const T half = lanes::all<T>(0.5);
    for (int i = 0; i < x.nq(); ++i) now[i] = half * (x.start[at(i)] + x.free[at(i)]);
    if (contact.held_open) show_slow_impacts(k, now);
  }

  // A state (q, v at one instant) has been written: the next step is half a kick.
  void restart() {
    first = 1.0;
    owes = 0.0;
    for (T& value : late) value = T{};
    loads.forget(x.m);
    for (FiniteImpact& impact : slow_impacts) impact.cancel();
    contact.begin(x);
  }
  // Of the step that comes: the command of the lane, or of the contact of one run.
  void jump(std::size_t of, const CommandJump& command) {
    jumps[of] = command;
    command_jumps = command_jumps || command.share > 0.0;
    if (command_jumps) loads.jumps = jumps;
  }

  // m/s, of t_k, of lanes whose contact lasted over step k; of the others any number.
  ROTORUB_INLINE T slip_of_last() const {
    equations::Pair<T> w = equations::relative(x.m, x.start.data());
    T spin = equations::contact_spin(x.m, x.start.data());
    if (!was_first) {
      const T half = lanes::all<T>(0.5);
      const equations::Pair<T> end = equations::relative(x.m, x.after.data());
      w.x = half * (w.x + end.x);
      w.y = half * (w.y + end.y);
      spin = half * (spin + equations::contact_spin(x.m, x.after.data()));
    }
    return contact.slip_of(w, spin);
  }
  // N, normal and friction force at t_k of a lane's impact that takes time.
  Eigen::Vector2d impact_force(int lane, std::int64_t k) const {
    if (!takes_time) return {0.0, 0.0};
    return slow_impacts[static_cast<std::size_t>(lane)].force(x.time_of(k));
  }

  // ------------------------------------------------------------------ one run
  // After step k: velocities of t_k, the mean of the two middles, just before an impact of the
  // step and before its samples.
  void last_velocity(double* now) const {
    const double* end = contact.end_without_impacts(x);
    for (int i = 0; i < x.nq(); ++i) {
      now[i] = was_first ? x.start[at(i)] : 0.5 * (x.start[at(i)] + end[i]);
    }
    const Model& model = lane_model(x.m, 0);
    for (int i = model.sampled_states(); i < model.layout.coil(); ++i) now[i] = x.start[at(i)];
    if (contact.held_open) slow_impacts[0].velocities(x.origin + last_time, now);
  }
  // J, of the step's loads on the coordinates.
  double external_work() {
    if (contact.held_open) return late_work;  // the impact has it
    const double kick = was_first ? 0.5 : 1.0;
    return kick * loads.external_work(x, contact.end_without_impacts(x)) + late_work;
  }
  // All of the scheme that outlives a step beside state and contact.
  template <class Action>
  void for_each_kept(Action action) {
    action(first);
    contact.for_each_force_kept(action);
    action(owes);
    for (T& value : late) action(value);
    for (FiniteImpact& impact : slow_impacts) impact.for_each_kept(action);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  // x.start and x.free of step k; `later`: see LoadKick.
  ROTORUB_INLINE void kick(std::int64_t k, const T& later = T{}) {
    const T *q = x.q.data(), *v = x.v.data();
    T *start = x.start.data(), *seen = x.seen.data();
    const int nq = x.nq();
    ROTORUB_APART for (int i = 0; i < nq; ++i) {
      start[i] = v[i];
      seen[i] = q[i];
    }
    if (owes > 0.0) {
      for (int i = 0; i < x.nq(); ++i) x.start[at(i)] += late[at(i)];
    }
    const double t = x.time_of(k);
    loads.free_velocity(x, k, first > 0.0 ? t : t - 0.5 * x.h, t, later);
    if (first > 0.0) halve_kick();
  }
  // x.free of the step's loads, which are those of its kick: the first is half of one.
  ROTORUB_INLINE void halve_kick() {
    const T half = lanes::all<T>(0.5);
    for (int i = 0; i < x.nq(); ++i) x.free[at(i)] = half * (x.start[at(i)] + x.free[at(i)]);
  }

  // ------------------------------------------------------------------ jumps (verlet_jumps.cc)
  // Below, of a step, round-off alone keeps the jump apart from the step's ends.
  static constexpr double kLeastPart = 1e-9;

  // Whether lanes in lasting contact have a jump between begin and end, s.
  ROTORUB_INLINE bool jumps_between(double begin, double end) const {
    if (!switches && !command_jumps) return false;
    if (!contact.lasts()) return false;
    for (int lane = 0; lane < kLanes; ++lane) {
      const double share = share_before_jump(lane, begin, end);
      if (share > kLeastPart && share < 1.0 - kLeastPart) return true;
    }
    return false;
  }
  double share_before_jump(int lane, double begin, double end) const;
  void forget_jumps() {
    for (CommandJump& command : jumps) command = {};
    command_jumps = false;
    loads.jumps = {};
  }
  ROTORUB_SLOW void split(double begin, double end);
  void take_part(const Lasting& was, const T& begin, const T& end);
  void command_part(bool before, const T& share);

  // ------------------------------------------------------------------ impacts (verlet_impacts.cc)
  ROTORUB_SLOW void collide(const Mask& hits, std::int64_t k);
  void collide_lane(int lane, std::int64_t k);
  ROTORUB_SLOW void find_slow_impacts();
  ROTORUB_SLOW void show_slow_impacts(std::int64_t k, T* now) const;
  ROTORUB_SLOW void go_on_with_slow_impacts(std::int64_t k);
  void begin_slow_impact(int lane, std::int64_t k, const double* v, const double* a, double theta);
  void follow_slow_impact(int lane, std::int64_t k);
};

// Several contacts: verlet_shared_impacts.cc. None of their impacts takes time.
template <>
void VerletStep<Model, SeveralContacts>::collide(const bool& hits, std::int64_t k);
template <>
inline void VerletStep<Model, SeveralContacts>::find_slow_impacts() {}
template <>
inline void VerletStep<Model, SeveralContacts>::show_slow_impacts(std::int64_t, double*) const {}
template <>
inline void VerletStep<Model, SeveralContacts>::go_on_with_slow_impacts(std::int64_t) {}

// Contacts that give have no impacts, and nothing that jumps with a load.
#define ROTORUB_NONE(Result, function) \
  template <>                          \
  inline Result VerletStep<Model, CompliantContacts>::function
ROTORUB_NONE(void, collide)(const bool&, std::int64_t) {}
ROTORUB_NONE(void, find_slow_impacts)() {}
ROTORUB_NONE(void, show_slow_impacts)(std::int64_t, double*) const {}
ROTORUB_NONE(void, go_on_with_slow_impacts)(std::int64_t) {}
ROTORUB_NONE(double, share_before_jump)(int, double, double) const { return 0.0; }
ROTORUB_NONE(void, split)(double, double) {}
#undef ROTORUB_NONE

}  // namespace rotorub
