#include "compare/measured/alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotorub {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::string span_text(double from, double to) {
  return fmt::format("{:.6g} to {:.6g} s", from, to);
}

std::string channels_text(const std::vector<std::string>& by) {
  if (by.size() < 2) return fmt::format("{}", fmt::join(by, ""));
  return fmt::format("{} and {}", fmt::join(by.begin(), by.end() - 1, ", "), by.back());
}

// One search with the angle free or held.
struct Search {
  const MeasuredRecord& record;
  const SampledRun& run;
  const std::vector<Channel>& channels;

  struct Found {
    Alignment alignment;
    double own_effect = 0.0;  // of the shift, that no turn explains, as a share
    std::size_t values = 0;   // real numbers fitted
  };

  Found with(std::optional<double> shift, std::optional<double> angle) const {
    Found found;
    Alignment& a = found.alignment;
    a.shift_found = !shift;
    a.shift = shift ? *shift : best_shift(angle, a.next);
    const Fitting fitting(run, channels, record.interval, a.shift, 0.0, angle);
    const Fit fit = fitting.at(a.shift);
    a.angle = fit.angle;
    a.correlation = fit.correlation();
    if (fit.run.norm() > 0.0) a.residual = fit.left().norm() / fit.run.norm();
    const Fitting::Effects g = fitting.effects(fit, a.shift);
    const double across = g.ee > 0.0 ? g.de / g.ee : 0.0;
    found.own_effect = g.dd > 0.0 ? (g.dd - across * g.de) / g.dd : 0.0;
    found.values = fitting.values();
    if (!shift && !angle && found.own_effect < kNearCircle) a.turn_for_shift = -across;
    if (!shift) a.shift_error = fitting.error(g.d - across * g.e, fit);
    const double along = shift || !(g.dd > 0.0) ? 0.0 : g.de / g.dd;
    if (!angle) a.angle_error = fitting.error(g.e - along * g.d, fit);
    return found;
  }

  double best_shift(std::optional<double> angle, std::optional<LagScore>& next) const {
    const BestLags lags = best_lags(record, run, channels, angle);
    const LagScore& best = lags.best;
    if (best.correlation < kLeastCorrelation) {
      throw MeasuredError(fmt::format(
          "no shift makes the record like the native run: the best, {:+.6g} s, has a correlation "
          "of {:.2f} in {}, {} or more is accepted; another scene than was measured, other units, "
          "or chaos; --measured-shift lays it in where it is given",
          best.shift, best.correlation, channels_text(names()), kLeastCorrelation));
    }
    next = lags.next;
    const double room = std::max(lags.apart, record.interval);
    const Fitting wide(run, channels, record.interval, best.shift, room, angle);
    return wide.values() < kLeastSamples ? best.shift : wide.refined(best.shift, lags.apart);
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const Channel& c : channels) all.push_back(c.name());
    return all;
  }
};

void check_overlap(const MeasuredRecord& record, const SampledRun& run, double shift) {
  const double slack = 1e-6 * record.interval;
  const auto on = std::count_if(record.t.begin(), record.t.end(), [&](double t) {
    return t + shift >= run.start() - slack && t + shift <= run.end() + slack;
  });
  if (static_cast<std::size_t>(on) >= kLeastSamples) return;
  throw MeasuredError(
      fmt::format("with the shift of {:+.6g} s the record spans {}, the run {}: {} samples in "
                  "common, {} or more are accepted",
                  shift, span_text(record.t.front() + shift, record.t.back() + shift),
                  span_text(run.start(), run.end()), on, kLeastSamples));
}

// The free angle leaves no less than an angle of 0 does, but for what it takes up of noise: of
// white noise one more unknown takes chi^2 of one degree of freedom; and next to nothing is
// nothing.
bool no_better(const Search::Found& free, const Alignment& held) {
  constexpr double kSure = 25.0;     // of chi^2: five standard deviations
  constexpr double kNothing = 1e-6;  // of the run's rms
  if (!free.alignment.residual || !held.residual || *held.residual < kNothing) return true;
  const double least = *free.alignment.residual * *free.alignment.residual,
               with_0 = *held.residual * *held.residual;
  return with_0 - least <=
         kSure * least / static_cast<double>(std::max<std::size_t>(free.values, 1));
}

