#include "compare/measured/alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotorub {
namespace {

constexpr double kNothing = 1e-6;  // relative to the run's rms
constexpr double kDegree = std::numbers::pi / 180.0;

// Avoids a negative zero.
double rounded_to(double value, double unit) { return std::round(value / unit) * unit + 0.0; }

std::string span_text(double from, double to) {
  return fmt::format("{:.6g} to {:.6g} s", from, to);
}

double left_by(double likeness) { return std::sqrt(std::max(0.0, 1.0 - likeness * likeness)); }

bool nearly_as_well(double next, double best) {
  return left_by(next) < std::max(kTwice * left_by(best), kNextToNothing);
}

// Whether much remains and another shift is more alike except for the size.
bool is_better_shape(const Alignment& a) {
  constexpr double kMuch = 0.5;
  if (!a.other_size || a.residual.value_or(0.0) < kMuch) return false;
  const double own = left_by(*a.correlation);
  return own > kNextToNothing && kTwice * left_by(a.other_size->correlation) < own;
}

// A search with the angle free or given.
struct Search {
  const MeasuredRecord& record;
  const SampledRun& run;
  const std::vector<Channel>& channels;

  struct Found {
    Alignment alignment;
    bool tells_angle = false;  // whether a free angle is determined
  };

  Found with(std::optional<double> shift, std::optional<double> angle) const {
    Found found;
    Alignment& a = found.alignment;
    a.shift_found = !shift;
    a.shift = shift ? *shift : best_shift(angle, a);
    const Fitting fitting(run, channels, record.interval, a.shift, 0.0, angle);
    const Fit fit = fitting.at(a.shift);
    a.angle = fit.angle;
    a.correlation = fit.correlation();
    if (fit.run.norm() > 0.0) {
      a.residual = fit.left().norm() / fit.run.norm();
      a.gain = fit.gain();
    }
    if (!is_better_shape(a)) a.other_size = std::nullopt;
    const Fitting::Effects g = fitting.effects(fit, a.shift);
    const double across = g.ee > 0.0 ? g.de / g.ee : 0.0;
    const double own_effect = g.dd > 0.0 ? (g.dd - across * g.de) / g.dd : 0.0;
    if (!shift && !angle && own_effect < kNearCircle) a.turn_for_shift = -across;
    if (!shift) a.shift_error = fitting.error(g.d - across * g.e, fit);
    const double along = shift || !(g.dd > 0.0) ? 0.0 : g.de / g.dd;
    if (angle) return found;
    const Eigen::VectorXcd turn = g.e - along * g.d;
    a.angle_error = fitting.error(turn, fit);
    // Without noise, the remaining difference and the curvature come only from interpolating
    // between the run's rows.
    const double rows = kNothing * fit.run.norm() / std::max(turn.norm(), 1e-300);
    found.tells_angle = a.angle_error && std::hypot(*a.angle_error, rows) < kAngleTold;
    return found;
  }

  double best_shift(std::optional<double> angle, Alignment& a) const {
    const BestLags lags = best_lags(record, run, channels, angle);
    const LagScore& best = lags.best;
    a.next = lags.next;
    a.other_size = lags.most_correlated;
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
      fmt::format("with a shift of {:+.6g} s the record spans {} and the run {}, so they have "
                  "{} samples in common, but at least {} are needed",
                  shift, span_text(record.t.front() + shift, record.t.back() + shift),
                  span_text(run.start(), run.end()), on, kLeastSamples));
}

// "rotor, ring and gap"
std::string channels_text(const std::vector<std::string>& by) {
  if (by.size() < 2) return fmt::format("{}", fmt::join(by, ""));
  return fmt::format("{} and {}", fmt::join(by.begin(), by.end() - 1, ", "), by.back());
}

std::string other_size_text(const LagScore& at) {
  return fmt::format(
      "at {:+.3f} ms they agree better in shape (correlation {:.4f}), but the record is {:.3g} "
      "times "
      "as large; check its unit",
      1e3 * at.shift, at.correlation, at.gain);
}

std::string mirrored_text(const Mirrored& m) {
  constexpr double kExchanged = 1.0;  // degrees
  const double angle = m.angle / kDegree;
  const bool exchanged = std::abs(std::abs(angle) - 90.0) < kExchanged;
  return fmt::format(
      "with {} the record would fit: shift {:+.6f} ms, sensors' x axis at {:+.3f}°, residual "
      "{:.3g} % of the run's rms; if the machine does not whirl the other way than the run, give "
      "{}",
      exchanged ? "x and y of the sensors exchanged" : "y of the sensors mirrored",
      rounded_to(1e3 * m.shift, 1e-6), rounded_to(angle, 1e-3), 100.0 * m.residual, m.flag);
}

// Why an alignment that was found is refused and what is accepted; otherwise empty.
std::string doubt(const Alignment& a) {
  if (!a.correlation) return {};
  if (*a.correlation < kLeastCorrelation) {
    return fmt::format(
        "no shift makes the record agree with the native run: the best shift, {:+.6g} s, has a "
        "correlation of {:.2f} in {}, but at least {} is needed; the scene or the units may be "
        "wrong, or the motion is chaotic",
        a.shift, *a.correlation, channels_text(a.by), kLeastCorrelation);
  }
  if (!a.residual || *a.residual <= kMostLeft * std::min(1.0, *a.gain)) return {};
  return fmt::format(
      "no shift makes the record agree with the native run: the best shift, {:+.6g} s, has a "
      "correlation of {:.2f} in {}, but leaves a residual of {:.3g} % of the run's rms, because "
      "the record moves {:.3g} times as far as the run; the residual may be at most {:.0f} % of "
      "the "
      "motion of either; the scene or the units may be wrong",
      a.shift, *a.correlation, channels_text(a.by), 100.0 * *a.residual, *a.gain,
      100.0 * kMostLeft);
}

std::optional<Alignment> taken(const MeasuredRecord& record, const SampledRun& run,
                               const AlignmentOptions& options) {
  try {
    return best_alignment(record, run, options);
  } catch (const MeasuredError&) {
    return std::nullopt;
  }
}

// The alignment with y of each pair reversed, if it leaves less than half of `left`.
std::optional<Mirrored> mirrored(MeasuredRecord record, const SampledRun& run,
                                 std::optional<double> shift, double left) {
  bool pair = false;
  for (MeasuredColumn& y : record.columns) {
    if (y.what->axis != Axis::kY || !record.find(other_axis(*y.what).name)) continue;
    pair = true;
    for (double& value : y.value) value = -value;
  }
  if (!pair) return std::nullopt;
  const auto a = taken(record, run, {shift, std::nullopt});
  if (!a || !doubt(*a).empty() || !a->residual || kTwice * *a->residual > left) return std::nullopt;
  const auto degrees = [&](double probe) {
    const double turn = std::remainder(a->angle - probe, 2.0 * std::numbers::pi);
    return std::round(1e4 * turn * 180.0 / std::numbers::pi) / 1e4 + 0.0;  // avoids -0
  };
  return Mirrored{a->shift, a->angle, *a->residual,
                  fmt::format("--measured-probes={:g}deg,{:g}deg", degrees(record.probe_x),
                              degrees(record.probe_y))};
}

// Whether an angle of 0 leaves as little as a free one, apart from noise.
bool no_better(const Alignment& free, const Alignment& held) {
  if (!free.residual || !held.residual) return true;
  return *held.residual <= std::max(kTwice * *free.residual, kNothing);
}

constexpr double kAsFar = 1.5;  // size ratios beyond this factor, or its inverse, are mentioned

}  // namespace

