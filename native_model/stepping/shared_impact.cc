#include "native_model/stepping/shared_impact.h"

#include <algorithm>

#include "native_model/contact/impact.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

constexpr double kStands = 1e-12;  // relative to the approach; slower contacts are at rest

Eigen::Index row(std::size_t i) { return static_cast<Eigen::Index>(2 * i); }

}  // namespace

// closing_acceleration_ still contains the force of a lasting contact; solve() removes it.
void SharedImpact::add(std::size_t contact, bool closed, const Eigen::Vector2d& e_r,
                       const double* velocity, const double* acceleration) {
  const ContactParameters& law = contacts_->parameters(contact);
  const std::size_t i = count_++;
  members_[i].index = contact;
  members_[i].point.e_r = e_r;
  lasted_[i] = closed;
  const Eigen::Vector3d v = contacts_->rates(contact, velocity);
  const Eigen::Vector3d a = contact_acceleration(contacts_->model(), acceleration, contact);
  const Eigen::Vector2d now = rates_along(e_r, law.radius, v);
  before_.segment<2>(row(i)) << (closed ? 0.0 : now.x()), now.y();
  approach_ = std::max(approach_, closed ? 0.0 : -now.x());
  closing_acceleration_[i] = closing_acceleration(e_r, v, a, law.clearance);
  laws_[i] = law.impact_law();
}

bool SharedImpact::rebounds(std::size_t i, double h, double approach) const {
  const ContactParameters& law = contacts_->parameters(members_[i].index);
  return flight_outlives(std::max(h, law.impact_time()), law.restitution * approach,
                         closing_acceleration_[i]);
}

Status SharedImpact::solve(const StepState& state, double t, double mass_time, const double* q,
                           bool is_last, double* impulses) {
  const std::size_t n = count_;
  delassus_ = delassus(state.model, mass_time, q, std::span(members_).first(n));
  const ContactVector before = before_.head(row(n));
  const auto remove_restitution = [&](std::size_t i) {
    laws_[i].restitution = laws_[i].tangential_restitution = 0.0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const StepContacts::ContactState& c = contacts_->states[members_[i].index];
    if (c.closed && lasted_[i]) {
      closing_acceleration_[i] +=
          (delassus_(row(i), row(i)) * c.normal + delassus_(row(i), row(i) + 1) * c.friction) /
          (state.kick_length * state.h);
    }
    if (!(before[row(i)] < 0.0)) continue;
    if (is_last || !rebounds(i, state.h, -before[row(i)])) remove_restitution(i);
  }
  const auto solved = [&] {
    return solve_coupled_impact(delassus_, before, std::span(laws_).first(n));
  };
  CoupledSolution s = solved();
  // A closed contact that would open too slowly for a flight stays closed.
  const auto stays = [&](std::size_t i) {
    return lasted_[i] && !flight_outlives(state.h, s.y[row(i)], closing_acceleration_[i]);
  };
  bool again = false;
  for (std::size_t i = 0; i < n && s.is_unique(); ++i) {
    if (!(s.y[row(i)] > 0.0) || !stays(i)) continue;
    remove_restitution(i);
    again = true;
  }
  if (again) s = solved();
  if (!s.is_unique()) return status_of(s.solutions);
  std::fill_n(impulses, state.nq(), 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t contact = members_[i].index;
    const Eigen::Vector2d p = s.p.segment<2>(row(i)), to = s.y.segment<2>(row(i));
    stays_closed_[i] = to.x() <= kStands * approach_ || stays(i);
    const double radius = contacts_->parameters(contact).radius;
    add_contact_load(state.model, contact_load(members_[i].point.e_r, radius, p.x(), p.y()),
                     impulses, contact);
    if (!(p.x() > 0.0)) continue;
    // After an impact without restitution the gap closes by round-off, which is not a second
    // impact.
    contacts_->add_impact(impact_of(t, p, before.segment<2>(row(i)), to, contact),
                          approach_ > kNoGapRate);
  }
  return Status::kOk;
}

}  // namespace rotorub
