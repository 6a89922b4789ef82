#include "native_model/stepping/coupled_midpoint.h"

#include <algorithm>

#include "native_model/contact/impact.h"
#include "native_model/contact/kinematics.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {
namespace {

constexpr double kLeastFlight =
    2.0;  // steps, as of an impact that is not located (contact/impact.h)

}  // namespace

CoupledMidpoint::CoupledMidpoint(const Model& model, double step)
    : CoupledStep(model, step, kLeastFlight), acceleration_(after_), load_(after_) {}

bool CoupledMidpoint::rebounds(const Contact& c, double approach, double pressed) const {
  return rebound_outlives_steps(h_, c.law.restitution, approach, pressed);
}

FixedStep CoupledMidpoint::step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) {
  hits_.clear();
  for (std::size_t i = 0; i < q_.size(); ++i) {
    seen_[i] = q_[i] + 0.5 * h_ * v_[i];
    start_[i] = v_[i];
  }
  back_to_circles();
  const double t = origin + static_cast<double>(k) * h_, middle = t + 0.5 * h_;
  apply_commands(u, seen_.data());
  free_velocity(k, t, middle, seen_.data());
  place();
  last();
  std::copy(after_.begin(), after_.end(), free_end_.begin());
  if (status[0] == Status::kOk) collide(middle);
  const FixedStep out = result(1.0, after_, works);
  move(0.5 * h_);
  return out;
}

// Middles well outside their rings go back to the circles, by the least change in the norm of A
// (midpoint_step.h).
void CoupledMidpoint::back_to_circles() {
  std::array<std::size_t, kMaxContacts> outside{};
  Eigen::Index n = 0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    c.d = separation(*m_, seen_.data(), i);
    c.normal = c.friction = 0.0;
    const double circle = c.law.clearance * c.law.clearance;
    if (!(c.d.squaredNorm() > 1.02 * circle)) continue;
    c.e_r = c.d.normalized();
    outside[static_cast<std::size_t>(n++)] = i;
  }
  if (n == 0) return;
  if (coupled_) respond();
  const auto contact = [&](Eigen::Index i) { return outside[static_cast<std::size_t>(i)]; };
  ContactMatrix g(n, n);
  ContactVector depth(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Contact& c = contacts_[contact(i)];
    depth[i] = c.d.norm() - c.law.clearance;
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Matrix3d a = admittance(contact(i), contact(j));
      g(i, j) = c.e_r.dot(a.topLeftCorner<2, 2>() * contacts_[contact(j)].e_r);
    }
  }
  const ContactVector normals = shared_solution(g, depth);
  for (Eigen::Index i = 0; i < n; ++i) contacts_[contact(i)].normal = normals[i];
  push(seen_.data());
}

// Poisson's law where contacts close, with all that last. One without a flight after it lasts from
// here on.
void CoupledMidpoint::collide(double t) {
  for (std::size_t i = 0; i < after_.size(); ++i) acceleration_[i] = (after_[i] - start_[i]) / h_;
  Blow blow;
  double share = 0.5;  // of the step, from its middle to the first touch
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    c.free = rates(i, after_.data());
    const Eigen::Vector2d path = h_ * c.free.head<2>();
    if (!c.lasts) {
      if (!leaves(c, c.free)) continue;
      c.e_r = normal_of_path(c.d, path, c.law.clearance);
      if (!(c.e_r.dot(path) > 0.0)) continue;
      share = std::min(share, circle_exit(c.d, path, c.law.clearance));
    }
    join(blow, i, c.lasts, c.e_r, after_, acceleration_);
  }
  if (!(blow.approach > 0.0)) return;
  if (!strike(blow, t + share * h_, t, seen_.data(), false, load_)) return;
  solve_mass(*m_, t, seen_.data(), load_.data(), load_.data());
  for (std::size_t i = 0; i < after_.size(); ++i) after_[i] += load_[i];
  close_gaps(blow, t);
  for (std::size_t i = 0; i < blow.count; ++i) {
    Contact& c = contacts_[blow.of[i].index];
    if (c.lasts != blow.rests[i]) c.slip_sign = 0.0;
    c.lasts = blow.rests[i];
  }
}

// The middle on the circles of those that last from here on, by the least change in the norm of M
// that leaves the gaps of the others that last.
void CoupledMidpoint::close_gaps(const Blow& blow, double t) {
  std::array<Eigen::Index, kMaxContacts> member{};
  Eigen::Index n = 0;
  for (std::size_t i = 0; i < blow.count; ++i) {
    if (blow.rests[i]) member[static_cast<std::size_t>(n++)] = static_cast<Eigen::Index>(i);
  }
  if (n == 0) return;
  const auto at = [&](Eigen::Index i) { return member[static_cast<std::size_t>(i)]; };
  ContactMatrix g(n, n);
  ContactVector opens(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto of = static_cast<std::size_t>(at(i));
    const Contact& c = contacts_[blow.of[of].index];
    opens[i] = blow.closed[of] ? 0.0 : c.e_r.dot(c.d) - c.law.clearance;
    for (Eigen::Index j = 0; j < n; ++j) g(i, j) = blow.g(2 * at(i), 2 * at(j));
  }
  const ContactVector normals = shared_solution(g, opens);
  std::fill(load_.begin(), load_.end(), 0.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t contact = blow.of[static_cast<std::size_t>(at(i))].index;
    add_contact_load(*m_, contact_load(contacts_[contact].e_r, 0.0, normals[i], 0.0), load_.data(),
                     contact);
  }
  solve_mass(*m_, t, seen_.data(), load_.data(), load_.data());
  for (std::size_t i = 0; i < seen_.size(); ++i) seen_[i] += load_[i];
}

}  // namespace rotorub
