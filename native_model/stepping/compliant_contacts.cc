#include "native_model/stepping/compliant_contacts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

constexpr int kTurns = 3;     // of the direction of slip, by the velocity that the step ends with
constexpr int kRounds = 100;  // of contacts that act on each other through damping and friction

// The part of a straight path of half a step in which it is in the wall. p: m, its depths.
struct InWall {
  double from = 0.0, to = 0.0;  // shares of the path
  double depth = 0.0;           // m, the mean over that part
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

void CompliantContacts::begin(const StepState& x) {
  of_ = {};
  for (std::size_t i = 0; i < count(); ++i) {
    const ContactPoint p = contact_point(m_, x.q.data(), x.v.data(), i);
    of_[i].touches = CompliantLaw::begins_closed(p.gap, p.gap_rate, law(i).clearance);
    of_[i].hunt_crossley = law(i).compliance.a_of_start();
  }
}

// w_0 and w_1 of the step, and the a of a touch. free: (ddot, spin) at the step's end, without the
// contact's own force.
void CompliantContacts::meet_wall(std::size_t i, const Eigen::Vector3d& free) {
  const Place& at = places[i];
  const CompliantLaw& law_of = law(i).compliance;
  const double clearance = law(i).clearance, length = before_ + after_;
  const Eigen::Vector2d first = at.d - before_ * at.start.head<2>(),
                        last = at.d + after_ * free.head<2>();
  const double depth = at.d.norm() - clearance;
  Contact& c = of_[i];
  c.spring = c.damper = 0.0;
  const InWall one = before_ > 0.0 ? in_wall(first.norm() - clearance, depth) : InWall{},
               two = in_wall(depth, last.norm() - clearance);
  const double in_one = before_ * (one.to - one.from), in_two = after_ * (two.to - two.from);
  if (in_one + in_two == 0.0) {
    c.touches = false;
    return;
  }
  if (!c.touches) {
    // Where the path enters the wall, with the velocity of that instant.
    const bool early = in_one > 0.0;
    const double since = early ? before_ * one.from : before_ + after_ * two.from;
    const Eigen::Vector2d there =
        early ? first + one.from * (at.d - first) : at.d + two.from * (last - at.d);
    const Eigen::Vector2d velocity =
        at.start.head<2>() + since / length * (free - at.start).head<2>();
    c.hunt_crossley = law_of.a_of_touch(there.normalized().dot(velocity));
    c.touches = true;
  }
  const bool whole = in_one + in_two >= length;
  c.spring = whole ? length * law_of.spring(depth)
                   : in_one * law_of.spring(one.depth) + in_two * law_of.spring(two.depth);
  c.damper = c.hunt_crossley * c.spring + law_of.damping * (in_one + in_two);
}

// Slip at an end of the step is along the circle where the centre is then: half a step away from
// the place that the step sees the whirl has turned it, by which a contact that sticks while it is
// pressed in would slip at a rate of the order of h.
void CompliantContacts::press_one(std::size_t i, const Eigen::Vector3d& end) {
  const Place& at = places[i];
  const double radius = law(i).radius;
  const Eigen::Matrix3d own = admittance(i, i);
  const Eigen::Vector3d normal = own * contact_load(at.e_r, radius, 1.0, 0.0),
                        friction = own * contact_load(at.e_r, radius, 0.0, 1.0);
  const auto rates_at = [&](const Eigen::Vector2d& centre, const Eigen::Vector3d& rates) {
    const Eigen::Vector2d e_r = centre.normalized();
    return Eigen::Vector2d(rates_along(at.e_r, radius, rates).x(),
                           rates_along(e_r, radius, rates).y());
  };
  const Eigen::Vector2d first = at.d - before_ * at.start.head<2>(),
                        before = rates_at(first, at.start);
  Eigen::Vector3d last = end;
  for (int turn = 0; turn < kTurns; ++turn) {
    const Eigen::Vector2d there = at.d + after_ * last.head<2>();
    const Eigen::Vector2d n = rates_at(there, normal), t = rates_at(there, friction);
    find_impulses(i, before, rates_at(there, end), {n.x(), t.x(), n.y(), t.y()});
    last = end + of_[i].normal * normal + of_[i].friction * friction;
  }
}

void CompliantContacts::find_impulses(std::size_t i, const Eigen::Vector2d& before,
                                      const Eigen::Vector2d& after, const Delassus& g) {
  const Place& at = places[i];
  Contact& c = of_[i];
  const double radius = law(i).radius;
  const double half = 0.5 * c.damper, bare = c.spring - half * (before.x() + after.x());
  // With T = t + ratio P.
  const auto normal = [&](double t, double ratio) {
    return std::max(0.0, (bare - half * g.nt * t) / (1.0 + half * (g.nn + g.nt * ratio)));
  };
  const auto slip_of = [&](double n, double t) { return after.y() + g.tn * n + g.tt * t; };
  double sign = before.y() > 0.0 ? 1.0 : before.y() < 0.0 ? -1.0 : 0.0;
  if (std::abs(before.y()) <= kNoSlip * radius * std::abs(at.start.z())) sign = 0.0;
  const auto slide = [&](double ratio) {
    c.normal = normal(0.0, ratio);
    c.friction = ratio * c.normal;
  };
  c.slip_sign = sign;
  double until = 0.0;  // share of the step until it stops
  if (sign != 0.0) {
    SlipFriction friction(law(i).friction, before.y());  // of the middle
    double slip = 0.0;
    do {
      slide(-friction.mu() * sign);
      slip = slip_of(c.normal, c.friction);
      if (slip * sign <= 0.0) break;
    } while (friction.improve(0.5 * (before.y() + slip)));
    if (slip * sign > 0.0) return;
    until = before.y() / (before.y() - slip);
  }
  // It stops: friction holds it, T = -(after + g_tn P) / g_tt, or it slides the other way, and T is
  // the mean of both by the time that each holds.
  const double held = -after.y() / g.tt, with = -g.tn / g.tt;
  c.normal = normal(held, with);
  c.friction = held + with * c.normal;
  c.slip_sign = 0.0;
  const double mu = law(i).friction.sticking();
  if (std::abs(c.friction) <= mu * c.normal) return;
  const double other = sign != 0.0 ? -sign : c.friction > 0.0 ? -1.0 : 1.0;
  slide(-mu * other * (1.0 - 2.0 * until));
  c.slip_sign = other;
}

// The impulses of all; false where the spring turns faster than the step can follow.
bool CompliantContacts::press(StepState& x) {
  ContactList<std::size_t> pressing;
  for (std::size_t i = 0; i < count(); ++i) {
    of_[i].normal = of_[i].friction = 0.0;
    if (of_[i].touches) pressing.push_back(i);
  }
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0.0, largest = 0.0;
    for (const std::size_t i : pressing) {
      Eigen::Vector3d end = places[i].free;
      for (const std::size_t j : pressing) {
        if (j == i) continue;
        end += admittance(i, j) *
               contact_load(places[j].e_r, law(j).radius, of_[j].normal, of_[j].friction);
      }
      const Delassus g = delassus(admittance(i, i), places[i].e_r, law(i).radius);
      const double was = of_[i].normal, rubbed = of_[i].friction;
      press_one(i, end);
      moved = std::max({moved, std::abs(of_[i].normal - was), std::abs(of_[i].friction - rubbed)});
      largest = std::max(largest, of_[i].normal);
      // The leapfrog is stable up to h^2 k' g_NN = 4, with k' = n N / p. If the law states its
      // damping a, (h^2 k' + 2 h a N) g_NN counts instead, because the mean of the rates at both
      // ends oscillates beyond it.
      const double depth = places[i].d.norm() - law(i).clearance;
      const double spring = law(i).compliance.spring(depth);
      const double slope = law(i).compliance.exponent * spring;
      const double damper = law(i).compliance.hunt_crossley * spring;
      if (depth > 0.0 && h_ * (h_ * slope + 2.0 * depth * damper) * g.nn > 4.0 * depth) {
        x.fail(Status::kStepTooLarge);
        return false;
      }
    }
    if (pressing.size() < 2 || moved <= 1e-15 * largest) break;
  }
  return true;
}

