#include "compare/bench/point.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace rotorub::bench {

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::kOk:
      return "ok";
    case Outcome::kChatter:
      return "chatter";
    case Outcome::kWrongAttractor:
      return "wrong_attractor";
    case Outcome::kDiverged:
      return "diverged";
    case Outcome::kRefused:
      return "refused";
  }
  return "";
}

PointErrors point_errors(const Trajectory& trajectory, const Reference& reference) {
  assert(trajectory.rows() == reference.trajectory.rows());
  PointErrors e;
  e.position = position_distance(trajectory, reference.trajectory);

  // At an impact a force is no number, and beside one a row of a fixed step says little: rows where
  // the reference presses are those of lasting contact.
  const auto& force = trajectory.column("normal_force");
  const auto& exact = reference.trajectory.column("normal_force");
  double off = 0.0, sum = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    if (exact[k] <= 0.0) continue;
    off += std::abs(force[k] - exact[k]);
    sum += exact[k];
  }
  if (sum > 0.0) e.force = off / sum;

  const double impulse = reference.trajectory.statistics.impulse_total;
  if (impulse > 0.0) {
    e.impulse = std::abs(trajectory.statistics.impulse_total - impulse) / impulse;
  }
  return e;
}

Judgement judge(const Trajectory& trajectory, const Settled& settled, const Settled& reference,
                double clearance) {
  if (trajectory.status == Status::kStepTooLarge) return {Outcome::kRefused, trajectory.message};
  if (trajectory.status != Status::kOk) {
    return {Outcome::kDiverged,
            fmt::format("{} at t = {:.6g} s: {}", rotorub::to_string(trajectory.status),
                        trajectory.end, trajectory.message)};
  }
  const double depth = trajectory.statistics.max_penetration;
  if (depth > kLost * clearance) {
    return {Outcome::kDiverged,
            fmt::format("the rotor has been {:.3g} m deep in a ring with a clearance of {:.3g} m",
                        depth, clearance)};
  }
  const auto said = [&](const char* what) {
    return fmt::format(
        "{}: {} (in contact {:.3g} % of the last fifth, whirl {:.5g} rad/s) where the "
        "reference has {} ({:.3g} %, {:.5g} rad/s)",
        what, rotorub::to_string(settled.attractor), 100.0 * settled.contact_share,
        settled.whirl_frequency, rotorub::to_string(reference.attractor),
        100.0 * reference.contact_share, reference.whirl_frequency);
  };
  if (settled.attractor != reference.attractor) {
    const bool bounces = settled.attractor == Attractor::kChattering;
    return bounces ? Judgement{Outcome::kChatter, said("it chatters")}
                   : Judgement{Outcome::kWrongAttractor, said("another attractor")};
  }
  // The same name at another frequency is another attractor too: two whips, two rolls.
  const bool whirls = reference.attractor == Attractor::kBackwardWhip ||
                      reference.attractor == Attractor::kForwardRub ||
                      reference.attractor == Attractor::kRolling;
  const double apart = std::abs(settled.whirl_frequency - reference.whirl_frequency);
  if (whirls && apart > kWhirlTolerance * std::abs(reference.whirl_frequency)) {
    return {Outcome::kWrongAttractor, said("another whirl")};
  }
  return {};
}

double Point::us_per_step() const {
  return steps > 0 ? 1e6 * wall.median / static_cast<double>(steps) : 0.0;
}

double Point::real_time_factor() const { return wall.median > 0.0 ? end / wall.median : 0.0; }

}  // namespace rotorub::bench
