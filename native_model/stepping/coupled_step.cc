#include "native_model/stepping/coupled_step.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/kinematics.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/system/actuation.h"

namespace rotorub {
namespace {

constexpr double kNoSlip = 1e-10;  // of the surface's speed

}  // namespace

Eigen::Vector3d CoupledStep::rates(std::size_t contact, const double* v) const {
  const auto w = equations::relative(*m_, m_->auxiliary[contact], v);
  return {w.x, w.y, equations::contact_spin(*m_, m_->auxiliary[contact], v)};
}

CoupledStep::CoupledStep(const Model& model, double step, double least_flight)
    : LoadKernel<Model>(model, {&model}, step),
      least_flight_(least_flight * step),
      contacts_(model.auxiliary.size()),
      response_(3 * model.auxiliary.size(), Columns(static_cast<std::size_t>(model.nq()))),
      applied_(static_cast<std::size_t>(model.nq())),
      after_(applied_),
      free_end_(applied_),
      seen_(applied_),
      done_(contacts_.size()) {
  // What drives the rings comes with each step.
  commanded = magnetic_ = false;
  applied = applied_.data();
  hits_.reserve(contacts_.size() * contacts_.size() * StepImpacts::kMost);
  load_initial_states();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].law = *model.auxiliary[i].contact;
    // A start on the circle that does not close is lasting contact.
    const ContactPoint p = contact_point(model, model.q0.data(), model.v0.data(), i);
    contacts_[i].lasts = p.gap <= kOnCircle * contacts_[i].law.clearance && p.gap_rate >= -1e-9 &&
                         p.gap_rate <= 1e-9;
  }
  if (!coupled_) respond();
}

// Of the actuators of rings that are driven, at the coordinates q.
void CoupledStep::apply_commands(std::span<const Eigen::Vector2d> u, const double* q) {
  std::fill(applied_.begin(), applied_.end(), 0.0);
  for (std::size_t i = 0; i < u.size(); ++i) {
    const AuxiliaryBearing& at = m_->auxiliary[i];
    const bool driven = at.commanded() || at.magnets || !u[i].isZero(0.0);
    if (!at.moves() || !driven) continue;
    const Eigen::Vector2d force = actuator_state(*m_, q, v_.data(), u[i], i).force;
    applied_[static_cast<std::size_t>(at.ring)] = force.x();
    applied_[static_cast<std::size_t>(at.ring) + 1] = force.y();
  }
}

// The columns A^-1 J^T of every contact.
void CoupledStep::respond() {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      Columns& column = response_[3 * i + static_cast<std::size_t>(axis)];
      std::fill(column.begin(), column.end(), 0.0);
      add_contact_load(*m_, Eigen::Vector3d::Unit(axis), column.data(), i);
      solve(column.data());
    }
  }
}

Eigen::Matrix3d CoupledStep::admittance(std::size_t i, std::size_t j) const {
  Eigen::Matrix3d a;
  for (int axis = 0; axis < 3; ++axis) {
    a.col(axis) =
        contact_acceleration(*m_, response_[3 * j + static_cast<std::size_t>(axis)].data(), i);
  }
  return a;
}

// Where the contacts are, at seen_.
void CoupledStep::place() {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    c.d = separation(*m_, seen_.data(), i);
    c.start = rates(i, start_.data());
    c.free = rates(i, free_.data());
    c.normal = c.friction = 0.0;
  }
}

bool CoupledStep::leaves(const Contact& c, const Eigen::Vector3d& velocity) const {
  return (c.d + h_ * velocity.head<2>()).norm() > c.law.clearance;
}

void CoupledStep::push(double* to) const {
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contacts_[i];
    if (c.normal == 0.0) continue;
    const Eigen::Vector3d p = contact_load(c.e_r, c.law.radius, c.normal, c.friction);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Columns& column = response_[3 * i + axis];
      for (std::size_t k = 0; k < column.size(); ++k)
        to[k] += column[k] * p[static_cast<Eigen::Index>(axis)];
    }
  }
}

