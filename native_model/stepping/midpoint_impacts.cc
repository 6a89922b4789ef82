// Impacts of `midpoint`. Where one is not followed by a flight the middle closes the gap too, by
// the least change in the norm of M.
#include <algorithm>
#include <array>

#include "native_model/contact/impact.h"
#include "native_model/contact/kinematics.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/midpoint_step.h"
#include "native_model/stepping/shared_impact.h"

namespace rotorub {
namespace {

template <class M>
void collide_lane(MidpointStep<M>& s, int lane, std::int64_t k) {
  StepState<M>& x = s.x;
  const Model& m = lane_model(x.m, lane);
  const ContactParameters& c = *m.first().contact;
  double q[kMaxCoordinates], change[kMaxCoordinates];
  read_lane(x, x.seen, lane, q);
  const Eigen::Vector2d d = separation(m, q);
  const Eigen::Vector3d free = rates_of_lane(x, x.free, lane);
  const Eigen::Vector3d start = rates_of_lane(x, x.start, lane);
  const Eigen::Vector2d path = x.h * free.head<2>();
  const Eigen::Vector2d e_r = normal_of_path(d, path, c.clearance);
  const Eigen::Vector3d acceleration = (free - start) / x.h;
  const double pressed = pressing(e_r, free, acceleration, c.clearance);
  const double closing = e_r.dot(free.head<2>());
  const bool stays = !rebound_outlives_steps(x.h, c.restitution, closing, pressed);
  if (!(closing > 0.0)) return;
  const double t = s.time_within(k, 0.5);
  const Delassus g = delassus(contact_admittance(m, t, q), e_r, c.radius);
  if (stays) {
    std::fill_n(change, m.nq(), 0.0);
    add_contact_load(m, contact_load(e_r, 0.0, -(c.clearance - e_r.dot(d)) / g.nn, 0.0), change);
    solve_mass(m, t, q, change, change);
    for (int i = 0; i < m.nq(); ++i) {
      lanes::set(x.seen[static_cast<std::size_t>(i)], lane, q[i] + change[i]);
    }
    s.contact.set_lasting(lane, true);
  }
  const double slip = rates_along(e_r, c.radius, free).y();
  ImpactLaw law = c.law();
  if (stays) law.restitution = law.tangential_restitution = 0.0;
  const ImpactResult r = solve_impact(g, -closing, slip, law);
  if (r.status != Status::kOk) return x.fail(lane, r.status);
  std::fill_n(change, m.nq(), 0.0);
  add_contact_load(m, contact_load(e_r, c.radius, r.normal(), r.friction()), change);
  solve_mass(m, t, q, change, change);
  for (int i = 0; i < m.nq(); ++i) {
    add_to_lane(x.after[static_cast<std::size_t>(i)], lane, change[i]);
  }
  const double share = std::min(0.5, circle_exit(d, path, c.clearance));
  s.contact.note_impact(lane, impact_of(s.time_within(k, 0.5 + share), {r.normal(), r.friction()},
                                        {-closing, slip}, {r.gap_rate, r.slip}));
}

// The middle on the circles of those that last from here on, by the least change that leaves the
// gaps of the others that last.
void close_gaps(StepState<Model>& x, const SeveralContacts& contacts, const SharedImpact& impact,
                double t) {
  std::array<std::size_t, kMaxContacts> member{};
  Eigen::Index n = 0;
  for (std::size_t i = 0; i < impact.count(); ++i) {
    if (impact.rests(i)) member[static_cast<std::size_t>(n++)] = i;
  }
  if (n == 0) return;
  const auto at = [&](Eigen::Index i) { return member[static_cast<std::size_t>(i)]; };
  const auto row = [&](Eigen::Index i) { return static_cast<Eigen::Index>(2 * at(i)); };
  ContactMatrix g(n, n);
  ContactVector opens(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t contact = impact.contact(at(i));
    const SeveralContacts::Place& c = contacts.places[contact];
    opens[i] = impact.was_closed(at(i)) ? 0.0 : c.e_r.dot(c.d) - contacts.law(contact).clearance;
    for (Eigen::Index j = 0; j < n; ++j) g(i, j) = impact.matrix()(row(i), row(j));
  }
  const ContactVector normals = shared_solution(g, opens);
  double change[kMaxCoordinates];
  std::fill_n(change, x.nq(), 0.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t contact = impact.contact(at(i));
    const Eigen::Vector2d& e_r = contacts.places[contact].e_r;
    add_contact_load(x.m, contact_load(e_r, 0.0, normals[i], 0.0), change, contact);
  }
  solve_mass(x.m, t, x.seen.data(), change, change);
  for (std::size_t i = 0; i < x.seen.size(); ++i) x.seen[i] += change[i];
}

}  // namespace

template <class M, class Contacts>
void MidpointStep<M, Contacts>::collide(const Mask& hits, std::int64_t k) {
  for (int lane = 0; lane < kLanes; ++lane) {
    if (lanes::get(hits, lane)) collide_lane(*this, lane, k);
  }
}

template <>
void MidpointStep<Model, SeveralContacts>::collide(const bool&, std::int64_t k) {
  const double t = time_within(k, 0.5);
  contact.keep_end(x);
  const std::size_t nq = x.after.size();
  double acceleration[kMaxCoordinates], load[kMaxCoordinates];
  for (std::size_t i = 0; i < nq; ++i) acceleration[i] = (x.after[i] - x.start[i]) / x.h;
  SharedImpact impact(contact);
  double share = 0.5;  // of the step, from its middle to the first touch
  for (std::size_t i = 0; i < contact.count(); ++i) {
    SeveralContacts::Place& c = contact.places[i];
    const bool lasts = contact.now.of[i].lasts;
    const Eigen::Vector3d rates = contact.rates(i, x.after.data());
    const Eigen::Vector2d path = x.h * rates.head<2>();
    if (!lasts) {
      const double clearance = contact.law(i).clearance;
      if (!contact.leaves(i, rates)) continue;
      c.e_r = normal_of_path(c.d, path, clearance);
      if (!(c.e_r.dot(path) > 0.0)) continue;
      share = std::min(share, circle_exit(c.d, path, clearance));
    }
    impact.join(i, lasts, c.e_r, x.after.data(), acceleration);
  }
  if (!(impact.approach() > 0.0)) return;
  const Status found = impact.strike(x, time_within(k, 0.5 + share), t, x.seen.data(), false, load);
  if (found != Status::kOk) return x.fail(0, found);
  solve_mass(x.m, t, x.seen.data(), load, load);
  for (std::size_t i = 0; i < nq; ++i) x.after[i] += load[i];
  close_gaps(x, contact, impact, t);
  for (std::size_t i = 0; i < impact.count(); ++i) {
    contact.set_lasting(impact.contact(i), impact.rests(i));
  }
}

#define ROTORUB_DEFINE(...) \
  template void MidpointStep<__VA_ARGS__>::collide(const Mask&, std::int64_t);
ROTORUB_DEFINE(Model)
#undef ROTORUB_DEFINE

}  // namespace rotorub
