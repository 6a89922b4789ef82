#include "native_model/contact/rigid_law.h"

#include <algorithm>

#include "native_model/contact/constrained_law.h"
#include "native_model/contact/impact.h"
#include "native_model/contact/kinematics.h"
#include "native_model/contact/planar_contact.h"

namespace rotorub {
namespace {

// The response along normal and tangent.
class PlanarResponse final : public ContactResponse {
 public:
  // offset: m/s, of the normal law, y_N = gdot_N + offset.
  PlanarResponse(StepResponse& step, const Eigen::Vector2d& e_r, double radius, bool impact,
                 double offset)
      : step_(step), e_r_(e_r), radius_(radius), impact_(impact), offset_(offset) {}
  ContactVector rates(const Eigen::Vector3d& v) const {
    return rates_along(e_r_, radius_, v) + Eigen::Vector2d(offset_, 0.0);
  }
  ContactVector at(const ContactVector& p) override {
    return rates(step_.end(contact_load(e_r_, radius_, p[0], p[1]), impact_));
  }
  ContactVector sudden(const ContactVector& p) override {
    return rates_along(e_r_, radius_, step_.sudden(contact_load(e_r_, radius_, p[0], p[1])));
  }
  double accuracy() const override { return step_.accuracy(); }

 private:
  StepResponse& step_;
  Eigen::Vector2d e_r_;
  double radius_;
  bool impact_;
  double offset_;
};

ContactMatrix matrix_of(const Delassus& g) {
  ContactMatrix a(2, 2);
  a << g.nn, g.nt, g.tn, g.tt;
  return a;
}

// False: no impulse is given.
bool take(Status status, double normal, double friction, RigidResult& out) {
  out.status = status;
  if (status != Status::kOk) return false;
  out.normal = normal;
  out.friction = friction;
  return true;
}
bool take(const ConstrainedContact& s, RigidResult& out) {
  out.converged = s.converged;
  if (s.solved) take(Status::kOk, s.p[0], s.p[1], out);
  if (!s.solved || !s.converged) out.status = Status::kNoSolution;
  return s.solved;
}

void set_impact(const Eigen::Vector2d& before, const Eigen::Vector2d& after, RigidResult& out) {
  out.impact = true;
  out.gap_rate_before = before.x();
  out.slip_before = before.y();
  out.gap_rate_after = after.x();
  out.slip_after = after.y();
}

void impact(const RigidStep& step, const ContactParameters& c, RigidResult& out) {
  ImpactInput in;
  in.admittance = step.impact_admittance;
  in.e_r = out.e_r;
  in.radius = c.radius;
  in.delta = c.clearance;
  in.acceleration = (step.free - step.start) / step.h;
  in.compression_time = c.compression_time;
  in.expansion_time = c.expansion_time;
  // The loads of the whole step are in `free`: what acts during the impact is taken back.
  in.velocity = step.free - in.acceleration * c.impact_time();
  const ImpactResult r = solve_impact(in, c.law());
  if (!take(r.status, r.normal(), r.friction(), out)) return;
  const Eigen::Vector3d after =
      step.free + in.admittance * contact_load(out.e_r, c.radius, out.normal, out.friction);
  set_impact(rates_along(out.e_r, c.radius, step.free), rates_along(out.e_r, c.radius, after), out);
}

// (12), (13): y_N = gap / h at the end of the step, y_T = slip there.
void lasting(const RigidStep& step, const ContactParameters& c, RigidResult& out) {
  const double start = rates_along(out.e_r, c.radius, step.start).y();
  const double free = rates_along(out.e_r, c.radius, step.free).y();
  const Delassus g = delassus(step.lasting_admittance, out.e_r, c.radius);
  const double gap = gap_over_step(step, c);
  const CoulombSolution s = solve_coulomb(g, gap, free, c.friction, start);
  if (take(status_of(s.solutions), s.normal, s.friction, out)) out.mode = mode_of(s);
}

// Both of them beside constraints.
void held_contact(bool impact, const RigidStep& step, const ContactParameters& c,
                  StepResponse& held, RigidResult& out) {
  const double offset = impact ? 0.0 : gap_over_step(step, c) + out.e_r.dot(step.free.head<2>());
  PlanarResponse response(held, out.e_r, c.radius, impact, offset);
  const ContactVector free = response.rates(step.free);
  const ContactMatrix expected = matrix_of(
      delassus(impact ? step.impact_admittance : step.lasting_admittance, out.e_r, c.radius));
  const ImpactLaw law = c.law();
  const ConstrainedContact s =
      (impact ? solve_constrained_impact : solve_constrained)(response, free, expected, {&law, 1});
  if (!take(s, out)) return;
  if (impact) set_impact(free, s.after, out);
  if (!impact || s.lasts[0]) out.mode = mode_of(out.normal, s.sticks[0]);
}

}  // namespace

bool reaches_ring(const RigidStep& step, double clearance) {
  return end_of(step).squaredNorm() > clearance * clearance;
}

Eigen::Vector2d contact_normal(const RigidStep& step, double clearance) {
  return normal_of_path(step.d, end_of(step) - step.d,
                        clearance);  // its bend may close what its rate opens
}

bool is_impact(const RigidStep& step, const Eigen::Vector2d& e_r, const ContactParameters& c) {
  const double closing = e_r.dot(step.free.head<2>());
  if (step.was_in_contact || closing <= 0.0) return false;
  Eigen::Vector3d acceleration = (step.free - step.start) / step.h;
  acceleration.head<2>() += 2.0 / (step.h * step.h) * step.bend;
  const double pressed = pressing(e_r, step.free, acceleration, c.clearance);
  return rebound_outlives_steps(step.h, c.restitution, closing, pressed);
}

// A depth that is there already (a start inside the ring's wall) is not thrown out in one step, as
// it would come back as speed: kRecovery of it is, and no faster than by kRecoveryRate and
//   kRecoveryShare, so that a deep start gains no energy to speak of.
double gap_over_step(const RigidStep& step, const ContactParameters& c) {
  constexpr double kRecovery = 0.2;        // share of a depth undone in a step, in (0, 1]
  constexpr double kRecoveryRate = 2.0;    // 1/s, in clearances
  constexpr double kRecoveryShare = 0.01;  // of the speed that is there
  const double gap = c.clearance - end_of(step).norm();
  const double depth = std::max(0.0, step.d.norm() - c.clearance);
  const double recovery = kRecovery * depth / step.h;
  const double fastest = kRecoveryRate * c.clearance + kRecoveryShare * step.free.head<2>().norm();
  if (recovery > fastest) return (gap + depth) / step.h - fastest;
  return (gap + (1.0 - kRecovery) * depth) / step.h;
}

RigidResult solve_rigid_step(const RigidStep& step, const ContactParameters& contact,
                             StepResponse* held) {
  RigidResult out;
  out.e_r = contact_normal(step, contact.clearance);
  const bool hits = is_impact(step, out.e_r, contact);
  if (held) {
    held_contact(hits, step, contact, *held, out);
  } else {
    (hits ? impact : lasting)(step, contact, out);
  }
  return out;
}

}  // namespace rotorub