// The step impulses for which each ends on its circle: Newton's method, whose linear problem is the
// law's.
CoupledSolution CoupledStep::solve_on_circles(std::span<const std::size_t> lasting,
                                              std::span<const Friction> friction) const {
  const auto n = static_cast<Eigen::Index>(lasting.size());
  const auto contact = [&](Eigen::Index i) -> const Contact& {
    return contacts_[lasting[static_cast<std::size_t>(i)]];
  };
  std::array<ContactSet, kMaxContacts> sets{};
  // What unit impulses do to the rates of each.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * kMaxContacts, 2 * kMaxContacts>
      effect(3 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    sets[at].friction = friction[at].given ? std::abs(friction[at].ratio) : friction[at].bound;
    if (friction[at].given) sets[at].slides = friction[at].ratio > 0.0 ? -1.0 : 1.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      const Contact& c = contact(j);
      const Eigen::Matrix3d a = admittance(lasting[at], lasting[static_cast<std::size_t>(j)]);
      effect.block<3, 1>(3 * i, 2 * j) = a * contact_load(c.e_r, c.law.radius, 1.0, 0.0);
      effect.block<3, 1>(3 * i, 2 * j + 1) = a * contact_load(c.e_r, c.law.radius, 0.0, 1.0);
    }
  }
  CoupledSolution s;
  ContactVector p = ContactVector::Zero(2 * n);
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    ContactMatrix a(2 * n, 2 * n);
    ContactVector b(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Contact& c = contact(i);
      const Eigen::Vector3d change = effect.middleRows<3>(3 * i) * p;
      const Eigen::Vector2d end = c.d + h_ * (c.free + change).head<2>();
      const double distance = end.norm();
      const Eigen::Vector2d out = end / distance;
      for (Eigen::Index j = 0; j < 2 * n; ++j) {
        const Eigen::Vector3d by = effect.block<3, 1>(3 * i, j);
        a(2 * i, j) = -out.dot(by.head<2>());
        a(2 * i + 1, j) = slip(c, by);
      }
      b[2 * i] = (c.law.clearance - distance) / h_ - a.row(2 * i).dot(p);
      b[2 * i + 1] = slip(c, c.free);
    }
    s = solve_coupled(a, b, std::span(sets).first(lasting.size()));
    if (s.solutions != 1) return s;
    const double moved = (s.p - p).cwiseAbs().maxCoeff();
    p = s.p;
    if (moved <= 1e-14 * p.cwiseAbs().maxCoeff()) break;
  }
  return s;
}

