#include "compare/check/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rotorub::check {
namespace {

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

}  // namespace

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::kPass:
      return "pass";
    case Outcome::kRefused:
      return "refused";
    case Outcome::kViolates:
      return "violates";
  }
  return "";
}

Verdict limited(const std::string& metric, double value, std::optional<double> min,
                std::optional<double> max) {
  Verdict verdict;
  verdict.rule = rule_text(metric, min, max);
  verdict.value = value;
  const bool under = min && !(value >= *min), over = max && !(value <= *max);
  // Within: the nearer one.
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

}  // namespace rotorub::check
