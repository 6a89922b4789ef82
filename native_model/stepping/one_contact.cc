#include "native_model/stepping/one_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/contact/kinematics.h"
#include "native_model/contact/step_contact.h"
#include "native_model/model/dynamics.h"

namespace rotorub {

namespace eq = equations;

OneContact::OneContact(const StepState& x, LoadKick& loads) {
  const Model& m = x.m;
  exists_ = m.first().contact.has_value();
  if (!exists_) return;
  const ContactParameters& c = *m.first().contact;
  clearance_ = c.clearance;
  radius_ = c.radius;
  friction_ =
      c.friction.is_constant() ? c.friction.coefficient : std::numeric_limits<double>::quiet_NaN();
  for (int j = 0; j < 3; ++j) {
    column_[j].resize(x.q.size());
    double* column = column_[j].data();
    add_contact_load(m, Eigen::Vector3d::Unit(j), column);
    loads.solve_uncoupled(column);
    const Eigen::Vector3d rates = contact_acceleration(m, column);
    for (int i = 0; i < 3; ++i) uncoupled_[i][j] = admittance_[i][j] = rates[i];
  }
}

void OneContact::begin(const StepState& x) {
  now = {};
  if (exists_) set_lasting(rests_on_circle(x.m, x.q.data(), x.v.data(), 0));
}

// ------------------------------------------------------------------ what a load does
// With bending and spin coupled as in this step.
void OneContact::couple(const StepState& x, const LoadKick& loads) {
  if (!loads.coupled()) return;
  const Layout& l = x.m.layout;
  const AuxiliaryBearing& at = x.m.first();
  const VelocityMatrix& a = loads.matrix();
  const Pair bent = eq::at_station(l.modes, at.shape, a.solved_coupling());
  double turned = a.spin_column()[0];
  for (int k = 0; k < l.torsion; ++k) turned += at.torsion_shape[k] * a.spin_column()[1 + k];
  for (int j = 0; j < 3; ++j) {
    coupled_[j] = a.coupled_part(column_[j].data());
    admittance_[0][j] = uncoupled_[0][j] - bent.x * coupled_[j].spin;
    admittance_[1][j] = uncoupled_[1][j] - bent.y * coupled_[j].spin;
    admittance_[2][j] = uncoupled_[2][j] + turned * coupled_[j].back;
  }
}

// to = x.free + A^-1 J^T of the impulses (normal, friction) with the normal e.
ROTORUB_INLINE void OneContact::push(const StepState& x, const LoadKick& loads, const Pair& e,
                                     const Eigen::Vector2d& impulses, double* to) const {
  const double normal = impulses.x(), friction = impulses.y();
  const double px = -e.x * normal - e.y * friction, py = -e.y * normal + e.x * friction;
  const double pz = radius_ * friction;
  const double *cx = column_[0].data(), *cy = column_[1].data(), *cz = column_[2].data();
  const double* from = x.free.data();
  const int nq = x.nq();
  ROTORUB_APART for (int i = 0; i < nq; ++i) {
    to[i] = from[i] + (cx[i] * px + cy[i] * py + cz[i] * pz);
  }
  if (!loads.coupled()) return;
  const auto along = [&](auto part) {
    return coupled_[0].*part * px + coupled_[1].*part * py + coupled_[2].*part * pz;
  };
  using Coupled = VelocityMatrix::Coupled;
  loads.matrix().add({along(&Coupled::spin), along(&Coupled::back)}, to);
}

// ------------------------------------------------------------------ lasting contact
// Whether the path from d with the velocity w ends outside the circle.
ROTORUB_INLINE bool OneContact::leaves(const StepState& x, const Pair& d, const Pair& w) const {
  const double px = d.x + x.h * w.x, py = d.y + x.h * w.y;
  return px * px + py * py > clearance_ * clearance_;
}

// Where the path ends far from where it begins (it passes the middle), the normal is that of the
// place where it leaves the circle.
void OneContact::press_anew(StepState& x, const Pair& d, const Pair& w) {
  const ContactParameters& c = *x.m.first().contact;
  LastingStep s;
  s.h = x.h;
  s.d = {d.x, d.y};
  const Eigen::Vector2d path = x.h * Eigen::Vector2d(w.x, w.y);
  if (s.d.dot(s.d + path) < 0.5 * c.clearance * c.clearance) {
    const double share = circle_exit(s.d, path, c.clearance);
    const Eigen::Vector2d e_r = (s.d + std::min(1.0, share) * path).normalized();
    normal_ = {e_r.x(), e_r.y()};
  }
  s.e_r = {normal_.x, normal_.y};
  s.start = contact_rates(x.m, x.start.data());
  s.free = contact_rates(x.m, x.free.data());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) s.admittance(i, j) = admittance_[i][j];
  }
  s.clearance = c.clearance;
  s.radius = c.radius;
  s.friction = c.friction;
  const LastingResult r = solve_lasting_contact(s);
  if (r.solutions != 1) x.fail(status_of(r.solutions));
  now.normal = r.normal;
  now.friction = r.friction;
  now.slip_sign = r.contact_case == ContactCase::kSlidePositive   ? 1.0
                  : r.contact_case == ContactCase::kSlideNegative ? -1.0
                                                                  : 0.0;
}

