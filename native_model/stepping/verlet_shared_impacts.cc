// The impacts of `verlet` with several contacts: located in the step, each with all that is closed
// there. A resting contact that one knocks open carries nothing from there on: the next step gives
// back (1/2 - theta) of its step impulse.
#include <algorithm>
#include <array>

#include "native_model/contact/kinematics.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/shared_impact.h"
#include "native_model/stepping/verlet_impacts.h"
#include "native_model/stepping/verlet_step.h"

namespace rotorub {
namespace {

constexpr double kOnCircle = 1e-12;  // of the clearance: as good as on it

// The flight through a step, from impact to impact.
struct Flight {
  double theta = 0.0;                             // share of the step that is over
  std::array<Eigen::Vector2d, kMaxContacts> d{};  // m, of each contact there
  std::array<bool, kMaxContacts> closed{};
  double v[kMaxCoordinates], a[kMaxCoordinates];  // of the step's middle, and accelerations
};

// The contact whose path leaves its circle first, with the flight at that instant; the number of
// contacts: none does. One that never comes inside is closed: it has no flight.
std::size_t next_touch(const SeveralContacts& contacts, double h, Flight& flight) {
  const std::size_t n = contacts.count();
  double share = 2.0;
  std::size_t first = n;
  std::array<Eigen::Vector2d, kMaxContacts> path;
  for (std::size_t i = 0; i < n; ++i) {
    const double clearance = contacts.law(i).clearance;
    path[i] = (1.0 - flight.theta) * h * contacts.rates(i, flight.v).head<2>();
    if (flight.closed[i] || (flight.d[i] + path[i]).norm() <= clearance) continue;
    const double exit = circle_exit(flight.d[i], path[i], clearance);
    if (exit > 1.0) {
      flight.closed[i] = flight.d[i].norm() >= clearance;
    } else if (exit < share) {
      share = exit;
      first = i;
    }
  }
  if (first == n) return n;
  for (std::size_t i = 0; i < n; ++i) flight.d[i] += share * path[i];
  flight.theta += share * (1.0 - flight.theta);
  return first;
}

}  // namespace

template <>
void VerletStep<Model, SeveralContacts>::collide(const bool&, std::int64_t k) {
  const Model& m = x.m;
  const std::size_t n = contact.count();
  const int nq = x.nq();
  bool hit = false;
  for (std::size_t i = 0; i < n; ++i) {
    contact.places[i].free = contact.rates(i, x.after.data());
    hit = hit || (!contact.now.of[i].lasts && contact.leaves(i, contact.places[i].free));
  }
  if (!hit) return;
  contact.keep_end(x);
  const double t = x.time_of(k), h = x.h;
  Flight flight;
  for (int i = 0; i < nq; ++i) {
    flight.v[i] = x.after[at(i)];
    flight.a[i] = (x.after[at(i)] - x.start[at(i)]) / (x.kick * h);
  }
  for (std::size_t i = 0; i < n; ++i) {
    flight.d[i] = contact.places[i].d;
    flight.closed[i] = contact.now.of[i].lasts;
  }
  std::array<Eigen::Vector2d, kMaxContacts> commands;
  for (std::size_t i = 0; i < n; ++i) commands[i] = {loads.command[i].x, loads.command[i].y};
  double now_v[kMaxCoordinates], now_q[kMaxCoordinates];
  double jump[kMaxCoordinates], missed[kMaxCoordinates];

  const int most = StepImpacts::kMost * static_cast<int>(n);
  for (int count = 0; count < most; ++count) {
    const std::size_t first_touch = next_touch(contact, h, flight);
    if (first_touch == n) break;
    // All that is closed there, with the velocities of that instant.
    const double theta = flight.theta;
    for (int i = 0; i < nq; ++i) {
      now_v[i] = flight.v[i] + (theta - 0.5) * h * flight.a[i];
      now_q[i] = x.seen[at(i)] + theta * h * flight.v[i];
    }
    SharedImpact impact(contact);
    for (std::size_t i = 0; i < n; ++i) {
      const double on_circle = (1.0 - kOnCircle) * contact.law(i).clearance;
      if (!flight.closed[i] && i != first_touch && flight.d[i].norm() < on_circle) continue;
      impact.join(i, flight.closed[i], flight.d[i].normalized(), now_v, flight.a);
    }
    if (impact.approach() == 0.0) {  // a touch
      flight.closed[first_touch] = true;
      continue;
    }
    const Status found = impact.strike(x, t + theta * h, t, now_q, count + 1 == most, jump);
    if (found != Status::kOk) return x.fail(0, found);
    for (std::size_t i = 0; i < impact.count(); ++i) {
      const std::size_t index = impact.contact(i);
      SeveralContacts::Lasting::Of& c = contact.now.of[index];
      if (flight.closed[index] && c.lasts && !impact.rests(i)) {
        // Knocked open: it carries nothing from here on, and the kick was for a whole step.
        std::fill_n(missed, nq, 0.0);
        contact.push(index, c.normal, c.friction, std::span(missed).first(x.after.size()));
        for (int j = 0; j < nq; ++j) {
          late[at(j)] += (theta - 0.5) * missed[j];
          flight.a[j] -= missed[j] / (x.kick * h);
        }
        c.lasts = false;
      }
      flight.closed[index] = impact.rests(i);
    }
    const ImpactInstant instant{
        t, h, theta, now_q, flight.v, flight.a, std::span(commands).first(n)};
    late_work += jump_velocities(m, instant, jump, missed);
    for (int i = 0; i < nq; ++i) {
      flight.v[i] += jump[i];
      x.after[at(i)] += (1.0 - theta) * jump[i];
      late[at(i)] += theta * jump[i] + missed[i];
    }
    owes = 1.0;
  }
  for (std::size_t i = 0; i < n; ++i) contact.set_lasting(i, flight.closed[i]);
}

}  // namespace rotorub
