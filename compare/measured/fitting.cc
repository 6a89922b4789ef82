#include "compare/measured/fitting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "compare/metrics/rows.h"
#include "native_model/numerics/root.h"

namespace rotorub {
namespace {

using Eigen::Index;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr std::size_t kMostFitted = 200000;  // samples of a channel; more do not improve the fit
constexpr double kExact = 1e-9;              // accuracy of a shift, in intervals of the record
constexpr double kApart = 0.01;  // step of central differences, in intervals of the record

VectorXcd without_mean(const VectorXcd& z) {
  return z.size() == 0 ? z : VectorXcd(z.array() - z.mean());
}

double deviation(const VectorXcd& z) {
  return z.size() == 0 ? 0.0 : without_mean(z).norm() / std::sqrt(static_cast<double>(z.size()));
}

// Takes the good samples of the record; of a pair those where x and y are both good.
void take_record(const MeasuredColumn& x, const MeasuredColumn* y, const SampleTimes& all,
                 Channel& channel) {
  std::vector<std::complex<double>> values;
  for (std::size_t i = 0; i < x.value.size(); ++i) {
    if (x.sample[i] != Sample::kGood || (y && y->sample[i] != Sample::kGood)) continue;
    channel.times.add(all, i);
    values.emplace_back(x.value[i], y ? y->value[i] : 0.0);
  }
  channel.value = Eigen::Map<const VectorXcd>(values.data(), static_cast<Index>(values.size()));
}

}  // namespace

std::string Channel::name() const {
  return std::string(pair ? what->name.substr(0, what->name.rfind('_')) : what->name);
}

VectorXcd Channel::of(const SampledRun& run, const SampleTimes& at) const {
  using Values = Eigen::Map<const VectorXd>;
  const std::vector<double> x = run.values(*what, at, pair ? 0.0 : frame);
  VectorXcd z = Values(x.data(), static_cast<Index>(x.size())).cast<std::complex<double>>();
  if (pair) z.imag() = Values(run.values(other_axis(*what), at).data(), z.size());
  return z / scale;
}

std::vector<Channel> channels_of(const MeasuredRecord& record, const SampledRun& run,
                                 double angle) {
  constexpr std::size_t kTimes = 4096;  // enough to measure the size of a motion
  const SampleTimes all = sample_times(record.t, record.interval);
  const SampleTimes of_run =
      sample_times(even_times(run.start(), run.end(), kTimes), record.interval);
  const auto column = [&](const Measurable& m) {
    const MeasuredColumn* c = record.find(m.name);
    return c && run.has(m) ? c : nullptr;
  };
  for (int group = 0; group < kChannelGroups; ++group) {
    std::vector<Channel> found;
    for (const Measurable& m : measurables()) {
      const MeasuredColumn* x = column(m);
      if (m.group != group || !x) continue;
      if (m.axis == Axis::kY && column(other_axis(m))) continue;  // handled with its x
      const MeasuredColumn* y = m.axis == Axis::kX ? column(other_axis(m)) : nullptr;
      Channel channel{&m, y != nullptr, angle, 1.0, {}, {}};
      take_record(*x, y, all, channel);
      const double scale = deviation(channel.of(run, of_run));
      if (!(scale > 0.0) || !(deviation(channel.value) > 0.0)) continue;
      channel.scale = scale;
      channel.value /= scale;
      found.push_back(std::move(channel));
    }
    if (!found.empty()) return found;
  }
  return {};
}

double Fit::correlation() const {
  const double size = record.norm() * run.norm();
  return size > 0.0 ? record.dot(run).real() / size : 0.0;
}

double Fit::gain() const {
  const double size = run.norm();
  return size > 0.0 ? record.norm() / size : 0.0;
}

Fitting::Fitting(const SampledRun& run, const std::vector<Channel>& channels, double interval,
                 double shift, double room, std::optional<double> angle)
    : run_(run), interval_(interval), angle_(angle) {
  // Leaves room for the derivatives, because the run is constant beyond its ends, which a turn does
  // not change.
  const double inside = std::max(room, kApart * interval) - 1e-6 * interval;
  const double from = run.start() + inside - shift, to = run.end() - inside - shift;
  for (const bool pairs : {true, false}) {
    for (const Channel& channel : channels) {
      if (channel.pair == pairs) add(channel, from, to);
    }
    if (pairs) pairs_ = record_.size();
  }
}

void Fitting::add(const Channel& channel, double from, double to) {
  const SampleTimes& all = channel.times;
  const bool averaged = channel.what->series.empty();
  const auto &begin = averaged ? all.from : all.t, &end = averaged ? all.to : all.t;
  std::vector<std::size_t> kept;  // indices of the channel's values
  for (std::size_t k = 0; k < all.t.size(); ++k) {
    if (begin[k] >= from && end[k] <= to) kept.push_back(k);
  }
  Part part{&channel, {}, record_.size(), 0};
  VectorXcd m(static_cast<Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); k += kept.size() / kMostFitted + 1) {
    part.times.add(all, kept[k]);
    m[part.count++] = channel.value[static_cast<Index>(kept[k])];
  }
  record_.conservativeResize(part.first + part.count);
  record_.tail(part.count) = without_mean(m.head(part.count));
  parts_.push_back(std::move(part));
}