// Impulses of the contacts that last; false: the laws have none. Friction follows the slip of the
// middle; where that changes its sign within the step, it is the mean of its two values by the time
// that each holds.
bool CoupledStep::press(std::span<const std::size_t> lasting) {
  std::array<Friction, kMaxContacts> friction{};
  std::array<double, kMaxContacts> before{};
  const std::size_t n = lasting.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Contact& c = contacts_[lasting[i]];
    before[i] = slip(c, c.start);
    if (std::abs(before[i]) <= kNoSlip * c.law.radius * std::abs(c.start.z())) before[i] = 0.0;
    friction[i].bound = c.law.friction.at(before[i]);
    if (before[i] != 0.0) {
      friction[i].given = true;
      friction[i].ratio = before[i] > 0.0 ? -friction[i].bound : friction[i].bound;
    }
  }
  CoupledSolution s;
  std::array<bool, kMaxContacts> turns{}, turned{};
  for (bool settled = false; !settled;) {
    s = solve_on_circles(lasting, std::span(friction).first(n));
    if (s.solutions != 1) {
      fail(0, status_of(s.solutions));
      return false;
    }
    settled = true;
    for (std::size_t i = 0; i < n; ++i) {
      const Contact& c = contacts_[lasting[i]];
      const auto at = static_cast<Eigen::Index>(2 * i);
      const double mu = friction[i].bound, sign = before[i] > 0.0 ? 1.0 : -1.0;
      if (!turns[i] && friction[i].given && s.y[at + 1] * sign <= 0.0 && s.p[at] > 0.0) {
        // It would come to rest: does friction hold it?
        turns[i] = true;
        contacts_[lasting[i]].slip_sign =
            before[i] / (before[i] - s.y[at + 1]);  // share of the step until then
        friction[i].given = false;
        settled = false;
      } else if (turns[i] && !turned[i] && !s.sticks[i] && s.p[at] > 0.0) {
        turned[i] = true;
        friction[i].given = true;
        friction[i].ratio = mu * sign * (1.0 - 2.0 * c.slip_sign);
        settled = false;
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    Contact& c = contacts_[lasting[i]];
    const auto at = static_cast<Eigen::Index>(2 * i);
    c.normal = s.p[at];
    c.friction = s.p[at + 1];
    const double slip = s.y[at + 1];
    const bool sticks = !friction[i].given && s.sticks[i];
    c.slip_sign = sticks        ? 0.0
                  : turned[i]   ? (before[i] > 0.0 ? -1.0 : 1.0)
                  : slip >= 0.0 ? 1.0
                                : -1.0;
  }
  return true;
}

void CoupledStep::last() {
  std::array<std::size_t, kMaxContacts> lasting{};
  std::array<double, kMaxContacts> signs{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    signs[i] = c.slip_sign;
    c.lasts = c.lasts && leaves(c, c.free);
    if (!c.lasts) continue;
    c.e_r = normal_of_path(c.d, h_ * c.free.head<2>(), c.law.clearance);
    lasting[count++] = i;
  }
  std::copy(free_.begin(), free_.end(), after_.begin());
  if (count > 0) {
    if (coupled_) respond();
    if (iterates_) begin_iteration(1.0);
    for (bool settled = false;;) {
      if (!press(std::span(lasting).first(count))) return;
      std::copy(free_.begin(), free_.end(), after_.begin());
      push(after_.data());
      if (!iterates_ || settled) break;
      settled = !improve(seen_.data(), after_.data());
      for (std::size_t i = 0; i < contacts_.size(); ++i) contacts_[i].free = rates(i, free_.data());
    }
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    Contact& c = contacts_[i];
    c.lasts = c.lasts && c.normal > 0.0;
    if (!c.lasts) c.slip_sign = 0.0;
    note_lasting(i, signs[i]);
  }
}

// `sign`: of the slip, before the step.
void CoupledStep::note_lasting(std::size_t contact, double sign) {
  const Contact& c = contacts_[contact];
  const Mode mode = !c.lasts ? Mode::kFree : c.slip_sign == 0.0 ? Mode::kStick : Mode::kSlide;
  done_[contact] = {mode,       sign * c.slip_sign < 0.0, c.normal,
                    c.friction, {c.normal, c.friction},   {0.0, 0.0}};
}

FixedStep CoupledStep::result(double share, const Columns& end, bool works) {
  FixedStep out;
  static_cast<ContactStep&>(out) = done_[0];
  out.status = status[0];
  out.others = std::span(done_).subspan(1);
  out.impacts = hits_;
  if (!works || out.status != Status::kOk) return out;
  out.impact_work = impact_work();
  out.contact_work = lasting_work() + out.impact_work;
  out.external_work = share * external_work(seen_.data(), start_.data(), end.data()) + late_work_;
  return out;
}

// v = after_, q = seen_ + dt v.
void CoupledStep::move(double dt) {
  check_finite(after_.data());
  if (status[0] != Status::kOk) return;
  for (std::size_t i = 0; i < after_.size(); ++i) {
    v_[i] = after_[i];
    q_[i] = seen_[i] + dt * after_[i];
  }
}

double CoupledStep::lasting_work() const {
  double work = 0.0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Eigen::Vector2d& did = done_[i].lasting;
    if (!(did.x() > 0.0)) continue;
    const Contact& c = contacts_[i];
    const Eigen::Vector3d load = contact_load(c.e_r, c.law.radius, did.x(), did.y());
    const Eigen::Vector3d end = rates(i, free_end_.data());
    work += load.dot(0.5 * (c.start + end) - Eigen::Vector3d(0.0, 0.0, held()));
  }
  return work;
}

double CoupledStep::impact_work() const {
  double work = 0.0;
  for (const Impact& hit : hits_) {
    const double radius = contacts_[static_cast<std::size_t>(hit.contact)].law.radius;
    work += hit.energy_change - hit.friction_impulse * radius * held();
  }
  return work;
}

}  // namespace rotorub
