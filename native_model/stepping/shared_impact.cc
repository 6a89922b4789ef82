#include "native_model/stepping/shared_impact.h"

#include <algorithm>

#include "native_model/contact/impact.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

constexpr double kStands = 1e-12;  // relative to the approach; slower contacts are at rest

Eigen::Index row(std::size_t i) { return static_cast<Eigen::Index>(2 * i); }

}  // namespace

// The closing acceleration still contains the force of a lasting contact; solve() removes it.
void SharedImpact::add(std::size_t contact, bool closed, const Eigen::Vector2d& e_r,
                       const double* velocity, const double* acceleration) {
  const ContactParameters& law = contacts_->parameters(contact);
  const Eigen::Vector3d v = contacts_->rates(contact, velocity);
  const Eigen::Vector3d a = contact_acceleration(contacts_->model(), acceleration, contact);
  const Eigen::Vector2d now = rates_along(e_r, law.radius, v);
  before_.segment<2>(row(members_.size())) << (closed ? 0.0 : now.x()), now.y();
  approach_ = std::max(approach_, closed ? 0.0 : -now.x());
  members_.push_back({contact, e_r, closed, law.impact_law(),
                      closing_acceleration(e_r, v, a, law.clearance), false});
}

bool SharedImpact::rebounds(const Member& member, double h, double approach) const {
  const ContactParameters& law = contacts_->parameters(member.contact);
  return flight_outlives(std::max(h, law.impact_time()), law.restitution * approach,
                         member.closing_acceleration);
}

CoupledSolution SharedImpact::solve_with_laws(const ContactMatrix& g,
                                              const ContactVector& before) const {
  ContactList<ImpactLaw> laws;
  for (const Member& member : members_) laws.push_back(member.law);
  return solve_coupled_impact(g, before, {laws.data(), laws.size()});
}

Status SharedImpact::solve(const StepState& state, double t, double mass_time, const double* q,
                           bool is_last, double* impulses) {
  const std::size_t n = members_.size();
  ContactList<ClosedContact> closed;
  for (const Member& member : members_) {
    closed.push_back({member.contact, {}});
    closed[closed.size() - 1].point.e_r = member.e_r;
  }
  const ContactMatrix g = delassus(state.model, mass_time, q, closed);
  const ContactVector before = before_.head(row(n));
  const auto remove_restitution = [](Member& member) {
    member.law.restitution = member.law.tangential_restitution = 0.0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    Member& member = members_[i];
    const StepContacts::State& c = contacts_->states[member.contact];
    if (c.closed && member.lasted) {
      member.closing_acceleration +=
          (g(row(i), row(i)) * c.normal + g(row(i), row(i) + 1) * c.friction) /
          (state.kick_length * state.h);
    }
    if (!(before[row(i)] < 0.0)) continue;
    if (is_last || !rebounds(member, state.h, -before[row(i)])) remove_restitution(member);
  }
  CoupledSolution s = solve_with_laws(g, before);
  // A closed contact that would open too slowly for a flight stays closed.
  const auto stays = [&](std::size_t i) {
    return members_[i].lasted &&
           !flight_outlives(state.h, s.y[row(i)], members_[i].closing_acceleration);
  };
  bool again = false;
  for (std::size_t i = 0; i < n && s.is_unique(); ++i) {
    if (!(s.y[row(i)] > 0.0) || !stays(i)) continue;
    remove_restitution(members_[i]);
    again = true;
  }
  if (again) s = solve_with_laws(g, before);
  if (!s.is_unique()) return status_of(s.solutions);
  std::fill_n(impulses, state.nq(), 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    Member& member = members_[i];
    const Eigen::Vector2d p = s.p.segment<2>(row(i)), to = s.y.segment<2>(row(i));
    member.stays_closed = to.x() <= kStands * approach_ || stays(i);
    const double radius = contacts_->parameters(member.contact).radius;
    add_contact_load(state.model, contact_load(member.e_r, radius, p.x(), p.y()), impulses,
                     member.contact);
    if (!(p.x() > 0.0)) continue;
    // After an impact without restitution the gap closes by round-off, which is not a second
    // impact.
    contacts_->add_impact(impact_of(t, p, before.segment<2>(row(i)), to, member.contact),
                          approach_ > kNoGapRate);
  }
  return Status::kOk;
}

}  // namespace rotorub