std::size_t CompliantContacts::touching() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      std::span(of_).first(count()), [](const Contact& c) { return c.touches; }));
}

// Whether and how fast a contact touches is found on the path under the forces of those that
// already press: without them the speed, and the a of the whole touch with it, is off by a term of
// the order of h. False as press().
bool CompliantContacts::meet_walls(StepState& x, LoadKick& loads) {
  std::array<bool, kMaxContacts> pressed{};
  for (std::size_t i = 0; i < count(); ++i) {
    const double delta = places[i].d.norm();
    if (delta > kNoNormal) places[i].e_r = places[i].d / delta;
    pressed[i] = of_[i].touches;
    if (pressed[i]) meet_wall(i, places[i].free);
  }
  const bool beside = touching() > 0 && touching() < count();
  if (beside) {
    if (loads.coupled()) respond(loads);
    if (!press(x)) return false;
  }
  for (std::size_t i = 0; i < count(); ++i) {
    if (of_[i].touches) continue;
    Eigen::Vector3d free = places[i].free;
    for (std::size_t j = 0; j < count() && beside; ++j) {
      if (!(of_[j].normal > 0.0)) continue;
      free += admittance(i, j) *
              contact_load(places[j].e_r, law(j).radius, of_[j].normal, of_[j].friction);
    }
    of_[i].touches = pressed[i];  // one that has left may be pressed back in
    meet_wall(i, free);
  }
  return true;
}

