#include "native_model/stepping/euler.h"

#include <utility>

#include "native_model/contact/impact.h"
#include "native_model/model/actuation.h"
#include "native_model/model/constraint.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/sampled_feedback.h"

namespace rotorub {
namespace {

// (ddot, spin) of velocities; for accelerations only the first two are meaningful.
Eigen::Vector3d rates(const Model& m, const Eigen::VectorXd& v, std::size_t contact) {
  return contact_rates(m, v.data(), contact);
}

}  // namespace

EulerStepper::EulerStepper(const Model& model, double step)
    : model_(&model),
      h_(step),
      state_(initial_state(model)),
      free_(model.nq()),
      f_(model.nq()),
      done_(model.auxiliary.size()) {
  hits_.reserve(done_.size());
}

FixedStep EulerStepper::step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) {
  const Model& m = *model_;
  const double t = static_cast<double>(k) * h_;
  const State start = state_;
  take_samples(m, t, h_, q(), state_.v.data());
  smooth_force(m, t, q(), v(), u, f_.data());
  step_bristles(m, v(), v(), h_, f_.data());
  solve_mass(m, t, q(), f_.data(), f_.data());
  free_ = state_.v + h_ * f_;
  state_.v = free_;
  hits_.clear();
  std::fill(done_.begin(), done_.end(), ContactStep{});
  const Status found = m.has_contact() ? touch(t, start.v) : Status::kOk;
  FixedStep out;
  out.contacts = done_;
  out.impacts = hits_;
  out.status = found == Status::kOk && !state_.v.allFinite() ? Status::kDiverged : found;
  if (out.status != Status::kOk) {
    state_ = start;
    return out;
  }
  if (works) {
    std::array<Eigen::Vector2d, kMaxContacts> rings;
    for (std::size_t i = 0; i < u.size(); ++i) {
      rings[i] = actuator_state(m, start.q.data(), start.v.data(), u[i], i).force;
    }
    const auto power = [&](const State& s, double at) {
      return external_power(m, at, s.q.data(), s.v.data(), std::span(rings).first(u.size()));
    };
    State end = state_;
    end.q += h_ * end.v;
    out.external_work = 0.5 * h_ * (power(start, t) + power(end, t + h_));
    out.impact_work = impact_work(m, hits_);
    out.contact_work = out.impact_work;
    for (std::size_t i = 0; i < done_.size(); ++i) {
      out.contact_work += lasting_work(m, i, separation(m, q(), i).normalized(), done_[i].lasting,
                                       0.5 * (rates(m, start.v, i) + rates(m, state_.v, i)));
    }
  }
  state_.q += h_ * state_.v;
  state_.t = t + h_;
  return out;
}

Status EulerStepper::solve_one(double t, Closing& c) const {
  const Model& m = *model_;
  const ContactParameters& law = *m.auxiliary[c.index].contact;
  const Delassus g = delassus(contact_admittance(m, t, q(), c.index), c.e_r, law.radius);
  if (c.impact) {
    const ImpactResult r = solve_impact(g, c.gap_rate, c.slip, law.impact_law());
    c.normal = r.normal();
    c.friction = r.friction();
    return r.status;
  }
  const CoulombSolution s = solve_coulomb(g, c.end, c.slip, law.friction, c.before);
  c.normal = s.normal;
  c.friction = s.friction;
  c.sticks = mode_of(s) == ContactMode::kStick;
  return status_of(s.solutions);
}