bool Alignment::ambiguous() const {
  if (!next || !correlation) return false;
  const LagScore own{shift, *correlation, gain.value_or(1.0)};
  return nearly_as_well(next->correlation, own.correlation) &&
         nearly_as_well(next->likeness(), own.likeness());
}

Alignment best_alignment(const MeasuredRecord& record, const SampledRun& run,
                         const AlignmentOptions& options) {
  if (options.shift) check_overlap(record, run, *options.shift);
  const std::vector<Channel> channels = channels_of(record, run, options.angle.value_or(0.0));
  const bool pair =
      std::any_of(channels.begin(), channels.end(), [](const Channel& c) { return c.pair; });
  if (channels.empty()) {
    if (!options.shift) {
      throw MeasuredError(
          "no measured quantity moves both in the record and in the native run, so no shift can be "
          "found; give it with --measured-shift");
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
  if (finds_angle && !options.shift && !free.tells_angle) {
    Alignment held = search.with(options.shift, 0.0).alignment;
    if (no_better(free.alignment, held)) {
      found = std::move(held);
      found.angle_from = AngleFrom::kCircle;
    }
  }
  found.by = search.names();
  check_overlap(record, run, found.shift);
  return found;
}

Alignment align(const MeasuredRecord& record, const SampledRun& run,
                const AlignmentOptions& options) {
  Alignment found = best_alignment(record, run, options);
  const std::string reason = doubt(found);
  if (found.residual && *found.residual > kNextToNothing) {
    double left = *found.residual;
    // With a wrong given angle the record would seem mirrored, so a free angle is tried as well.
    const auto free = options.angle ? taken(record, run, {options.shift, {}}) : std::nullopt;
    if (free && free->residual) left = std::min(left, *free->residual);
    found.mirrored = mirrored(record, run, options.shift, left);
  }
  if (reason.empty() || options.shift) return found;
  std::string told = reason + "; ";
  if (found.other_size) told += other_size_text(*found.other_size) + "; ";
  if (found.mirrored) told += mirrored_text(*found.mirrored) + "; ";
  throw MeasuredError(told + "to compare them anyway, give the shift with --measured-shift");
}

std::string alignment_text(const Alignment& a) {
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
      text += " assumed, because no x is measured together with its y";
      break;
    case AngleFrom::kCircle:
      text +=
          " assumed, because the motion is a circle to within the residual, so a turn of the frame "
          "looks like a shift (if you know the angle, give --measured-angle)";
      break;
  }
  if (a.by.empty()) return text + "; the fit cannot be judged, because nothing moves in both";
  text +=
      fmt::format("; by {}: correlation {:.4f}", channels_text(a.by), a.correlation.value_or(0.0));
  if (a.residual) text += fmt::format(", residual {:.3g} % of the run's rms", 100.0 * *a.residual);
  if (a.gain && (*a.gain > kAsFar || *a.gain < 1.0 / kAsFar)) {
    text += fmt::format("; the record moves {:.3g} times as far as the run", *a.gain);
  }
  if (a.other_size) text += "; " + other_size_text(*a.other_size);
  if (a.mirrored) text += "; " + mirrored_text(*a.mirrored);
  if (a.turn_for_shift) {
    text += fmt::format(
        "; the motion is so near to a circle that {:+.3g}° of the angle compensate 10 µs of the "
        "shift; if you know one of them, give it",
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
