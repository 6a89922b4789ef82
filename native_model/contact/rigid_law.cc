#include "native_model/contact/rigid_law.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/circle.h"
#include "native_model/contact/constrained_law.h"
#include "native_model/contact/coulomb.h"
#include "native_model/contact/impact_map.h"
#include "native_model/contact/rebound.h"

namespace rotorub {
namespace {

Eigen::Vector2d tangent(const Eigen::Vector2d& e_r) { return {-e_r.y(), e_r.x()}; }

double slip(const Eigen::Vector2d& e_r, double radius, const Eigen::Vector3d& velocity) {
  return tangent(e_r).dot(velocity.head<2>()) + radius * velocity.z();
}

// The response along normal and tangent.
class PlanarResponse final : public ContactResponse {
 public:
  // offset: m/s, of the normal law, y_N = gdot_N + offset.
  PlanarResponse(StepResponse& step, const Eigen::Vector2d& e_r, double radius, bool impact,
                 double offset)
      : step_(step), e_r_(e_r), radius_(radius), impact_(impact), offset_(offset) {}
  ContactVector rates(const Eigen::Vector3d& v) const {
    return Eigen::Vector2d(offset_ - e_r_.dot(v.head<2>()), slip(e_r_, radius_, v));
  }
  ContactVector at(const ContactVector& p) override {
    return rates(step_.end(contact_load(e_r_, radius_, p[0], p[1]), impact_));
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

// False: no solution.
bool take(const ConstrainedContact& s, RigidResult& out) {
  out.converged = s.converged;
  if (!s.solved || !s.converged) out.status = Status::kNoSolution;
  if (!s.solved) return false;
  out.normal = s.p[0];
  out.friction = s.p[1];
  return true;
}

void held_impact(const RigidStep& step, const ContactParameters& c, StepResponse& held,
                 RigidResult& out) {
  PlanarResponse response(held, out.e_r, c.radius, true, 0.0);
  const ContactVector before = response.rates(step.free);
  const ImpactLaw law = c.law();
  const ConstrainedContact s = solve_constrained_impact(
      response, before, matrix_of(delassus(step.impact_admittance, out.e_r, c.radius)), {&law, 1});
  if (!take(s, out)) return;
  out.impact = true;
  out.gap_rate_before = before[0];
  out.slip_before = before[1];
  out.gap_rate_after = s.y[0];
  out.slip_after = s.y[1];
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
  if (r.status != Status::kOk) {
    out.status = r.status;
    return;
  }
  out.impact = true;
  out.normal = r.normal();
  out.friction = r.friction();
  const Eigen::Vector3d after =
      step.free + in.admittance * contact_load(out.e_r, c.radius, out.normal, out.friction);
  out.gap_rate_before = -out.e_r.dot(step.free.head<2>());
  out.gap_rate_after = -out.e_r.dot(after.head<2>());
  out.slip_before = slip(out.e_r, c.radius, step.free);
  out.slip_after = slip(out.e_r, c.radius, after);
}

void held_lasting(const RigidStep& step, const ContactParameters& c, StepResponse& held,
                  RigidResult& out) {
  const double offset = gap_over_step(step, c) + out.e_r.dot(step.free.head<2>());
  PlanarResponse response(held, out.e_r, c.radius, false, offset);
  const ContactVector free = response.rates(step.free);
  const ImpactLaw law = c.law();
  const ConstrainedContact s = solve_constrained(
      response, free, matrix_of(delassus(step.lasting_admittance, out.e_r, c.radius)), {&law, 1});
  if (take(s, out)) out.mode = mode_of(out.normal, s.sticks[0]);
}

// (12), (13): y_N = gap / h at the end of the step, y_T = slip there.
void lasting(const RigidStep& step, const ContactParameters& c, RigidResult& out) {
  const double free = slip(out.e_r, c.radius, step.free);
  const CoulombSolution s = solve_coulomb(delassus(step.lasting_admittance, out.e_r, c.radius),
                                          gap_over_step(step, c), free, c.friction.at(free));
  out.status = status_of(s.solutions);
  if (out.status != Status::kOk) return;
  out.normal = s.normal;
  out.friction = s.friction;
  out.mode = mode_of(s);
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

double gap_over_step(const RigidStep& step, const ContactParameters& c) {
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
  if (is_impact(step, out.e_r, contact)) {
    held ? held_impact(step, contact, *held, out) : impact(step, contact, out);
  } else {
    held ? held_lasting(step, contact, *held, out) : lasting(step, contact, out);
  }
  return out;
}

}  // namespace rotorub
