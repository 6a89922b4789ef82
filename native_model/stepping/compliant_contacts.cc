// The compliant contacts of a fixed step (step_contacts.h).
#include <algorithm>
#include <cmath>

#include "native_model/contact/kinematics.h"
#include "native_model/stepping/step_contacts.h"

namespace rotorub {
namespace {

constexpr int kTurns = 3;     // updates of the slip's direction by the velocity at the step's end
constexpr int kRounds = 100;  // of contacts coupled through damping and friction

Eigen::Vector2d vector_of(const equations::Pair& p) { return {p.x, p.y}; }

// The part of a straight path of half a step that lies in the wall; the path has the penetrations
// `first` and `last` (m) at its ends.
struct InWall {
  double from = 0.0, to = 0.0;  // fractions of the path
  double depth = 0.0;           // m, mean over that part
};
InWall in_wall(double first, double last) {
  if (first <= 0.0 && last <= 0.0) return {};
  const double crossing = first / (first - last);
  InWall part{0.0, 1.0, 0.0};
  if (first < 0.0) part.from = crossing;
  if (last < 0.0) part.to = crossing;
  part.depth = 0.5 * (std::max(first, 0.0) + std::max(last, 0.0));
  return part;
}

}  // namespace

// Finds the compliant contacts that are in their walls. Touches and their speeds are found on the
// path under the forces of the contacts that are already closed. Without these forces the speed,
// and with it the a of the whole touch, would have an error of order h. Returns false like
// solve_compliant().
bool StepContacts::find_touches(StepState& state) {
  after_ = 0.5 * h_;
  before_ = state.kick_length < 1.0 ? 0.0 : after_;
  std::array<bool, kMaxContacts> was_closed{};
  List open;
  compliant_.clear();
  lasting_.clear();
  for (std::size_t i = 0; i < count(); ++i) {
    Contact& c = contacts_[i];
    if (c.rigid) {
      if (states[i].closed) lasting_.push_back(i);
      continue;
    }
    c.start_rates = rates(i, state.v_start.data());
    turn_normal(c);
    was_closed[i] = states[i].closed;
    if (was_closed[i]) find_wall_impulses(i, c.free_rates);
    (states[i].closed ? compliant_ : open).push_back(i);
  }
  const bool others_act = !open.empty() && !(compliant_.empty() && lasting_.empty());
  if (others_act) {
    if (loads_.coupled()) update_admittance();
    for (const std::size_t i : lasting_) turn_normal(contacts_[i]);
    if (!find_impulses(state)) return false;
  }
  for (const std::size_t i : open) {
    Eigen::Vector3d free = contacts_[i].free_rates;
    if (others_act) free += rates_by(i, compliant_) + rates_by(i, lasting_);
    states[i].closed = was_closed[i];  // a contact that has opened may close again
    find_wall_impulses(i, free);
    if (states[i].closed) compliant_.push_back(i);
  }
  return true;
}

// Finds w_0 and w_1 of the step, and the a of a touch. free: (ddot, spin) at the end of the step
// without the contact's own force.
void StepContacts::find_wall_impulses(std::size_t i, const Eigen::Vector3d& free) {
  Contact& c = contacts_[i];
  State& kept = states[i];
  const CompliantLaw& law = parameters(i).compliance;
  const double length = before_ + after_;
  const Eigen::Vector2d d = vector_of(c.d), first = d - before_ * c.start_rates.head<2>(),
                        last = d + after_ * free.head<2>();
  const double depth = d.norm() - c.clearance;
  c.spring = c.damper = 0.0;
  const InWall one = before_ > 0.0 ? in_wall(first.norm() - c.clearance, depth) : InWall{},
               two = in_wall(depth, last.norm() - c.clearance);
  const double in_one = before_ * (one.to - one.from), in_two = after_ * (two.to - two.from);
  if (in_one + in_two == 0.0) {
    kept.closed = false;
    return;
  }
  if (!kept.closed) {
    // The point at which the path enters the wall, and the velocity at that instant.
    const bool early = in_one > 0.0;
    const double since = early ? before_ * one.from : before_ + after_ * two.from;
    const Eigen::Vector2d there =
        early ? first + one.from * (d - first) : d + two.from * (last - d);
    const Eigen::Vector2d velocity =
        c.start_rates.head<2>() + since / length * (free - c.start_rates).head<2>();
    kept.hunt_crossley = law.a_of_touch(there.normalized().dot(velocity));
    kept.closed = true;
  }
  const bool whole = in_one + in_two >= length;
  c.spring = whole ? length * law.spring(depth)
                   : in_one * law.spring(one.depth) + in_two * law.spring(two.depth);
  c.damper = kept.hunt_crossley * c.spring + law.damping * (in_one + in_two);
}

// Finds the impulses of all closed compliant contacts. Fails with kStepTooLarge and returns false
// if the step is too large for the contact's stiffness.
bool StepContacts::solve_compliant(StepState& state) {
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0.0, largest = 0.0;
    for (const std::size_t i : compliant_) {
      const Contact& c = contacts_[i];
      const double was = states[i].normal, rubbed = states[i].friction;
      solve_one_compliant(i, c.free_rates + rates_by(i, compliant_) + rates_by(i, lasting_));
      moved = std::max(
          {moved, std::abs(states[i].normal - was), std::abs(states[i].friction - rubbed)});
      largest = std::max(largest, states[i].normal);
      // The leapfrog is stable up to h^2 k' g_NN = 4, with k' = n N / p. If the law states its
      // damping a, (h^2 k' + 2 h a N) g_NN counts instead, because the mean of the rates at both
      // ends oscillates beyond it.
      const CompliantLaw& law = parameters(i).compliance;
      const double nn = delassus(admittance(i, i), vector_of(c.e_r), c.radius).nn;
      const double depth = vector_of(c.d).norm() - c.clearance;
      const double spring = law.spring(depth);
      const double slope = law.exponent * spring, damper = law.hunt_crossley * spring;
      if (depth > 0.0 && h_ * (h_ * slope + 2.0 * depth * damper) * nn > 4.0 * depth) {
        state.fail(Status::kStepTooLarge);
        return false;
      }
    }
    if (compliant_.size() < 2 || moved <= 1e-15 * largest) break;
  }
  return true;
}

