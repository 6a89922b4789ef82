#include "native_model/integrate/paper.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "native_model/contact/impact_map.h"
#include "native_model/system/dynamics.h"

namespace rotorub {
namespace {

// (ddot, Omega_c): relative velocity of the centres and spin at the contact.
Eigen::Vector3d contact_velocity(const Model& m, const double* v) {
  const Eigen::Vector2d dv = rotor_point(m, v) - stator_point(m, v);
  return {dv.x(), dv.y(), contact_spin(m, v)};
}

Mode mode_of(ContactCase contact_case) {
  switch (contact_case) {
    case ContactCase::kOpen: return Mode::kFree;
    case ContactCase::kStick: return Mode::kStick;
    case ContactCase::kSlidePositive:
    case ContactCase::kSlideNegative: return Mode::kSlide;
  }
  return Mode::kFree;
}

// Smallest s in [0, h] at which |d + s v| = radius, from inside or on the circle.
double crossing(const Eigen::Vector2d& d, const Eigen::Vector2d& v, double radius, double h) {
  const double a = v.squaredNorm(), b = d.dot(v), c = d.squaredNorm() - radius * radius;
  if (a == 0.0 || c >= 0.0) return 0.0;
  const double root = std::sqrt(b * b - a * c);
  // The positive root, without cancellation.
  const double s = b > 0.0 ? -c / (b + root) : (root - b) / a;
  return std::clamp(s, 0.0, h);
}

}  // namespace

PaperStepper::PaperStepper(const Model& model, double step)
    : model_(&model), step_(step), gyroscopic_(model) {
  assert(step > 0.0);
  const int n = model.nq();
  implicit_mass_ = model.mass + 0.5 * step * model.damping;
  q_ = v_ = f_ = Eigen::VectorXd::Zero(n);
  implicit_admittance_ = contact_admittance(model, implicit_mass_.data(), 0.0, model.q0.data());
}

std::string PaperStepper::refusal() const {
  double largest = 0.0;
  for (int i = 0; i < model_->nq(); ++i) {
    largest = std::max(largest, model_->stiffness[i] / model_->mass[i]);
  }
  const double limit = 2.0 / std::sqrt(largest);
  if (largest == 0.0 || step_ < limit) return {};
  return "step " + std::to_string(step_) + " s is not below 2 / omega_max = " +
         std::to_string(limit) + " s of the stiffest mode";
}

void PaperStepper::free_velocity(const State& state, const Eigen::Vector2d& u) {
  const Model& m = *model_;
  const Layout& l = m.layout;
  const double h = step_, t = state.t + 0.5 * h;
  v_ = state.v;
  const double omega = spin_speed(m, v_.data());
  if (!gyroscopic_.absent()) gyroscopic_.apply(omega, 0.5 * h, v_.data());
  load_force(m, t, q_.data(), v_.data(), f_.data());
  if (l.stator) f_.segment<2>(l.ring()) += u;
  for (int i = 0; i < l.nq(); ++i) f_[i] -= m.stiffness[i] * q_[i] + m.damping[i] * v_[i];
  if (l.spin) {
    // The drive's torque falls with the speed: implicit as damping is.
    const double slope = std::max(0.0, -m.drive->slope(v_[l.phi()]));
    implicit_mass_[l.phi()] = m.mass[l.phi()] + 0.5 * h * (m.damping[l.phi()] + slope);
  }
  solve_mass(m, implicit_mass_.data(), t, q_.data(), f_.data(), f_.data());
  for (int i = 0; i < l.nq(); ++i) v_[i] += h * f_[i];
  if (!gyroscopic_.absent()) gyroscopic_.apply(spin_speed(m, v_.data()), 0.5 * h, v_.data());
}

void PaperStepper::apply(const State& state, const double* diagonal, const Eigen::Vector2d& e_r,
                         double normal, double friction) {
  const Model& m = *model_;
  f_.setZero();
  add_contact_load(m, contact_load(e_r, m.contact->radius, normal, friction), f_.data());
  solve_mass(m, diagonal, state.t + 0.5 * step_, q_.data(), f_.data(), f_.data());
  v_ += f_;
}

PaperStep PaperStepper::impact(const State& state, const Eigen::Vector2d& e_r,
                               double closing_time) {
  const Model& m = *model_;
  const ContactParameters& c = *m.contact;
  const Eigen::Vector3d free = contact_velocity(m, v_.data());
  ImpactInput in;
  in.admittance = contact_admittance(m, state.t + 0.5 * step_, q_.data());
  in.e_r = e_r;
  in.radius = c.radius;
  in.delta = c.clearance;
  in.acceleration = (free - start_velocity_) / step_;
  in.compression_time = c.compression_time;
  in.expansion_time = c.expansion_time;
  // The loads of the whole step are in `free` already: what acts during the impact is taken back.
  in.velocity = free - in.acceleration * (c.compression_time + c.expansion_time);
  const ImpactResult r =
      solve_impact(in, {c.friction, c.restitution, c.tangential_restitution});

  PaperStep out;
  if (r.status == ImpactStatus::kNoSolution) out.status = Status::kNoSolution;
  if (r.status == ImpactStatus::kSeveralSolutions) out.status = Status::kAmbiguous;
  if (out.status != Status::kOk) return out;
  out.impact = true;
  out.normal_impulse = r.normal();
  out.friction_impulse = r.friction();
  apply(state, m.mass.data(), e_r, r.normal(), r.friction());
  const Eigen::Vector2d e_t{-e_r.y(), e_r.x()};
  const auto slip = [&](const Eigen::Vector3d& w) { return e_t.dot(w.head<2>()) + c.radius * w.z(); };
  const Eigen::Vector3d after = contact_velocity(m, v_.data());
  out.detail.t = state.t + std::min(step_, 0.5 * step_ + closing_time);
  out.detail.normal_impulse = r.normal();
  out.detail.friction_impulse = r.friction();
  out.detail.gap_rate_before = -e_r.dot(free.head<2>());
  out.detail.gap_rate_after = -e_r.dot(after.head<2>());
  out.detail.slip_before = slip(free);
  out.detail.slip_after = slip(after);
  out.detail.energy_change =
      0.5 * (r.normal() * (out.detail.gap_rate_before + out.detail.gap_rate_after) +
             r.friction() * (out.detail.slip_before + out.detail.slip_after));
  return out;
}

PaperStep PaperStepper::persist(const State& state, const Eigen::Vector2d& e_r,
                                double predicted_gap) {
  // (12), (13) over the step: y_N = gap / h at the next midpoint, y_T = slip at the end.
  const Model& m = *model_;
  const ContactParameters& c = *m.contact;
  const Eigen::Vector3d free = contact_velocity(m, v_.data());
  const Eigen::Vector2d e_t{-e_r.y(), e_r.x()};
  Eigen::Matrix3d a = implicit_admittance_;
  if (m.layout.spin) {
    a = contact_admittance(m, implicit_mass_.data(), state.t + 0.5 * step_, q_.data());
  }
  const Delassus g = delassus(a, e_r, c.radius);
  const double slip = e_t.dot(free.head<2>()) + c.radius * free.z();
  const CoulombSolution s = solve_coulomb(g, predicted_gap / step_, slip, c.friction);
  PaperStep out;
  if (s.solutions == 0) out.status = Status::kNoSolution;
  if (s.solutions > 1) out.status = Status::kAmbiguous;
  if (out.status != Status::kOk) return out;
  out.mode = mode_of(s.contact_case);
  out.normal_impulse = s.normal;
  out.friction_impulse = s.friction;
  if (s.normal > 0.0) apply(state, implicit_mass_.data(), e_r, s.normal, s.friction);
  return out;
}

PaperStep PaperStepper::contact(const State& state) {
  const Model& m = *model_;
  const double clearance = m.contact->clearance;
  const Eigen::Vector2d d = rotor_point(m, q_.data()) - stator_point(m, q_.data());
  const Eigen::Vector3d free = contact_velocity(m, v_.data());
  const Eigen::Vector2d predicted = d + step_ * free.head<2>();
  if (predicted.squaredNorm() <= clearance * clearance) {
    in_contact_ = false;
    return {};
  }
  // The normal at the midpoint. Where the step is so long that it does not close along that one,
  // the normal where the path meets the circle.
  double delta = d.norm();
  const double closing_time = crossing(d, free.head<2>(), clearance, step_);
  Eigen::Vector2d e_r = delta > kNoNormal ? Eigen::Vector2d(d / delta) : Eigen::Vector2d(0, 0);
  if (e_r.dot(free.head<2>()) <= 0.0 && delta < clearance) {
    e_r = (d + closing_time * free.head<2>()).normalized();
  }
  const double closing = e_r.dot(free.head<2>());
  start_velocity_ = contact_velocity(m, state.v.data());
  if (!in_contact_ && closing > 0.0) {
    // A rebound that the loads and the ring's curvature would undo within the step is no impact but
    // lasting contact: -gddot_N h = e_r . (ddot+ - ddot) + h v_t^2 / delta.
    const double whirl = e_r.x() * free.y() - e_r.y() * free.x();
    const double gained = e_r.dot(free.head<2>() - start_velocity_.head<2>()) +
                          step_ * whirl * whirl / clearance;
    if (m.contact->restitution * closing > gained) return impact(state, e_r, closing_time);
  }
  return persist(state, e_r, clearance - predicted.norm());
}

// A midpoint outside the ring (a flight of more than the clearance within half a step, round-off
// otherwise) goes back to the circle: q_m += M^-1 W_N (-g_N / G_NN). Left to (12), the depth over
// the step would come back as speed.
void PaperStepper::project(double t) {
  const Model& m = *model_;
  const Eigen::Vector2d d = rotor_point(m, q_.data()) - stator_point(m, q_.data());
  const double clearance = m.contact->clearance;
  if (d.squaredNorm() <= clearance * clearance) return;
  const double delta = d.norm();
  const Eigen::Vector2d e_r = d / delta;
  const double g_nn =
      delassus(contact_admittance(m, t, q_.data()), e_r, m.contact->radius).nn;
  f_.setZero();
  add_contact_load(m, contact_load(e_r, 0.0, (delta - clearance) / g_nn, 0.0), f_.data());
  solve_mass(m, t, q_.data(), f_.data(), f_.data());
  q_ += f_;
}

PaperStep PaperStepper::step(State& state, const Eigen::Vector2d& u) {
  const double h = step_;
  q_ = state.q + 0.5 * h * state.v;
  if (model_->contact) project(state.t + 0.5 * h);
  free_velocity(state, u);
  PaperStep out;
  if (model_->contact) out = contact(state);
  if (out.status != Status::kOk) return out;
  in_contact_ = out.mode != Mode::kFree;
  if (!std::isfinite(v_.sum())) {
    out.status = Status::kDiverged;
    return out;
  }
  q_ += 0.5 * h * v_;
  state.q.swap(q_);
  state.v.swap(v_);
  state.t += h;
  return out;
}

}  // namespace rotorub
