#include "native_model/event/coupled_impact.h"

#include <algorithm>

namespace rotorub {
namespace {

// Of the approach: a gap rate that round-off left of 0. Where all rebound alike a resting contact
// stays at rest exactly.
constexpr double kNoRate = 1e-12;

}  // namespace

CoupledImpactOutcome coupled_impact(const Model& m, const EventParameters& parameters,
                                    std::span<const ClosedContact> closed, Motion& motion,
                                    Constraint& constraint, Observer& observer) {
  const std::size_t n = closed.size();
  std::array<ImpactLaw, kMaxContacts> laws;
  ContactVector before(static_cast<Eigen::Index>(2 * n));
  double approach = 0.0;
  bool takes_time = false;  // and comes here where it does not rebound
  for (std::size_t i = 0; i < n; ++i) {
    const ContactParameters& contact = *m.auxiliary[closed[i].index].contact;
    laws[i] = contact.law();
    takes_time = takes_time || contact.impact_time() > 0.0;
    before.segment<2>(static_cast<Eigen::Index>(2 * i)) << closed[i].point.gap_rate,
        closed[i].point.slip;
    approach = std::max(approach, -closed[i].point.gap_rate);
  }
  // Where an accumulation ends no contact rebounds: neither the one that closes nor those that it
  // would knock open.
  if (takes_time || approach < parameters.zeno_velocity_threshold) {
    for (ImpactLaw& law : laws) law = {law.friction, 0.0, 0.0};
  }
  const CoupledSolution solved = solve_coupled_impact(delassus(m, motion.t, motion.q(), closed),
                                                      before, std::span(laws).first(n));
  CoupledImpactOutcome out;
  out.status = status_of(solved.solutions);
  if (out.status != Status::kOk) return out;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    const double normal = solved.p[at], friction = solved.p[at + 1];
    out.rests[i] = solved.y[at] <= kNoRate * approach;
    out.stuck[i] = solved.sticks[i] && solved.y[at + 1] == 0.0;
    out.struck[i] = normal > 0.0;
    if (!out.struck[i]) continue;
    constraint.apply(motion, closed[i].point.e_r, normal, friction, closed[i].index);
    Impact record;
    record.t = motion.t;
    record.contact = static_cast<int>(closed[i].index);
    record.gap_rate_before = before[at];
    record.slip_before = before[at + 1];
    record.gap_rate_after = solved.y[at];
    record.slip_after = solved.y[at + 1];
    observer.account(record, normal, friction, {before[at], before[at + 1]},
                     {solved.y[at], solved.y[at + 1]});
    observer.record_impact(record);
  }
  return out;
}

}  // namespace rotorub
