#include "native_model/periodic/turning_frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "native_model/event/smooth_system.h"
#include "native_model/model/dynamics.h"
#include "native_model/periodic/forcing.h"

namespace rotorub::periodic {
namespace {

constexpr double kLasting = 1e299;  // s; loads that are switched off later act for ever

// rad/s, the speed of all loads; 0 if they have none in common.
double speed_of_loads(const Model& m) {
  std::optional<double> speed;
  bool is_common = true;
  const auto meet = [&](double of) {
    is_common = is_common && (!speed || *speed == of);
    speed = of;
  };
  if (!m.unbalances.empty()) meet(m.speed);
  for (const AppliedForce& f : m.forces) {
    if (f.off < kLasting || (f.amplitude == 0.0 && f.vector.isZero())) continue;
    meet(f.kind == scene::ForceKind::kRotating ? f.frequency : 0.0);
  }
  return is_common ? speed.value_or(0.0) : 0.0;
}

}  // namespace

TurningFrame::TurningFrame(const Model& m) : speed_(speed_of_loads(m)), layout_(m.layout) {
  const Layout& l = layout_;
  const bool has_states = l.spin > 0 || l.torsion > 0 || l.nq() > l.mechanical();
  if (speed_ != 0.0 && (has_states || !is_symmetric(m))) speed_ = 0.0;
}

// Tests it on one state: the acceleration must turn with the state.
bool TurningFrame::is_symmetric(const Model& m) const {
  constexpr double kAngle = 0.7, kSame = 1e-9;
  const double angle = std::copysign(kAngle, speed_);
  const Eigen::Index n = 2 * m.nq();
  const double reach = m.first().contact ? m.first().contact->clearance : 1e-3;
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double size = i < n / 2 ? 0.3 * reach / (1 + m.nq()) : std::abs(speed_) * reach;
    y[i] = size * std::sin(1.0 + 2.3 * static_cast<double>(i));
  }
  const Eigen::VectorXd to = turned(y, angle);
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const Eigen::Vector2d turned_with = Eigen::Rotation2Dd(angle) * separation(m, y.data(), k);
    if ((separation(m, to.data(), k) - turned_with).norm() > kSame * reach) return false;
  }
  SmoothSystem system(m);
  const auto slope = [&](double t, const Eigen::VectorXd& at) {
    std::vector<double> all(static_cast<std::size_t>(n + integral_count(m))), rates(all);
    std::copy_n(at.data(), n, all.begin());
    system.derivative(t, all.data(), rates.data());
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(rates.data(), n));
  };
  const double t = forcing_of(m).settled;
  const Eigen::VectorXd here = turned(slope(t, y), angle), there = slope(t + angle / speed_, to);
  return (there - here).norm() <= kSame * here.norm();
}

Eigen::VectorXd TurningFrame::turned(const Eigen::VectorXd& y, double angle) const {
  const Layout& l = layout_;
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::VectorXd to = y;
  const auto turn = [&](Eigen::Index x, Eigen::Index at_y) {
    to[x] = c * y[x] - s * y[at_y];
    to[at_y] = s * y[x] + c * y[at_y];
  };
  for (const int half : {0, l.nq()}) {
    for (int i = 0; i < l.modes; ++i) turn(half + l.x() + i, half + l.y() + i);
    for (int i = 0; i + 1 < l.stator; i += 2) turn(half + l.ring() + i, half + l.ring() + i + 1);
  }
  return to;
}

Eigen::VectorXd TurningFrame::seen(const Eigen::VectorXd& y, double duration) const {
  return turns() ? turned(y, -speed_ * duration) : y;
}

Eigen::VectorXd TurningFrame::slope_seen(const Eigen::VectorXd& y,
                                         const Eigen::VectorXd& slope) const {
  if (!turns()) return slope;
  const Layout& l = layout_;
  Eigen::VectorXd seen = slope;
  const auto turn = [&](Eigen::Index x, Eigen::Index at_y) {
    seen[x] += speed_ * y[at_y];
    seen[at_y] -= speed_ * y[x];
  };
  for (const int half : {0, l.nq()}) {
    for (int i = 0; i < l.modes; ++i) turn(half + l.x() + i, half + l.y() + i);
    for (int i = 0; i + 1 < l.stator; i += 2) turn(half + l.ring() + i, half + l.ring() + i + 1);
  }
  return seen;
}

}  // namespace rotorub::periodic
