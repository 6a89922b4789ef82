#include "compare/measured/alignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <numbers>

#include "compare/measured/channel.h"
#include "compare/measured/lag_search.h"
#include "compare/study/format.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kMostFitted = 200000;  // samples of a channel: more tell no more

// Samples of one channel that stay on the run while the shift is varied.
struct FittedChannel {
  Channel channel;
  SampleTimes times;        // of the record's clock
  std::vector<Complex> m;   // less its mean
};

std::vector<Complex> without_mean(std::vector<Complex> z) {
  Complex mean = 0.0;
  for (const Complex& value : z) mean += value;
  mean /= static_cast<double>(std::max<std::size_t>(z.size(), 1));
  for (Complex& value : z) value -= mean;
  return z;
}

// What is left at a shift.
struct Fit {
  double angle = 0.0;
  double left = 0.0, run = 0.0, record = 0.0, both = 0.0;  // sums of squares, and of products, in scales
  std::vector<double> noise;  // mean square of what is left of each channel, in scales
  double correlation() const { return run > 0.0 && record > 0.0 ? both / std::sqrt(run * record) : 0.0; }
};

class Fitting {
 public:
  Fitting(const MeasuredRecord& record, const SampledRun& run, const std::vector<Channel>& channels, double shift,
          double room, std::optional<double> angle)
      : run_(run), angle_(angle) {
    const SampleTimes all = sample_times(record.t, record.interval);
    const double slack = 1e-6 * record.interval;
    for (const Channel& channel : channels) {
      std::vector<std::size_t> kept;
      for (std::size_t i = 0; i < record.t.size(); ++i) {
        const bool averaged = channel.x->what->series.empty();
        const double from = (averaged ? all.from[i] : all.t[i]) + shift, to = (averaged ? all.to[i] : all.t[i]) + shift;
        if (is_good(channel, i) && from >= run.start() + room - slack && to <= run.end() - room + slack) kept.push_back(i);
      }
      const std::size_t every = kept.size() / kMostFitted + 1;
      FittedChannel fitted{channel, {}, {}};
      for (std::size_t k = 0; k < kept.size(); k += every) {
        fitted.times.t.push_back(all.t[kept[k]]);
        fitted.times.from.push_back(all.from[kept[k]]);
        fitted.times.to.push_back(all.to[kept[k]]);
        fitted.m.push_back(record_value(channel, kept[k]));
      }
      fitted.m = without_mean(std::move(fitted.m));
      values_ += fitted.m.size() * (channel.is_pair() ? 2 : 1);
      channels_.push_back(std::move(fitted));
    }
  }

  std::size_t values() const { return values_; }  // real numbers fitted

  Fit at(double shift) const {
    Fit fit;
    std::vector<std::vector<Complex>> s;
    Complex pairs = 0.0;
    for (const FittedChannel& c : channels_) {
      s.push_back(run_at(c, shift));
      if (!c.channel.is_pair()) continue;
      for (std::size_t i = 0; i < c.m.size(); ++i) pairs += weight(c) * std::conj(c.m[i]) * s.back()[i];
    }
    fit.angle = angle_.value_or(std::arg(pairs));
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      const FittedChannel& c = channels_[k];
      const double before = fit.left;
      for (std::size_t i = 0; i < c.m.size(); ++i) {
        const Complex m = turn(c, fit.angle) * c.m[i];
        fit.left += weight(c) * std::norm(s[k][i] - m);
        fit.run += weight(c) * std::norm(s[k][i]);
        fit.record += weight(c) * std::norm(m);
        fit.both += weight(c) * (std::conj(m) * s[k][i]).real();
      }
      const std::size_t numbers = c.m.size() * (c.channel.is_pair() ? 2 : 1);
      fit.noise.push_back((fit.left - before) / static_cast<double>(std::max<std::size_t>(numbers, 1)));
    }
    return fit;
  }

  // Products of the gradients at a fit, by central differences over `h`: of the shift's effect d on the run, of the
  // angle's e, and of what is left r.
  struct Effects {
    double dd = 0.0, de = 0.0, ee = 0.0, dr = 0.0, er = 0.0;
    double across() const { return ee > 0.0 ? de / ee : 0.0; }
    double own() const { return dd - across() * de; }  // of the shift, that no turn explains
  };
  // Of each channel.
  std::vector<Effects> effects(const Fit& fit, double shift, double h) const {
    std::vector<Effects> all;
    for (const FittedChannel& c : channels_) {
      Effects g;
      const auto s = run_at(c, shift), ahead = run_at(c, shift + h), behind = run_at(c, shift - h);
      for (std::size_t i = 0; i < c.m.size(); ++i) {
        const Complex m = turn(c, fit.angle) * c.m[i], left = m - s[i];
        const Complex d = (ahead[i] - behind[i]) / (2.0 * h);
        // A turn of the frame by a moves m by i a m: what is left grows as if the run went back by that.
        const Complex e = c.channel.is_pair() && !angle_ ? Complex(0.0, -1.0) * m : 0.0;
        g.dd += weight(c) * std::norm(d);
        g.ee += weight(c) * std::norm(e);
        g.de += weight(c) * (std::conj(d) * e).real();
        g.dr += weight(c) * (std::conj(d) * left).real();
        g.er += weight(c) * (std::conj(e) * left).real();
      }
      all.push_back(g);
    }
    return all;
  }

 private:
  static double weight(const FittedChannel& c) { return 1.0 / (c.channel.scale * c.channel.scale); }
  static Complex turn(const FittedChannel& c, double angle) {
    return c.channel.is_pair() ? std::polar(1.0, angle) : Complex(1.0);
  }
  std::vector<Complex> run_at(const FittedChannel& c, double shift) const {
    return without_mean(run_values(c.channel, run_, shifted(c.times, shift)));
  }

  const SampledRun& run_;
  std::optional<double> angle_;
  std::vector<FittedChannel> channels_;
  std::size_t values_ = 0;
};

