#include "native_model/stepping/shared_impact.h"

#include <algorithm>

#include "native_model/contact/impact.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

constexpr double kStands = 1e-12;  // relative to the approach; slower contacts are at rest
// m/s; after an impact without restitution the gap closes by round-off, which is not a second
// impact.
constexpr double kLeastRate = 1e-9;

Eigen::Index row(std::size_t i) { return static_cast<Eigen::Index>(2 * i); }

}  // namespace

// closing_acceleration_ still contains the force of a lasting contact; strike() removes it.
void SharedImpact::join(std::size_t contact, bool closed, const Eigen::Vector2d& e_r,
                        const double* velocity, const double* acceleration) {
  const ContactParameters& law = contacts_->law(contact);
  const std::size_t i = count_++;
  of_[i].index = contact;
  of_[i].point.e_r = e_r;
  closed_[i] = closed;
  const Eigen::Vector3d v = contacts_->rates(contact, velocity);
  const Eigen::Vector3d a = contact_acceleration(contacts_->model(), acceleration, contact);
  const Eigen::Vector2d now = rates_along(e_r, law.radius, v);
  before_.segment<2>(row(i)) << (closed ? 0.0 : now.x()), now.y();
  approach_ = std::max(approach_, closed ? 0.0 : -now.x());
  closing_acceleration_[i] = closing_acceleration(e_r, v, a, law.clearance);
  laws_[i] = law.law();
}

bool SharedImpact::rebounds(std::size_t i, double h, double approach) const {
  const ContactParameters& law = contacts_->law(of_[i].index);
  return flight_outlives(std::max(h, law.impact_time()), law.restitution * approach,
                         closing_acceleration_[i]);
}

Status SharedImpact::strike(const StepState& x, double t, double at, const double* q, bool ends,
                            double* load) {
  const std::size_t n = count_;
  g_ = delassus(x.m, at, q, std::span(of_).first(n));
  const ContactVector before = before_.head(row(n));
  const auto settle = [&](std::size_t i) {
    laws_[i].restitution = laws_[i].tangential_restitution = 0.0;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const StepContacts::Kept& c = contacts_->now[of_[i].index];
    if (c.closed && closed_[i]) {
      closing_acceleration_[i] +=
          (g_(row(i), row(i)) * c.normal + g_(row(i), row(i) + 1) * c.friction) / (x.kick * x.h);
    }
    if (!(before[row(i)] < 0.0)) continue;
    if (ends || !rebounds(i, x.h, -before[row(i)])) settle(i);
  }
  const auto solved = [&] { return solve_coupled_impact(g_, before, std::span(laws_).first(n)); };
  CoupledSolution s = solved();
  // A closed contact that would open too slowly for a flight stays closed.
  const auto stays = [&](std::size_t i) {
    return closed_[i] && !flight_outlives(x.h, s.y[row(i)], closing_acceleration_[i]);
  };
  bool again = false;
  for (std::size_t i = 0; i < n && s.solutions == 1; ++i) {
    if (!(s.y[row(i)] > 0.0) || !stays(i)) continue;
    settle(i);
    again = true;
  }
  if (again) s = solved();
  if (s.solutions != 1) return status_of(s.solutions);
  std::fill_n(load, x.nq(), 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t contact = of_[i].index;
    const Eigen::Vector2d p = s.p.segment<2>(row(i)), to = s.y.segment<2>(row(i));
    rests_[i] = to.x() <= kStands * approach_ || stays(i);
    const double radius = contacts_->law(contact).radius;
    add_contact_load(x.m, contact_load(of_[i].point.e_r, radius, p.x(), p.y()), load, contact);
    if (!(p.x() > 0.0)) continue;
    contacts_->note_impact(impact_of(t, p, before.segment<2>(row(i)), to, contact),
                           approach_ > kLeastRate);
  }
  return Status::kOk;
}

}  // namespace rotorub