// The impulses for the present x.free; see contact/step_contact.h. Sliding on as in the step
// before, where that can be.
ROTORUB_INLINE void OneContact::press(StepState& x, const Pair& d, const Pair& w) {
  const double h = x.h, r = radius_, ex = normal_.x, ey = normal_.y;
  const double spin = eq::contact_spin(x.m, x.free.data());
  const double ratio = -friction_ * last_sign_;
  // Response to N with T = ratio N.
  const double lx = -ex - ey * ratio, ly = -ey + ex * ratio, lz = r * ratio;
  const auto& a = admittance_;
  const double gx = a[0][0] * lx + a[0][1] * ly + a[0][2] * lz;
  const double gy = a[1][0] * lx + a[1][1] * ly + a[1][2] * lz;
  const double gz = a[2][0] * lx + a[2][1] * ly + a[2][2] * lz;
  const double px = d.x + h * w.x, py = d.y + h * w.y, hx = h * gx, hy = h * gy;
  const double square = hx * hx + hy * hy, along = px * hx + py * hy;
  const double circle = clearance_ * clearance_;
  const double depth = px * px + py * py - circle;
  const double root = along * along - square * depth;
  const double normal = depth / (std::sqrt(root > 0.0 ? root : 1.0) - along);
  const double slip =
      ex * (w.y + normal * gy) - ey * (w.x + normal * gx) + r * (spin + normal * gz);
  const double turned = d.x * px + d.y * py;
  // Once iterated, the path may end inside: no adhesion.
  const bool slides =
      depth > 0.0 && root > 0.0 && along < 0.0 && slip * last_sign_ > 0.0 && turned >= 0.5 * circle;
  if (!slides) return press_anew(x, d, w);
  now.normal = normal;
  now.friction = ratio * normal;
  now.slip_sign = last_sign_;
}

// From d at the step's begin: x.after from x.free, whatever the iteration needs.
void OneContact::press_on(StepState& x, LoadKick& loads, const Pair& d, Pair w) {
  couple(x, loads);
  last_sign_ = now.slip_sign;
  const double square = d.x * d.x + d.y * d.y;
  const double inverse = 1.0 / std::sqrt(square > 0.0 ? square : 1.0);
  normal_ = {d.x * inverse, d.y * inverse};
  if (loads.iterates()) loads.begin_iteration();
  for (bool settled = false;;) {
    press(x, d, w);
    push(x, loads, normal_, {now.normal, now.friction}, x.after.data());
    // Once more after the last round.
    if (!loads.iterates() || settled) break;
    settled = !loads.improve(x, x.after.data());
    w = eq::relative(x.m, x.free.data());
  }
  now.lasts = now.normal > 0.0;
}

bool OneContact::go_on(StepState& x, LoadKick& loads, bool unsettled) {
  const Lasting was = now;
  now = {};
  const Pair d = eq::separation(x.m, x.seen.data());
  Pair w = eq::relative(x.m, x.free.data());
  bool outside = leaves(x, d, w);
  if (!was.lasts) return outside;
  if (!outside && unsettled) {
    loads.settle(x);
    w = eq::relative(x.m, x.free.data());
    outside = leaves(x, d, w);
  }
  if (!outside) return false;
  now.slip_sign = was.slip_sign;
  press_on(x, loads, d, w);
  now.normal_at_end = now.normal;
  now.friction_at_end = now.friction;
  return false;
}

void OneContact::hold_on(StepState& x, LoadKick& loads) {
  if (!lasts()) return;
  const Pair d = eq::separation(x.m, x.seen.data());
  const double square = d.x * d.x + d.y * d.y;
  const double delta = std::sqrt(square > 0.0 ? square : 1.0);
  couple(x, loads);
  push(x, loads, {d.x / delta, d.y / delta}, {now.normal_at_end, now.friction_at_end},
       x.free.data());
}

void OneContact::join_parts(double share, double rest, const Lasting& first) {
  now.normal_at_end = now.normal;
  now.friction_at_end = now.friction;
  now.normal = share * first.normal + rest * now.normal;
  now.friction = share * first.friction + rest * now.friction;
}

// ------------------------------------------------------------------ what the step did
void OneContact::note_impact(const Impact& impact) {
  if (!impacted) {
    normal_impulse_ = now.normal;
    friction_impulse_ = now.friction;
  }
  impacted = true;
  normal_impulse_ += impact.normal_impulse;
  friction_impulse_ += impact.friction_impulse;
  // After an impact without restitution the gap closes by round-off, which is no second one.
  constexpr double kLeastRate = 1e-9;  // m/s
  if (impact.gap_rate_before < -kLeastRate) impacts.add(impact);
}

void OneContact::tell(FixedStep& out, double sign_before) const {
  if (impacted) {
    out.normal_impulse = normal_impulse_;
    out.friction_impulse = friction_impulse_;
    out.impacts = impacts.view();
    return;
  }
  out.normal_impulse = now.normal;
  out.friction_impulse = now.friction;
  out.lasting = {now.normal, now.friction};
  if (!now.lasts) return;
  out.mode = now.slip_sign == 0.0 ? Mode::kStick : Mode::kSlide;
  out.reversed = sign_before * now.slip_sign < 0.0;
}

double OneContact::lasting_work(const StepState& x) const {
  return rotorub::lasting_work(x.m, 0, {normal_.x, normal_.y}, {now.normal, now.friction},
                               contact_rates(x.m, x.start.data()),
                               contact_rates(x.m, x.after.data()));
}

}  // namespace rotorub
