#include "native_model/stepping/several_contacts.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/kinematics.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
SeveralContacts::SeveralContacts(StepState& x, LoadKick& loads)
    : ContactColumns(x, loads), without_impacts_(static_cast<std::size_t>(x.nq())) {
  impacts.reserve(count() * count() * StepImpacts::kMost);
}

void SeveralContacts::begin(const StepState& x) {
  now = {};
  for (std::size_t i = 0; i < count(); ++i) {
    now.of[i].lasts = rests_on_circle(m_, x.q.data(), x.v.data(), i);
  }
}

void SeveralContacts::forget_last() {
  impacts.clear();
  for (std::size_t i = 0; i < count(); ++i) last_sign_[i] = now.of[i].slip_sign;
}

bool SeveralContacts::leaves(std::size_t i, const Eigen::Vector3d& velocity) const {
  return (places[i].d + h_ * velocity.head<2>()).norm() > law(i).clearance;
}

// The step impulses for which each ends on its circle: Newton's method, whose linear problem is the
// law's.
CoupledSolution SeveralContacts::solve_on_circles(std::span<const std::size_t> lasting,
                                                  std::span<const Friction> friction) const {
  const auto n = static_cast<Eigen::Index>(lasting.size());
  const auto contact = [&](Eigen::Index i) { return lasting[static_cast<std::size_t>(i)]; };
  std::array<ContactSet, kMaxContacts> sets{};
  // What unit impulses do to the rates of each.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * kMaxContacts, 2 * kMaxContacts>
      effect(3 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    sets[at].friction = friction[at].given ? std::abs(friction[at].ratio) : friction[at].bound;
    if (friction[at].given) sets[at].slides = friction[at].ratio > 0.0 ? -1.0 : 1.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Matrix3d a = admittance(contact(i), contact(j));
      const Eigen::Vector2d& e_r = places[contact(j)].e_r;
      const double radius = law(contact(j)).radius;
      effect.block<3, 1>(3 * i, 2 * j) = a * contact_load(e_r, radius, 1.0, 0.0);
      effect.block<3, 1>(3 * i, 2 * j + 1) = a * contact_load(e_r, radius, 0.0, 1.0);
    }
  }
  CoupledSolution s;
  ContactVector p = ContactVector::Zero(2 * n);
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    ContactMatrix a(2 * n, 2 * n);
    ContactVector b(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Place& c = places[contact(i)];
      const Eigen::Vector3d change = effect.middleRows<3>(3 * i) * p;
      const Eigen::Vector2d end = c.d + h_ * (c.free + change).head<2>();
      const double distance = end.norm();
      const Eigen::Vector2d out = end / distance;
      for (Eigen::Index j = 0; j < 2 * n; ++j) {
        const Eigen::Vector3d by = effect.block<3, 1>(3 * i, j);
        a(2 * i, j) = -out.dot(by.head<2>());
        a(2 * i + 1, j) = slip(contact(i), by);
      }
      b[2 * i] = (law(contact(i)).clearance - distance) / h_ - a.row(2 * i).dot(p);
      b[2 * i + 1] = slip(contact(i), c.free);
    }
    s = solve_coupled(a, b, std::span(sets).first(lasting.size()));
    if (s.solutions != 1) return s;
    const double moved = (s.p - p).cwiseAbs().maxCoeff();
    p = s.p;
    if (moved <= 1e-14 * p.cwiseAbs().maxCoeff()) break;
  }
  return s;
}

// A step in which a contact turns so far that its normals have no one solution, whatever the law.
bool SeveralContacts::whirls_too_far(std::span<const std::size_t> lasting) const {
  constexpr double kMostTurn = 0.5;  // rad
  return std::ranges::any_of(lasting, [&](std::size_t i) {
    const Eigen::Vector2d &e = places[i].e_r, w = places[i].start.head<2>();
    return h_ * std::abs(e.x() * w.y() - e.y() * w.x()) > kMostTurn * law(i).clearance;
  });
}

