#include "compare/measured/fitting.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

namespace rotorub {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kMostFitted = 200000;  // samples of a channel: more tell no more

std::vector<Complex> without_mean(std::vector<Complex> z) {
  Complex mean = 0.0;
  for (const Complex& value : z) mean += value;
  mean /= static_cast<double>(std::max<std::size_t>(z.size(), 1));
  for (Complex& value : z) value -= mean;
  return z;
}

}  // namespace

double Fit::correlation() const { return run > 0.0 && record > 0.0 ? both / std::sqrt(run * record) : 0.0; }

Fitting::Fitting(const MeasuredRecord& record, const SampledRun& run, const std::vector<Channel>& channels,
                 double shift, double room, std::optional<double> angle)
    : run_(run), angle_(angle) {
  const SampleTimes all = sample_times(record.t, record.interval);
  const double slack = 1e-6 * record.interval;
  for (const Channel& channel : channels) {
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < record.t.size(); ++i) {
      const bool averaged = channel.x->what->series.empty();
      const double from = (averaged ? all.from[i] : all.t[i]) + shift, to = (averaged ? all.to[i] : all.t[i]) + shift;
      if (is_good(channel, i) && from >= run.start() + room - slack && to <= run.end() - room + slack)
        kept.push_back(i);
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

Complex Fitting::turn(const FittedChannel& c, double angle) {
  return c.channel.is_pair() ? std::polar(1.0, angle) : Complex(1.0);
}

std::vector<Complex> Fitting::run_at(const FittedChannel& c, double shift) const {
  return without_mean(run_values(c.channel, run_, shifted(c.times, shift)));
}

Fit Fitting::at(double shift) const {
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

std::vector<Effects> Fitting::effects(const Fit& fit, double shift, double h) const {
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

Effects total(const std::vector<Effects>& all) {
  Effects sum;
  for (const auto& g : all) {
    sum.dd += g.dd;
    sum.de += g.de;
    sum.ee += g.ee;
    sum.dr += g.dr;
    sum.er += g.er;
  }
  return sum;
}

std::optional<double> estimate_error(const std::vector<Effects>& all, const std::vector<double>& noise, bool shift,
                                     double across) {
  double own = 0.0, scatter = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto& g = all[k];
    const double ff = shift ? g.dd - 2.0 * across * g.de + across * across * g.ee
                            : g.ee - 2.0 * across * g.de + across * across * g.dd;
    own += ff;
    scatter += noise[k] * ff;
  }
  if (!(own > 0.0)) return std::nullopt;
  return std::sqrt(std::max(scatter, 0.0)) / own;
}

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

}  // namespace rotorub
