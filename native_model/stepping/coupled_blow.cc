// One impact of a step of several contacts, with all that is closed there.
#include <algorithm>

#include "native_model/contact/impact.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/coupled_step.h"

namespace rotorub {

// Without the force that a lasting contact has: strike() takes it off.
void CoupledStep::join(Blow& blow, std::size_t contact, bool closed, const Eigen::Vector2d& e_r,
                       const Columns& velocity, const Columns& acceleration) const {
  const Contact& c = contacts_[contact];
  const std::size_t i = blow.count++;
  blow.of[i].index = contact;
  blow.of[i].point.e_r = e_r;
  blow.closed[i] = closed;
  const Eigen::Vector3d v = rates(contact, velocity.data());
  const Eigen::Vector3d a = contact_acceleration(*m_, acceleration.data(), contact);
  const Eigen::Vector2d now = rates_along(e_r, c.law.radius, v);
  blow.before.segment<2>(static_cast<Eigen::Index>(2 * i)) << (closed ? 0.0 : now.x()), now.y();
  blow.approach = std::max(blow.approach, closed ? 0.0 : -now.x());
  blow.pressed[i] = pressing(e_r, v, a, c.law.clearance);
  blow.laws[i] = c.law.law();
}

bool CoupledStep::strike(Blow& blow, double t, double at, const double* q, bool ends,
                         Columns& load) {
  const std::size_t n = blow.count;
  const auto row = [](std::size_t i) { return static_cast<Eigen::Index>(2 * i); };
  blow.g = delassus(*m_, at, q, std::span(blow.of).first(n));
  const ContactVector before = blow.before.head(row(n));
  const auto settle = [&](std::size_t i) {
    blow.laws[i].restitution = blow.laws[i].tangential_restitution = 0.0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Contact& c = contacts_[blow.of[i].index];
    if (c.lasts && blow.closed[i]) {
      blow.pressed[i] +=
          (blow.g(row(i), row(i)) * c.normal + blow.g(row(i), row(i) + 1) * c.friction) /
          (kick_ * h_);
    }
    if (!(before[row(i)] < 0.0)) continue;
    if (ends || !rebounds(c, -before[row(i)], blow.pressed[i])) settle(i);
  }
  const auto solved = [&] {
    return solve_coupled_impact(blow.g, before, std::span(blow.laws).first(n));
  };
  const auto stays = [&](std::size_t i) {
    return blow.closed[i] && !flight_outlives(least_flight_, blow.s.y[row(i)], blow.pressed[i]);
  };
  blow.s = solved();
  // One that it knocks open too little for a flight stays.
  bool again = false;
  for (std::size_t i = 0; i < n && blow.s.solutions == 1; ++i) {
    if (!(blow.s.y[row(i)] > 0.0) || !stays(i)) continue;
    settle(i);
    again = true;
  }
  if (again) blow.s = solved();
  if (blow.s.solutions != 1) {
    fail(0, status_of(blow.s.solutions));
    return false;
  }
  std::fill(load.begin(), load.end(), 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t contact = blow.of[i].index;
    const double normal = blow.s.p[row(i)], friction = blow.s.p[row(i) + 1];
    const Eigen::Vector2d from = before.segment<2>(row(i)), to = blow.s.y.segment<2>(row(i));
    blow.rests[i] = to.x() <= kOnCircle * blow.approach || stays(i);
    add_contact_load(
        *m_, contact_load(blow.of[i].point.e_r, contacts_[contact].law.radius, normal, friction),
        load.data(), contact);
    if (!(normal > 0.0)) continue;
    done_[contact].normal_impulse += normal;
    done_[contact].friction_impulse += friction;
    hits_.push_back({t, normal, friction, from.x(), to.x(), from.y(), to.y(),
                     impulse_work(normal, friction, from, to).total(), static_cast<int>(contact)});
  }
  return true;
}

}  // namespace rotorub