// Impulses of the contacts that last; false: the laws have none. Friction follows the slip of the
// middle, and so does its mu; where that changes its sign within the step, it is the mean of its
// two values by the time that each holds.
bool SeveralContacts::press(StepState& x, std::span<const std::size_t> lasting) {
  std::array<Friction, kMaxContacts> friction{};
  std::array<SlipFriction, kMaxContacts> of_slip;
  std::array<double, kMaxContacts> before{}, until{};
  const std::size_t n = lasting.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d& start = places[lasting[i]].start;
    const ContactParameters& c = law(lasting[i]);
    before[i] = slip(lasting[i], start);
    if (std::abs(before[i]) <= kNoSlip * c.radius * std::abs(start.z())) before[i] = 0.0;
    friction[i].bound = c.friction.sticking();
    if (before[i] != 0.0) {
      of_slip[i] = {c.friction, before[i]};
      friction[i].bound = of_slip[i].mu();
      friction[i].given = true;
      friction[i].ratio = before[i] > 0.0 ? -friction[i].bound : friction[i].bound;
    }
  }
  CoupledSolution s;
  std::array<bool, kMaxContacts> turns{}, turned{};
  for (bool settled = false; !settled;) {
    s = solve_on_circles(lasting, std::span(friction).first(n));
    if (s.solutions != 1) {
      x.fail(whirls_too_far(lasting) ? Status::kStepTooLarge : status_of(s.solutions));
      return false;
    }
    settled = true;
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = static_cast<Eigen::Index>(2 * i);
      const double sign = before[i] > 0.0 ? 1.0 : -1.0;
      if (!turns[i] && friction[i].given && s.y[at + 1] * sign <= 0.0 && s.p[at] > 0.0) {
        // It would come to rest: does friction hold it?
        turns[i] = true;
        until[i] = before[i] / (before[i] - s.y[at + 1]);  // share of the step
        friction[i].given = false;
        friction[i].bound = law(lasting[i]).friction.sticking();
        settled = false;
      } else if (turns[i] && !turned[i] && !s.sticks[i] && s.p[at] > 0.0) {
        turned[i] = true;
        friction[i].given = true;
        friction[i].ratio = friction[i].bound * sign * (1.0 - 2.0 * until[i]);
        settled = false;
      } else if (friction[i].given && !turns[i] && s.p[at] > 0.0 &&
                 of_slip[i].improve(0.5 * (before[i] + s.y[at + 1]))) {
        friction[i].bound = of_slip[i].mu();
        friction[i].ratio = -sign * friction[i].bound;
        settled = false;
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    Lasting::Of& c = now.of[lasting[i]];
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

bool SeveralContacts::go_on(StepState& x, LoadKick& loads, bool /*unsettled*/) {
  std::array<std::size_t, kMaxContacts> lasting{};
  std::size_t n = 0;
  look(x);
  for (std::size_t i = 0; i < count(); ++i) {
    Lasting::Of& c = now.of[i];
    c.normal = c.friction = 0.0;
    if (c.lasts) lasting[n++] = i;
  }
  // One alone lasts where its free path leaves; of several one may press another, which only all
  // together decide.
  if (n == 1 && !leaves(lasting[0], places[lasting[0]].free)) {
    now.of[lasting[0]].lasts = false;
    n = 0;
  }
  for (const std::size_t i : std::span(lasting).first(n)) {
    places[i].e_r = places[i].d.normalized();
  }
  if (n > 0) {
    if (loads.coupled()) respond(loads);
    if (loads.iterates()) loads.begin_iteration();
    for (bool settled = false;;) {
      if (!press(x, std::span(lasting).first(n))) return false;
      x.after = x.free;
      for (std::size_t i = 0; i < count(); ++i) {
        if (now.of[i].normal != 0.0) push(i, now.of[i].normal, now.of[i].friction, x.after);
      }
      if (!loads.iterates() || settled) break;
      settled = !loads.improve(x, x.after.data());
      for (std::size_t i = 0; i < count(); ++i) places[i].free = rates(i, x.free.data());
    }
  }
  for (Lasting::Of& c : now.of) {
    c.lasts = c.lasts && c.normal > 0.0;
    if (!c.lasts) c.slip_sign = 0.0;
    c.normal_at_end = c.normal;
    c.friction_at_end = c.friction;
  }
  note_lasting();
  return true;
}

void SeveralContacts::note_lasting() {
  for (std::size_t i = 0; i < count(); ++i) {
    const Lasting::Of& c = now.of[i];
    const Mode mode = !c.lasts ? Mode::kFree : c.slip_sign == 0.0 ? Mode::kStick : Mode::kSlide;
    done[i] = {
        mode,      last_sign_[i] * c.slip_sign < 0.0, c.normal, c.friction, {c.normal, c.friction},
        {0.0, 0.0}};
  }
}

void SeveralContacts::hold_on(StepState& x, LoadKick& loads) {
  if (!lasts()) return;
  if (loads.coupled()) respond(loads);
  for (std::size_t i = 0; i < count(); ++i) {
    const Lasting::Of& c = now.of[i];
    if (!c.lasts) continue;
    places[i].e_r = separation(m_, x.seen.data(), i).normalized();
    push(i, c.normal_at_end, c.friction_at_end, x.free);
  }
}

bool SeveralContacts::alike(const Lasting& part, const Lasting& was) const {
  for (std::size_t i = 0; i < count(); ++i) {
    if (!was.of[i].lasts) continue;
    if (!part.of[i].lasts || part.of[i].slip_sign != was.of[i].slip_sign) return false;
  }
  return true;
}

void SeveralContacts::join_parts(double share, double rest, const Lasting& first) {
  for (std::size_t i = 0; i < count(); ++i) {
    Lasting::Of& c = now.of[i];
    c.normal = share * first.of[i].normal + rest * c.normal;
    c.friction = share * first.of[i].friction + rest * c.friction;
  }
  note_lasting();
}

void SeveralContacts::go_on_as(const Lasting& mean) {
  now = mean;
  note_lasting();
}

SeveralContacts::Lasting SeveralContacts::second_part(const Lasting& was,
                                                      const Lasting& first) const {
  Lasting second = first;
  for (std::size_t i = 0; i < count(); ++i) second.of[i].lasts = was.of[i].lasts;
  return second;
}

bool SeveralContacts::lasts() const {
  return std::ranges::any_of(now.of, [](const Lasting::Of& c) { return c.lasts; });
}

void SeveralContacts::tell(FixedStep& out, double /*sign_before*/) const {
  static_cast<ContactStep&>(out) = done[0];
  out.others = std::span(done).subspan(1);
  out.impacts = impacts;
}

}  // namespace rotorub
