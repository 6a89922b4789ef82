#include "compare/check/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rotorub::check {
namespace {

// Limit of the scaled residuals of adhesion, cone, complementarity and sliding in every run.
constexpr double kResidual = 1e-10;
// Limit of the energy that an impact adds, relative to its impulses times their speeds: round-off.
// Also limits the excess of its impulse over the friction cone.
constexpr double kImpactGain = 1e-12;
// Share of the clearance. Between its rows a run with fixed steps leaves the circle by the
// curvature of one step, and at first touch by the flight of one step. Beyond the clearance it
// would be out of range.
constexpr double kPenetration = 1.0;

std::string rule_text(const std::string& metric, std::optional<double> min,
                      std::optional<double> max) {
  if (min && max) return fmt::format("{:g} <= {} <= {:g}", *min, metric, *max);
  return min ? fmt::format("{} >= {:g}", metric, *min) : fmt::format("{} <= {:g}", metric, *max);
}

// "3.1e-06, over the limit of 1e-09 by 3.1e-06 (3100 times the limit)"
std::string violation_text(const std::string& metric, double value, double limit, bool over) {
  std::string text = fmt::format("{} is {:.6g}, {} {:g} by {:.3g}", metric, value,
                                 over ? "over" : "under", limit, std::abs(value - limit));
  const double times = value / limit;
  if (over && std::isfinite(times) && times >= 2.0) {
    text += fmt::format(" ({:.3g} times as much)", times);
  }
  return text;
}

// Largest energy that an impact adds instead of removing, relative to its own work; 0 if none does.
// All contacts at one instant form one impact.
double largest_gain(const std::vector<Impact>& impacts) {
  double largest = 0.0, t = std::numeric_limits<double>::quiet_NaN(), change = 0.0, size = 0.0;
  for (const Impact& i : impacts) {
    if (i.t != t) change = size = 0.0;
    t = i.t;
    change += i.energy_change;
    size +=
        std::abs(i.normal_impulse) * (std::abs(i.gap_rate_before) + std::abs(i.gap_rate_after)) +
        std::abs(i.friction_impulse) * (std::abs(i.slip_before) + std::abs(i.slip_after));
    const bool whole = &i == &impacts.back() || (&i)[1].t != t;
    if (whole && change > 0.0) largest = std::max(largest, change / std::max(size, 1e-300));
  }
  return largest;
}

// Largest excess |Lambda_T| - mu Lambda_N, relative to Lambda_N, with the mu of each contact; a
// pulling impulse counts as 1.
double largest_impulse_residual(const std::vector<Impact>& impacts,
                                const std::vector<ContactFacts>& contacts) {
  double largest = 0.0;
  for (const Impact& i : impacts) {
    if (i.normal_impulse < 0.0) return 1.0;
    const FrictionLaw& friction = contacts[static_cast<std::size_t>(i.contact)].friction;
    const double mu = friction.bound(std::max(std::abs(i.slip_before), std::abs(i.slip_after)));
    const double beyond = std::abs(i.friction_impulse) - mu * i.normal_impulse;
    if (beyond > 0.0) largest = std::max(largest, beyond / std::max(i.normal_impulse, 1e-300));
  }
  return largest;
}

}  // namespace

const char* to_string(Outcome outcome) {
  return std::array{"pass", "refused", "violates"}.at(static_cast<std::size_t>(outcome));
}

Verdict limited(const std::string& metric, double value, std::optional<double> min,
                std::optional<double> max) {
  Verdict verdict;
  verdict.rule = rule_text(metric, min, max);
  verdict.value = value;
  const bool under = min && !(value >= *min), over = max && !(value <= *max);
  // If the value is within, the nearer limit.
  const bool near_max = max && (!min || std::abs(*max - value) <= std::abs(value - *min));
  verdict.limit = over ? max : under ? min : near_max ? max : min;
  if (!under && !over) return verdict;
  verdict.outcome = Outcome::kViolates;
  verdict.reason = std::isnan(value) ? metric + " is not a number"
                                     : violation_text(metric, value, *verdict.limit, over);
  return verdict;
}

double excess(const Verdict& verdict) {
  if (verdict.outcome != Outcome::kViolates) return 0.0;
  if (!verdict.value || !verdict.limit || !std::isfinite(*verdict.value)) {
    return std::numeric_limits<double>::infinity();
  }
  return std::abs(*verdict.value - *verdict.limit) / std::max(std::abs(*verdict.limit), 1e-300);
}

Verdict finite_verdict(const Trajectory& trajectory) {
  Verdict verdict;
  verdict.rule = "every value finite";
  const auto fail = [&](const std::string& what) {
    verdict.outcome = Outcome::kViolates;
    verdict.reason = what + " is not finite";
    return verdict;
  };
  for (const Column& column : trajectory.series) {
    const auto finite = [](double x) { return std::isfinite(x); };
    if (!std::all_of(column.values.begin(), column.values.end(), finite)) return fail(column.name);
  }
  for (const Impact& i : trajectory.impacts) {
    if (!std::isfinite(i.t + i.normal_impulse + i.friction_impulse + i.gap_rate_before +
                       i.gap_rate_after + i.slip_before + i.slip_after + i.energy_change)) {
      return fail("an impact");
    }
  }
  return verdict;
}

std::vector<Verdict> law_verdicts(const Trajectory& trajectory,
                                  const std::vector<ContactFacts>& contacts, bool exact_rows) {
  std::vector<Verdict> verdicts{finite_verdict(trajectory)};
  if (contacts.empty() || verdicts.front().outcome != Outcome::kPass) return verdicts;
  const auto add = [&](const char* metric, double value, double limit) {
    verdicts.push_back(limited(metric, value, std::nullopt, limit));
  };
  const Residuals r = largest_residuals(trajectory, contacts);
  add("impact energy gain", largest_gain(trajectory.impacts), kImpactGain);
  add("impact cone", largest_impulse_residual(trajectory.impacts, contacts), kImpactGain);
  add("residual.adhesion", r.adhesion, kResidual);
  add("residual.cone", r.cone, kResidual);
  const auto narrower = [](const ContactFacts& a, const ContactFacts& b) {
    return a.clearance < b.clearance;
  };
  const double clearance = std::min_element(contacts.begin(), contacts.end(), narrower)->clearance;
  add("max_penetration", trajectory.statistics.max_penetration, kPenetration * clearance);
  if (exact_rows) {
    add("residual.complementarity", r.complementarity, kResidual);
    add("residual.sliding", r.sliding, kResidual);
  }
  return verdicts;
}

}  // namespace rotorub::check