Fitting::Effects total(const std::vector<Fitting::Effects>& all) {
  Fitting::Effects sum;
  for (const auto& g : all) {
    sum.dd += g.dd;
    sum.de += g.de;
    sum.ee += g.ee;
    sum.dr += g.dr;
    sum.er += g.er;
  }
  return sum;
}

// Standard deviation of an estimate sum(f r) / sum(f f), where r is white with a variance of its own in each channel and
// f = d - across e (of the shift), or e - across d (of the angle).
std::optional<double> estimate_error(const std::vector<Fitting::Effects>& all, const std::vector<double>& noise, bool shift,
                                     double across) {
  double own = 0.0, scatter = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& g = all[k];
    const double ff = shift ? g.dd - 2.0 * across * g.de + across * across * g.ee : g.ee - 2.0 * across * g.de + across * across * g.dd;
    own += ff;
    scatter += noise[k] * ff;
  }
  if (!(own > 0.0)) return std::nullopt;
  return std::sqrt(std::max(scatter, 0.0)) / own;
}

// Between the grid's instants: the least that is left, first coarse where the grid is wider than the record's samples,
// then by Brent, and by Gauss and Newton, who end in round-off where nothing is left.
double refined(const Fitting& fitting, double shift, double h, double interval) {
  double width = h;
  if (h > 1.5 * interval) {
    double least = fitting.at(shift).left;
    const double middle = shift;
    for (double by = -h; by <= h; by += 0.5 * interval) {
      const double left = fitting.at(middle + by).left;
      if (left < least) {
        least = left;
        shift = middle + by;
      }
    }
    width = interval;
  }
  const auto left = [&](double share) { return fitting.at(shift + share * width).left; };
  std::uintmax_t evaluations = 60;
  shift += width * boost::math::tools::brent_find_minima(left, -1.0, 1.0, 26, evaluations).first;
  for (int pass = 0; pass < 3; ++pass) {
    const Fit fit = fitting.at(shift);
    const auto g = total(fitting.effects(fit, shift, 0.01 * interval));
    if (!(g.own() > 0.0)) break;
    const double step = (g.dr - g.across() * g.er) / g.own();
    if (!(std::abs(step) < 0.1 * interval) || !(fitting.at(shift + step).left < fit.left)) break;
    shift += step;
  }
  return shift;
}

std::string span_text(double from, double to) { return fmt::format("{:.6g} to {:.6g} s", from, to); }

std::string channels_text(const std::vector<std::string>& by) {
  std::string all;
  for (std::size_t k = 0; k < by.size(); ++k) all += (k == 0 ? "" : k + 1 == by.size() ? " and " : ", ") + by[k];
  return all;
}

// One search with the angle free or held.
struct Search {
  const MeasuredRecord& record;
  const SampledRun& run;
  const std::vector<Channel>& channels;

