#include "compare/measured/fitting.h"

#include <cmath>
#include <unsupported/Eigen/LevenbergMarquardt>

namespace rotorub {
namespace {

using Eigen::Index;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr std::size_t kMostFitted = 200000;  // samples of a channel: more tell no more

// What is left at a shift, for the library: x[0] intervals of the record after `shift`.
struct LeftAt : Eigen::DenseFunctor<double> {
  const Fitting& fitting;
  double shift, interval;

  LeftAt(const Fitting& f, double from, double h)
      : DenseFunctor(1, 2 * static_cast<int>(f.at(from).run.size())),
        fitting(f),
        shift(from),
        interval(h) {}

  VectorXd at(double x) const {
    const VectorXcd left = fitting.at(shift + x * interval).left();
    return (VectorXd(2 * left.size()) << left.real(), left.imag()).finished();
  }
  int operator()(const VectorXd& x, VectorXd& left) const {
    left = at(x[0]);
    return 0;
  }
  int df(const VectorXd& x, Eigen::MatrixXd& slope) const {
    constexpr double kApart = 0.01;
    slope = (at(x[0] + kApart) - at(x[0] - kApart)) / (2.0 * kApart);
    return 0;
  }
};

}  // namespace

double Fit::correlation() const {
  const double size = record.norm() * run.norm();
  return size > 0.0 ? record.dot(run).real() / size : 0.0;
}

Fitting::Fitting(const MeasuredRecord& record, const SampledRun& run,
                 const std::vector<Channel>& channels, double shift, double room,
                 std::optional<double> angle)
    : run_(run), angle_(angle) {
  const SampleTimes all = sample_times(record.t, record.interval);
  const double inside = room - 1e-6 * record.interval;
  const double from = run.start() + inside - shift, to = run.end() - inside - shift;
  for (const bool pairs : {true, false}) {
    for (const Channel& channel : channels) {
      if (channel.pair == pairs) add(channel, all, from, to);
    }
    if (pairs) pairs_ = record_.size();
  }
}

void Fitting::add(const Channel& channel, const SampleTimes& all, double from, double to) {
  const bool averaged = channel.what->series.empty();
  std::vector<Index> kept;  // of the channel's values
  for (Index k = 0; k < channel.value.size(); ++k) {
    const std::size_t i = channel.good[static_cast<std::size_t>(k)];
    const double begin = averaged ? all.from[i] : all.t[i], end = averaged ? all.to[i] : all.t[i];
    if (begin >= from && end <= to) kept.push_back(k);
  }
  Part part{&channel, {}, record_.size(), 0};
  VectorXcd m(static_cast<Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); k += kept.size() / kMostFitted + 1) {
    const std::size_t i = channel.good[static_cast<std::size_t>(kept[k])];
    part.times.t.push_back(all.t[i]);
    part.times.from.push_back(all.from[i]);
    part.times.to.push_back(all.to[i]);
    m[part.count++] = channel.value[kept[k]];
  }
  record_.conservativeResize(part.first + part.count);
  record_.tail(part.count) = without_mean(m.head(part.count));
  parts_.push_back(std::move(part));
}

std::size_t Fitting::values() const { return static_cast<std::size_t>(record_.size() + pairs_); }

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

Fitting::Effects Fitting::effects(const Fit& fit, double shift, double h) const {
  Effects g;
  g.d = (run_at(shift + h) - run_at(shift - h)) / (2.0 * h);
  g.e = VectorXcd::Zero(g.d.size());
  if (!angle_) g.e.head(pairs_) = std::complex<double>(0.0, -1.0) * fit.record.head(pairs_);
  g.dd = g.d.squaredNorm();
  g.de = g.d.dot(g.e).real();
  g.ee = g.e.squaredNorm();
  return g;
}

std::optional<double> Fitting::error(const VectorXcd& f, const Fit& fit) const {
  const VectorXcd left = fit.left();
  double scatter = 0.0;
  for (const Part& p : parts_) {
    const auto numbers =
        static_cast<double>(std::max<Index>(p.count * (p.channel->pair ? 2 : 1), 1));
    const double noise = left.segment(p.first, p.count).squaredNorm() / numbers;
    scatter += noise * f.segment(p.first, p.count).squaredNorm();
  }
  if (!(f.squaredNorm() > 0.0)) return std::nullopt;
  return std::sqrt(scatter) / f.squaredNorm();
}

double refined(const Fitting& fitting, double shift, double h, double interval) {
  const auto left = [&](double at) { return fitting.at(at).left().squaredNorm(); };
  const double middle = shift;
  for (double by = -h; h > 1.5 * interval && by <= h; by += 0.5 * interval) {
    if (left(middle + by) < left(shift)) shift = middle + by;
  }
  LeftAt functor(fitting, shift, interval);
  Eigen::LevenbergMarquardt<LeftAt> search(functor);
  search.setFactor(1.0);  // the first step is an interval at most
  search.setFtol(1e-15);
  search.setXtol(1e-13);
  VectorXd x = VectorXd::Zero(1);
  search.minimize(x);
  const double found = shift + x[0] * interval;
  return std::abs(x[0]) <= 1.0 && left(found) < left(shift) ? found : shift;
}

}  // namespace rotorub