bool CompliantContacts::go_on(StepState& x, LoadKick& loads, bool /*unsettled*/) {
  look(x);
  after_ = 0.5 * h_;
  before_ = x.kick < 1.0 ? 0.0 : after_;
  if (!meet_walls(x, loads)) return false;
  if (touching() > 0) {
    if (loads.coupled()) respond(loads);
    if (loads.iterates()) loads.begin_iteration();
    for (bool settled = false;;) {
      if (!press(x)) return false;
      x.after = x.free;
      for (std::size_t i = 0; i < count(); ++i) {
        if (of_[i].touches) push(i, of_[i].normal, of_[i].friction, x.after);
      }
      if (!loads.iterates() || settled) break;
      settled = !loads.improve(x, x.after.data());
      for (std::size_t i = 0; i < count(); ++i) places[i].free = rates(i, x.free.data());
    }
  }
  for (std::size_t i = 0; i < count(); ++i) {
    const Contact& c = of_[i];
    const bool pressed = c.touches && c.normal > 0.0;
    const double sign_before = std::exchange(last_sign_[i], pressed ? c.slip_sign : 0.0);
    done[i] = {};
    if (!pressed) continue;
    done[i].mode = c.slip_sign == 0.0 ? Mode::kStick : Mode::kSlide;
    done[i].reversed = sign_before * c.slip_sign < 0.0;
    done[i].normal_impulse = c.normal;
    done[i].friction_impulse = c.friction;
    done[i].lasting = {c.normal, c.friction};
  }
  return false;
}

// With the forces of the last step.
void CompliantContacts::hold_on(StepState& x, LoadKick& loads) {
  if (loads.coupled()) respond(loads);
  for (std::size_t i = 0; i < count(); ++i) {
    const Eigen::Vector2d d = separation(m_, x.seen.data(), i);
    if (!(done[i].normal_impulse > 0.0) || !(d.norm() > law(i).clearance)) continue;
    places[i].e_r = d.normalized();
    push(i, done[i].normal_impulse, done[i].friction_impulse, x.free);
  }
}

void CompliantContacts::tell(FixedStep& out, double /*sign_before*/) const {
  static_cast<ContactStep&>(out) = done[0];
  out.others = std::span(done).subspan(1);
  out.impacts = {};
}

}  // namespace rotorub