  Alignment with(std::optional<double> shift, std::optional<double> angle, double& own_effect) const {
    Alignment a;
    double room = 0.0;
    if (!shift) {
      const auto scores = lag_scores(record, run, channels, angle);
      if (scores.empty()) throw MeasuredError("record and run have too few samples in common, whatever the shift");
      const BestLags found = best_lags(scores);
      const LagScore& best = scores[found.best];
      if (best.correlation < kLeastCorrelation) {
        throw MeasuredError(fmt::format(
            "no shift makes the record like the native run: the best, {:+.6g} s, has a correlation of {:.2f} in {}, {} or more "
            "is accepted; another scene than was measured, other units, or chaos; --measured-shift lays it in where it is told",
            best.shift, best.correlation, channels_text(names()), kLeastCorrelation));
      }
      if (found.next) a.next = Alignment::Other{scores[*found.next].shift, scores[*found.next].correlation};
      const double h = scores.size() > 1 ? scores[1].shift - scores[0].shift : record.interval;
      room = std::max(h, record.interval);
      const Fitting wide(record, run, channels, best.shift, room, angle);
      a.shift = wide.values() >= kLeastSamples ? refined(wide, best.shift, h, record.interval) : best.shift;
    } else {
      a.shift = *shift;
      a.shift_found = false;
    }
    const Fitting fitting(record, run, channels, a.shift, 0.0, angle);
    const Fit fit = fitting.at(a.shift);
    a.angle = fit.angle;
    a.correlation = fit.correlation();
    a.residual = fit.run > 0.0 ? std::optional(std::sqrt(fit.left / fit.run)) : std::nullopt;
    const auto each = fitting.effects(fit, a.shift, 0.01 * record.interval);
    const Fitting::Effects g = total(each);
    own_effect = g.dd > 0.0 ? g.own() / g.dd : 0.0;
    if (!shift && !angle && own_effect < kNearCircle) a.turn_for_shift = -g.across();
    if (!shift) a.shift_error = estimate_error(each, fit.noise, true, g.across());
    if (!angle) a.angle_error = estimate_error(each, fit.noise, false, shift || !(g.dd > 0.0) ? 0.0 : g.de / g.dd);
    return a;
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
  throw MeasuredError(fmt::format(
      "with the shift of {:+.6g} s the record spans {}, the run {}: {} samples in common, {} or more are accepted", shift,
      span_text(record.t.front() + shift, record.t.back() + shift), span_text(run.start(), run.end()), on, kLeastSamples));
}

double left_by(double correlation) { return std::sqrt(std::max(0.0, 1.0 - correlation * correlation)); }

}  // namespace

bool Alignment::ambiguous() const {
  if (!next || !correlation) return false;
  return left_by(next->correlation) < std::max(kTwice * left_by(*correlation), kNextToNothing);
}

Alignment align(const MeasuredRecord& record, const SampledRun& run, const AlignmentOptions& options) {
  if (options.shift) check_overlap(record, run, *options.shift);
  const std::vector<Channel> channels = channels_of(record, run, options.angle.value_or(0.0));
  const bool pair = std::any_of(channels.begin(), channels.end(), [](const Channel& c) { return c.is_pair(); });
  if (channels.empty()) {
    if (!options.shift) {
      throw MeasuredError("nothing that both the record and the native run move in: no shift can be found; "
                          "--measured-shift lays it in where it is told");
    }
    Alignment told{*options.shift, options.angle.value_or(0.0), false, options.angle ? AngleFrom::kGiven : AngleFrom::kNoPair,
                   {}, {}, {}, {}, {}, {}, {}};
    return told;
  }
  const Search search{record, run, channels};
  double own_effect = 0.0;
  const bool finds_angle = pair && !options.angle;
  Alignment found = search.with(options.shift, finds_angle ? std::nullopt : std::optional(options.angle.value_or(0.0)), own_effect);
  found.angle_from = options.angle ? AngleFrom::kGiven : pair ? AngleFrom::kFound : AngleFrom::kNoPair;
  if (finds_angle && !options.shift && own_effect < kLeastOwnEffect) {
    found = search.with(options.shift, 0.0, own_effect);
    found.angle_from = AngleFrom::kCircle;
  }
  found.by = search.names();
  check_overlap(record, run, found.shift);
  return found;
}

std::string alignment_text(const Alignment& a) {
  const auto error = [](const std::optional<double>& e, double unit, const char* name) {
    return e ? fmt::format(" ± {:.3g}{}", *e / unit, name) : std::string();
  };
  std::string text = fmt::format("shift {:+.6f} ms{}{}", 1e3 * a.shift, a.shift_found ? "" : " as given",
                                 error(a.shift_error, 1e-6, " µs"));
  text += fmt::format(", sensors' x axis at {:+.3f}°", a.angle / kDegree);
  switch (a.angle_from) {
    case AngleFrom::kGiven: text += " as given"; break;
    case AngleFrom::kFound: text += error(a.angle_error, kDegree, "°"); break;
    case AngleFrom::kNoPair: text += " taken: no x with its y is measured"; break;
    case AngleFrom::kCircle:
      text += " taken: the motion is a circle, in which a turn of the frame looks like a shift (--measured-angle tells it)";
      break;
  }
  if (a.by.empty()) return text + "; nothing moves in both: nothing says how well it fits";
  text += fmt::format("; by {}: correlation {:.4f}", channels_text(a.by), a.correlation.value_or(0.0));
  if (a.residual) text += fmt::format(", left {:.3g} % of the run's rms", 100.0 * *a.residual);
  if (a.turn_for_shift) {
    text += fmt::format("; so near to a circle that {:+.3g}° of the angle make up for 10 µs of the shift: tell one of them, if it is known",
                        1e-5 * *a.turn_for_shift / kDegree);
  }
  if (a.ambiguous()) {
    text += fmt::format("; ambiguous: {:+.6f} ms fits nearly as well (correlation {:.4f})", 1e3 * a.next->shift,
                        a.next->correlation);
  } else if (a.next) {
    text += fmt::format("; next best {:+.3f} ms (correlation {:.3f})", 1e3 * a.next->shift, a.next->correlation);
  }
  return text;
}

}  // namespace rotorub