VectorXcd Fitting::run_at(double shift) const {
  VectorXcd all(record_.size());
  for (const Part& p : parts_) {
    all.segment(p.first, p.count) = without_mean(p.channel->of(run_, shifted(p.times, shift)));
  }
  return all;
}

Fit Fitting::at(double shift) const {
  Fit fit{0.0, run_at(shift), record_};
  fit.angle = angle_.value_or(std::arg(record_.head(pairs_).dot(fit.run.head(pairs_))));
  fit.record.head(pairs_) *= std::polar(1.0, fit.angle);
  return fit;
}

double Fitting::rms(const Channel& channel, const Fit& fit) const {
  const VectorXcd left = fit.left();
  double square = 0.0, count = 0.0;
  for (const Part& p : parts_) {
    if (p.channel != &channel) continue;
    square += left.segment(p.first, p.count).squaredNorm();
    count += static_cast<double>(p.count);
  }
  return count > 0.0 ? std::sqrt(square / count) : 0.0;
}

double Fitting::refined(double shift, double h) const {
  const auto left = [&](double by) { return at(by).left().squaredNorm(); };
  const double middle = shift;
  for (double by = -h; h > 1.5 * interval_ && by <= h; by += 0.5 * interval_) {
    if (left(middle + by) < left(shift)) shift = middle + by;
  }
  // The angle is optimal at each shift, so d |m - s|^2 = -2 Re (m - s)^* s' has no further terms.
  const auto slope = [&](double by) { return -at(by).left().dot(rate_at(by)).real(); };
  // The grid's best shift is off by at most half an interval. Much further away, the slope of a
  // fast motion reverses.
  const double reach = 0.75 * interval_, before = shift - reach, after = shift + reach;
  const double falls = slope(before), rises = slope(after);
  if (!(falls < 0.0 && rises > 0.0)) return shift;
  const double found = root(slope, before, after, falls, rises, kExact * interval_).first;
  return left(found) < left(shift) ? found : shift;
}

VectorXcd Fitting::rate_at(double shift) const {
  const double h = 0.999 * kApart * interval_;  // stays within the run, see Fitting()
  return (run_at(shift + h) - run_at(shift - h)) / (2.0 * h);
}

Fitting::Effects Fitting::effects(const Fit& fit, double shift) const {
  Effects g;
  g.d = rate_at(shift);
  g.e = VectorXcd::Zero(g.d.size());
  const auto s = fit.run.head(pairs_), m = fit.record.head(pairs_);
  const double square = s.squaredNorm();
  if (!angle_ && square > 0.0) {
    const double explained = s.dot(m).real() / square;
    g.e.head(pairs_) = std::complex<double>(0.0, -explained) * s;
  }
  g.dd = g.d.squaredNorm();
  g.de = g.d.dot(g.e).real();
  g.ee = g.e.squaredNorm();
  return g;
}

std::pair<double, double> Fitting::span() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::pair<double, double> all{kInfinity, -kInfinity};
  for (const Part& p : parts_) {
    if (p.count == 0) continue;
    all = {std::min(all.first, p.times.t.front()), std::max(all.second, p.times.t.back())};
  }
  return all;
}

// Sum of squares of the sums of `pull` over blocks of `length` (s), as for independent blocks; 0
// with fewer than kLeastBlocks blocks.
double Fitting::block_scatter(const VectorXd& pull, double length) const {
  const double start = span().first;
  // Over all channels, because values at one instant are not independent.
  std::map<Index, double> sums;
  for (const Part& p : parts_) {
    for (Index k = 0; k < p.count; ++k) {
      const double t = p.times.t[static_cast<std::size_t>(k)];
      sums[std::llround(std::floor((t - start) / length))] += pull[p.first + k];
    }
  }
  if (sums.size() < kLeastBlocks) return 0.0;
  double square = 0.0;
  for (const auto& [block, sum] : sums) square += sum * sum;
  const auto count = static_cast<double>(sums.size());
  return square * count / (count - 1.0);
}

std::optional<double> Fitting::error(const VectorXcd& f, const Fit& fit) const {
  constexpr double kSure = 3.0;  // standard deviations of the scatter of white noise
  if (!(f.squaredNorm() > 0.0)) return std::nullopt;
  const VectorXcd left = fit.left();
  double scatter = 0.0;
  for (const Part& p : parts_) {
    const Index numbers = std::max<Index>(p.count * (p.channel->pair ? 2 : 1), 1);
    const double noise =
        left.segment(p.first, p.count).squaredNorm() / static_cast<double>(numbers);
    scatter += noise * f.segment(p.first, p.count).squaredNorm();
  }
  const VectorXd pull = f.conjugate().cwiseProduct(left).real();
  const double white = scatter;
  const auto [begin, end] = span();
  for (double intervals = 2.0;; intervals *= 2.0) {
    const double length = intervals * interval_;
    const double blocks = block_scatter(pull, length);
    if (blocks == 0.0) break;
    const double count = std::max(1.0, (end - begin) / length);
    if (blocks > white * (1.0 + kSure * std::sqrt(2.0 / count)))
      scatter = std::max(scatter, blocks);
  }
  return std::sqrt(scatter) / f.squaredNorm();
}

}  // namespace rotorub