// end: (ddot, spin) at the end of the step without the contact's own impulses. The slip at each end
// of the step is taken along the circle at the place of the centre there. The whirl turns this
// direction between that place and the one at q_k, half a step away. With the direction at q_k, a
// contact that sticks while its penetration grows would slip at a rate of order h.
void StepContacts::solve_one_compliant(std::size_t i, const Eigen::Vector3d& end) {
  const Contact& c = contacts_[i];
  const Eigen::Vector2d d = vector_of(c.d), e = vector_of(c.e_r);
  const Eigen::Matrix3d& own = admittance(i, i);
  const Eigen::Vector3d normal = own * contact_load(e, c.radius, 1.0, 0.0),
                        friction = own * contact_load(e, c.radius, 0.0, 1.0);
  const auto rates_at = [&](const Eigen::Vector2d& centre, const Eigen::Vector3d& rates) {
    const Eigen::Vector2d e_r = centre.normalized();
    return Eigen::Vector2d(rates_along(e, c.radius, rates).x(),
                           rates_along(e_r, c.radius, rates).y());
  };
  const Eigen::Vector2d first = d - before_ * c.start_rates.head<2>(),
                        before = rates_at(first, c.start_rates);
  Eigen::Vector3d last = end;
  for (int turn = 0; turn < kTurns; ++turn) {
    const Eigen::Vector2d there = d + after_ * last.head<2>();
    const Eigen::Vector2d n = rates_at(there, normal), t = rates_at(there, friction);
    find_compliant_impulses(i, before, rates_at(there, end), {n.x(), t.x(), n.y(), t.y()});
    last = end + states[i].normal * normal + states[i].friction * friction;
  }
}

// before, after: (gap rate, slip) at the ends of the step without the contact's own impulses, which
// add g times themselves.
void StepContacts::find_compliant_impulses(std::size_t i, const Eigen::Vector2d& before,
                                           const Eigen::Vector2d& after, const Delassus& g) {
  const Contact& c = contacts_[i];
  State& kept = states[i];
  const FrictionLaw& friction_law = parameters(i).friction;
  const double half = 0.5 * c.damper, bare = c.spring - half * (before.x() + after.x());
  // With T = t + ratio P.
  const auto normal = [&](double t, double ratio) {
    return std::max(0.0, (bare - half * g.nt * t) / (1.0 + half * (g.nn + g.nt * ratio)));
  };
  const auto slip_of = [&](double n, double t) { return after.y() + g.tn * n + g.tt * t; };
  double sign = before.y() > 0.0 ? 1.0 : before.y() < 0.0 ? -1.0 : 0.0;
  if (std::abs(before.y()) <= kNoSlip * c.radius * std::abs(c.start_rates.z())) sign = 0.0;
  const auto slide = [&](double ratio) {
    kept.normal = normal(0.0, ratio);
    kept.friction = ratio * kept.normal;
  };
  kept.slip_sign = sign;
  double until = 0.0;  // fraction of the step until the slip stops
  if (sign != 0.0) {
    SlipFriction friction(friction_law, before.y());  // at the slip of the middle
    double slip = 0.0;
    do {
      slide(-friction.mu() * sign);
      slip = slip_of(kept.normal, kept.friction);
      if (slip * sign <= 0.0) break;
    } while (friction.improve(0.5 * (before.y() + slip)));
    if (slip * sign > 0.0) return;
    until = before.y() / (before.y() - slip);
  }
  // The slip reaches 0. Friction holds it there, T = -(after + g_tn P) / g_tt, or it slides the
  // other way, and T is the mean of both values, weighted by the times for which they hold.
  const double sticking = -after.y() / g.tt, with = -g.tn / g.tt;
  kept.normal = normal(sticking, with);
  kept.friction = sticking + with * kept.normal;
  kept.slip_sign = 0.0;
  const double mu = friction_law.sticking();
  if (std::abs(kept.friction) <= mu * kept.normal) return;
  const double other = sign != 0.0 ? -sign : kept.friction > 0.0 ? -1.0 : 1.0;
  slide(-mu * other * (1.0 - 2.0 * until));
  kept.slip_sign = other;
}

}  // namespace rotorub