double left_by(double correlation) {
  return std::sqrt(std::max(0.0, 1.0 - correlation * correlation));
}

}  // namespace

bool Alignment::ambiguous() const {
  if (!next || !correlation) return false;
  return left_by(next->correlation) < std::max(kTwice * left_by(*correlation), kNextToNothing);
}

Alignment align(const MeasuredRecord& record, const SampledRun& run,
                const AlignmentOptions& options) {
  if (options.shift) check_overlap(record, run, *options.shift);
  const std::vector<Channel> channels = channels_of(record, run, options.angle.value_or(0.0));
  const bool pair =
      std::any_of(channels.begin(), channels.end(), [](const Channel& c) { return c.pair; });
  if (channels.empty()) {
    if (!options.shift) {
      throw MeasuredError(
          "nothing that both the record and the native run move in: no shift can be found; "
          "--measured-shift lays it in where it is given");
    }
    Alignment told;
    told.shift = *options.shift;
    told.angle = options.angle.value_or(0.0);
    told.shift_found = false;
    told.angle_from = options.angle ? AngleFrom::kGiven : AngleFrom::kNoPair;
    return told;
  }
  const Search search{record, run, channels};
  const bool finds_angle = pair && !options.angle;
  const Search::Found free = search.with(
      options.shift, finds_angle ? std::nullopt : std::optional(options.angle.value_or(0.0)));
  Alignment found = free.alignment;
  found.angle_from = options.angle ? AngleFrom::kGiven
                     : pair        ? AngleFrom::kFound
                                   : AngleFrom::kNoPair;
  if (finds_angle && !options.shift && free.own_effect < kLeastOwnEffect) {
    Alignment held = search.with(options.shift, 0.0).alignment;
    if (no_better(free, held)) {
      found = std::move(held);
      found.angle_from = AngleFrom::kCircle;
    }
  }
  found.by = search.names();
  check_overlap(record, run, found.shift);
  return found;
}

std::string alignment_text(const Alignment& a) {
  // Without the sign of a zero that rounding makes.
  const auto rounded_to = [](double value, double unit) {
    return std::round(value / unit) * unit + 0.0;
  };
  const auto error = [](const std::optional<double>& e, double unit, const char* name) {
    return e ? fmt::format(" ± {:.3g}{}", *e / unit, name) : std::string();
  };
  std::string text =
      fmt::format("shift {:+.6f} ms{}{}", rounded_to(1e3 * a.shift, 1e-6),
                  a.shift_found ? "" : " as given", error(a.shift_error, 1e-6, " µs"));
  text += fmt::format(", sensors' x axis at {:+.3f}°", rounded_to(a.angle / kDegree, 1e-3));
  switch (a.angle_from) {
    case AngleFrom::kGiven:
      text += " as given";
      break;
    case AngleFrom::kFound:
      text += error(a.angle_error, kDegree, "°");
      break;
    case AngleFrom::kNoPair:
      text += " taken: no x with its y is measured";
      break;
    case AngleFrom::kCircle:
      text +=
          " taken: the motion is a circle, in which a turn of the frame looks like a shift "
          "(--measured-angle tells it)";
      break;
  }
  if (a.by.empty()) return text + "; nothing moves in both: nothing says how well it fits";
  text +=
      fmt::format("; by {}: correlation {:.4f}", channels_text(a.by), a.correlation.value_or(0.0));
  if (a.residual) text += fmt::format(", left {:.3g} % of the run's rms", 100.0 * *a.residual);
  if (a.turn_for_shift) {
    text += fmt::format(
        "; so near to a circle that {:+.3g}° of the angle make up for 10 µs of the shift: tell one "
        "of them, if it is known",
        1e-5 * *a.turn_for_shift / kDegree);
  }
  if (a.ambiguous()) {
    text += fmt::format("; ambiguous: {:+.6f} ms fits nearly as well (correlation {:.4f})",
                        1e3 * a.next->shift, a.next->correlation);
  } else if (a.next) {
    text += fmt::format("; next best {:+.3f} ms (correlation {:.3f})", 1e3 * a.next->shift,
                        a.next->correlation);
  }
  return text;
}

}  // namespace rotorub