// Solves several contacts at once. Contacts that rebound count with their gap rates; the others
// with the gap at the end of the step, (12), and without restitution.
Status EulerStepper::solve_all(double t, std::span<Closing> closing) const {
  const Model& m = *model_;
  const std::size_t n = closing.size();
  std::array<ClosedContact, kMaxContacts> group{};
  std::array<ImpactLaw, kMaxContacts> laws{};
  ContactVector b(static_cast<Eigen::Index>(2 * n));
  for (std::size_t i = 0; i < n; ++i) {
    const Closing& c = closing[i];
    group[i].index = c.index;
    group[i].point.e_r = c.e_r;
    laws[i] = m.auxiliary[c.index].contact->impact_law();
    if (!c.impact) laws[i].restitution = laws[i].tangential_restitution = 0.0;
    b.segment<2>(static_cast<Eigen::Index>(2 * i)) << (c.impact ? c.gap_rate : c.end), c.slip;
  }
  const CoupledSolution s = solve_coupled_impact(delassus(m, t, q(), std::span(group).first(n)), b,
                                                 std::span(laws).first(n));
  for (std::size_t i = 0; i < n && s.is_unique(); ++i) {
    closing[i].normal = s.p[static_cast<Eigen::Index>(2 * i)];
    closing[i].friction = s.p[static_cast<Eigen::Index>(2 * i + 1)];
    closing[i].sticks = s.sticks[i];
  }
  return status_of(s.solutions);
}

// Applies the contacts of the step: changes state_.v from free_. start: velocities before the step.
Status EulerStepper::touch(double t, const Eigen::VectorXd& start) {
  const Model& m = *model_;
  std::array<Closing, kMaxContacts> closing{};
  std::size_t n = 0;
  const std::array<bool, kMaxContacts> lasted = std::exchange(in_contact_, {});
  for (std::size_t i = 0; i < done_.size(); ++i) {
    const ContactParameters& law = *m.auxiliary[i].contact;
    const Eigen::Vector2d d = separation(m, q(), i);
    const double delta = d.norm();
    if (delta <= kNoNormal) continue;
    Closing c;
    c.index = i;
    c.e_r = d / delta;
    const Eigen::Vector3d free = rates(m, free_, i), acceleration = rates(m, f_, i);
    const double closes = c.e_r.dot(free.head<2>());
    // (12): gap at the end of the step, linearised about q.
    const double gap = law.clearance - delta - h_ * closes;
    // A lasting contact may be closed by the force of another one, so all are solved together.
    if (gap >= 0.0 && !(lasted[i] && done_.size() > 1)) continue;
    c.gap_rate = -closes;
    c.slip = rates_along(c.e_r, law.radius, free).y();
    c.before = rates_along(c.e_r, law.radius, rates(m, start, i)).y();
    c.end = gap / h_;
    const double a = closing_acceleration(c.e_r, free, acceleration, law.clearance);
    c.impact = !lasted[i] && rebound_outlives_steps(h_, law.restitution, closes, a);
    closing[n++] = c;
  }
  if (n == 0 || (n == 1 && closing[0].end >= 0.0)) return Status::kOk;
  const Status found =
      n == 1 ? solve_one(t, closing[0]) : solve_all(t, std::span(closing).first(n));
  if (found != Status::kOk) return found;
  f_.setZero();
  for (const Closing& c : std::span(closing).first(n)) {
    const double radius = m.auxiliary[c.index].contact->radius;
    add_contact_load(m, contact_load(c.e_r, radius, c.normal, c.friction), f_.data(), c.index);
  }
  solve_mass(m, t, q(), f_.data(), f_.data());
  state_.v += f_;
  for (const Closing& c : std::span(closing).first(n)) {
    ContactStep& did = done_[c.index];
    did.normal_impulse = c.normal;
    did.friction_impulse = c.friction;
    if (!(c.normal > 0.0)) continue;
    in_contact_[c.index] = !c.impact;
    if (!c.impact && lasted[c.index]) {
      did.lasting = {c.normal, c.friction};
      did.mode = mode_of(c.normal, c.sticks);
      continue;
    }
    // If a contact closes without a rebound, its impact is part of the step's impulse.
    const double radius = m.auxiliary[c.index].contact->radius;
    const Eigen::Vector2d before = rates_along(c.e_r, radius, rates(m, free_, c.index));
    const Eigen::Vector2d after = rates_along(c.e_r, radius, rates(m, state_.v, c.index));
    hits_.push_back(impact_of(t + h_, {c.normal, c.friction}, before, after, c.index));
  }
  return Status::kOk;
}

}  // namespace rotorub
