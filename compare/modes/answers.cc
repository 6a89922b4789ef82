#include "compare/modes/answers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/units.h"
#include "compare/modes/levitation_text.h"
#include "compare/modes/whirl_tables.h"

namespace rotorub {
namespace {

using result::Part, result::Sentence;

// Empty without a critical speed.
std::string critical_text(const RotorAnalysis& analysis, double speed) {
  if (analysis.critical_speeds.empty()) return "";
  const double running = std::abs(speed);
  const auto nearest = std::ranges::min_element(
      analysis.critical_speeds, {}, [&](double critical) { return std::abs(critical - running); });
  const auto at = static_cast<std::size_t>(nearest - analysis.critical_speeds.begin());
  // A film damps so strongly that the response may peak at another speed, or not at all.
  const std::string critical = fmt::format("{} rpm ({}{})", grouped(*nearest * kRpm),
                                           to_string(analysis.critical_senses[at]),
                                           analysis.system.films.empty() ? "" : ", undamped");
  if (running == 0.0) return fmt::format("The first critical speed is {}.", critical);
  const double share = *nearest / running - 1.0;
  std::string text = fmt::format("The critical speed nearest to {} rpm is {}, {:.3g} % {} it",
                                 grouped(running * kRpm), critical, 100.0 * std::abs(share),
                                 share < 0.0 ? "below" : "above");
  const auto& margin = analysis.margin;
  if (!margin || margin->critical != *nearest || margin->speed != running) return text + ".";
  return text + (margin->required
                     ? fmt::format("; API 617 requires {:.3g} % (AF {:.3g}).",
                                   100.0 * *margin->required, margin->amplification)
                     : fmt::format("; API 617 requires no margin, because the peak is critically "
                                   "damped (AF {:.2g}).",
                                   margin->amplification));
}

// The free orbit at a contact, after a loss if there is one; empty if it is unknown.
std::string orbit_text(const ContactPlace& place, const RotorResponse& response) {
  const auto& orbit = response.all.orbits[place.bearing].largest;
  if (!orbit) return "";
  const double share = *orbit / place.clearance;
  return fmt::format("The free orbit at {}{} reaches {:.4g} clearances, so {}.",
                     place.name.empty() ? "the contact" : "contact " + place.name,
                     response.before_loss ? ", after the loss," : "", share,
                     share < 1.0 ? "the rotor need not touch" : "contact is unavoidable");
}

const char* kind_text(rub::RubKind kind) {
  switch (kind) {
    case rub::RubKind::kForced:
      return "synchronous rub";
    case rub::RubKind::kWhip:
      return "backward whip";
    case rub::RubKind::kRolling:
      break;
  }
  return "rolling";
}

std::string rubs_text(const RubAnalyses& rubs, const RubAnalysis& at) {
  std::vector<std::string> stable;
  for (const rub::StandingRub& r : at.point.rubs) {
    if (!r.stability.stable) continue;
    stable.push_back(fmt::format("{} at {} N{}", kind_text(r.rub.kind),
                                 short_number(r.rub.normal_force),
                                 at.is_above_modes(r.rub.whirl) ? " (not reliable, see *)" : ""));
  }
  const std::string where = rubs.contact.empty() ? "" : fmt::format(" at contact {}", rubs.contact);
  if (stable.empty()) return fmt::format("No lasting rub{} is stable.", where);
  return fmt::format("Stable rub{}{}: {}.", stable.size() > 1 ? "s" : "", where,
                     fmt::join(stable, ", "));
}

// A sentence without full stop on the ranges of speed in which a whirl grows.
std::string stability_text(const RotorAnalysis& analysis) {
  if (!analysis.unstable.empty()) {
    std::vector<std::string> ranges;
    for (const auto& [from, to] : analysis.unstable) {
      ranges.push_back(std::isinf(to)
                           ? "above " + speed_text(from)
                           : fmt::format("from {} to {} rpm ({} to {} rad/s)", grouped(from * kRpm),
                                         grouped(to * kRpm), grouped(from), grouped(to)));
    }
    return fmt::format("unstable {}", fmt::join(ranges, " and "));
  }
  if (std::isinf(analysis.stability_bound)) return "stable at all speeds";
  return "stable up to " + speed_text(analysis.stability_bound);
}

}  // namespace

std::vector<Part> stability_parts(const RotorAnalysis& analysis) {
  std::vector<std::string> sentences;
  bool has_control = false;
  for (std::size_t k = 0; k < analysis.levitations.size(); ++k) {
    if (!has_loop(analysis.levitations[k])) continue;
    has_control = true;
    const std::string text = instability_text(analysis.spectra[k].speed, analysis.levitations[k]);
    if (!text.empty() && (sentences.empty() || sentences.back() != text)) sentences.push_back(text);
  }
  if (sentences.empty()) {
    const std::string text = stability_text(analysis);
    sentences.push_back(
        has_control ? "Whirl without integrators, filters, amplifiers and sampling: " + text +
                          ". The poles include them."
                    : text);
  }
  std::vector<Part> parts{
      result::Data{"stability_threshold", number_or_null(analysis.stability_threshold())},
      result::Data{"stability_bound", number_or_null(analysis.stability_bound)},
      result::Data{"unstable_ranges", ranges_json(analysis.unstable)}, result::line("")};
  for (const std::string& sentence : sentences) parts.push_back(Sentence{.text = sentence});
  return parts;
}

std::string grouped(double value) {
  constexpr double kLeast = 1e4, kMost = 1e15;  // shorter numbers need no groups
  const double size = std::abs(value);
  if (!(size >= kLeast && size < kMost)) return short_number(value);
  const double last = std::pow(10.0, std::floor(std::log10(size)) - 3.0);
  std::string digits = fmt::format("{:.0f}", std::round(size / last) * last);
  for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
  return (value < 0.0 ? "-" : "") + digits;
}

std::string speed_text(double speed) {
  return fmt::format("{} rpm ({} rad/s)", grouped(speed * kRpm), grouped(speed));
}

std::vector<Part> summary_parts(const RotorAnalysis& analysis) {
  std::vector<Part> parts;
  const auto add = [&](std::string text) {
    if (!text.empty())
      parts.emplace_back(
          Sentence{.text = std::move(text), .lead = "  ", .indent = 4, .seen = result::kTerminal});
  };
  const bool several = analysis.spectra.size() > 1;
  for (std::size_t at = 0; at < analysis.spectra.size(); ++at) {
    const double speed = analysis.spectra[at].speed;
    if (several) add(fmt::format("At {}:", speed_text(speed)));
    add(critical_text(analysis, speed));
    for (const ContactPlace& place : analysis.contacts)
      add(orbit_text(place, analysis.responses[at]));
    for (const RubAnalyses& rubs : analysis.rubs) {
      if (at < rubs.at.size()) add(rubs_text(rubs, rubs.at[at]));
    }
  }
  return parts;
}

}  // namespace rotorub
