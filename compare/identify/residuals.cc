#include "compare/identify/residuals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/engine/engine.h"
#include "compare/metrics/rows.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub::identify {
namespace {

// Keeps the samples that the run covers at every shift within the range.
void keep(MeasuredRecord& record, double from, double to) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < record.t.size(); ++i) {
    if (record.t[i] >= from && record.t[i] <= to) kept.push_back(i);
  }
  const auto of = [&](auto& all) {
    for (std::size_t k = 0; k < kept.size(); ++k) all[k] = all[kept[k]];
    all.resize(kept.size());
  };
  of(record.t);
  for (MeasuredColumn& c : record.columns) {
    of(c.value);
    of(c.sample);
  }
  if (kept.size() >= kLeastSamples) return;
  throw MeasuredError(
      fmt::format("{} samples of the record lie on the run, but at least {} are needed",
                  kept.size(), kLeastSamples));
}

}  // namespace

Residuals::Residuals(const ReadScene& read, MeasuredRecord record, const Parameters& parameters)
    : read_(read),
      wanted_(parameters.wanted),
      record_(std::move(record)),
      options_(parameters.alignment),
      interrupt_(parameters.interrupt) {
  mark_clipped(record_);
}

// Rows at the interval of the samples, for an unknown shift.
Trajectory Residuals::even_run(const scene::Scene& scene) {
  const auto count = static_cast<std::size_t>(scene.run.end / record_.interval) + 2;
  return run(scene, even_times(0.0, scene.run.end, count));
}

std::optional<Alignment> Residuals::aligned(const std::vector<double>& values) {
  try {
    const Trajectory run = even_run(read_(overrides(values)));
    if (run.status != Status::kOk) return std::nullopt;
    return best_alignment(record_, SampledRun(run), options_);
  } catch (const scene::SceneError&) {
    return std::nullopt;  // for example, a start outside of a small clearance
  } catch (const MeasuredError&) {
    return std::nullopt;
  }
}

void Residuals::align_record(const std::vector<double>& values) {
  const scene::Scene scene = read_(overrides(values));
  const Trajectory run = even_run(scene);
  const SampledRun sampled(run);
  laid_ = align(record_, sampled, options_);
  angle_ = laid_.angle_from == AngleFrom::kCircle ? std::optional(0.0) : options_.angle;
  middle_ = laid_.shift;
  if (!options_.shift) room_ = std::max(4.0 * record_.interval, 0.01 * record_.duration());
  const double inside = room_ + record_.interval;  // a force is averaged over its sample
  keep(record_, -middle_ + inside, scene.run.end - middle_ - inside);
  channels_ = channels_of(record_, sampled, angle_.value_or(0.0));
  if (channels_.empty())
    throw MeasuredError("no measured quantity moves both in the record and in the native run");
}

double Residuals::value(std::size_t k, double x) const {
  const Wanted& w = wanted_[k];
  if (is_logarithmic(w)) return w.from * std::pow(w.to / w.from, x);
  return w.from + (w.to - w.from) * x;
}

double Residuals::slope(std::size_t k, double x) const {
  const Wanted& w = wanted_[k];
  return is_logarithmic(w) ? value(k, x) * std::log(w.to / w.from) : w.to - w.from;
}

double Residuals::shift(const std::vector<double>& x) const {
  return options_.shift ? middle_ : middle_ + room_ * (2.0 * x.back() - 1.0);
}

std::vector<std::string> Residuals::overrides(const std::vector<double>& x) const {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < wanted_.size(); ++k) {
    all.push_back(fmt::format("{}={:.17g}", wanted_[k].key, value(k, x[k])));
  }
  return all;
}

Trajectory Residuals::run(const scene::Scene& scene, std::vector<double> rows) {
  RunRequest request;
  request.interrupt = interrupt_;
  request.output_times = std::move(rows);
  ++runs_;
  return native_engine(scene.run.integrator)->run(scene, request);
}

double Residuals::Point::rms() const {
  return std::sqrt(square() / static_cast<double>(std::max<std::size_t>(fitting->values(), 1)));
}

double Residuals::Point::run_rms() const {
  return fit.run.norm() / std::sqrt(static_cast<double>(fitting->values()));
}

std::optional<Residuals::Point> Residuals::at(const std::vector<double>& x) {
  return point_at(overrides(x), shift(x));
}

std::optional<Residuals::Point> Residuals::point_at(const std::vector<std::string>& overrides,
                                                    double by) {
  Point point;
  try {
    const scene::Scene scene = read_(overrides);
    // Rows at the samples, so that nothing is interpolated.
    std::vector<double> rows{std::max(0.0, record_.t.front() + by - record_.interval)};
    for (const double t : record_.t) {
      if (t + by > rows.back() && t + by <= scene.run.end) rows.push_back(t + by);
    }
    const double after = std::min(scene.run.end, rows.back() + record_.interval);
    if (after > rows.back()) rows.push_back(after);
    point.run = std::make_unique<Trajectory>(run(scene, std::move(rows)));
  } catch (const scene::SceneError&) {
    return std::nullopt;  // for example, a start outside of a small clearance
  }
  if (point.run->status != Status::kOk || point.run->rows() < 2) return std::nullopt;
  point.sampled = std::make_unique<SampledRun>(*point.run);
  point.fitting =
      std::make_unique<Fitting>(*point.sampled, channels_, record_.interval, by, 0.0, angle_);
  point.shift = by;
  point.fit = point.fitting->at(by);
  return point;
}

std::optional<Residuals::Point> Residuals::as_it_stands() {
  constexpr int kSteps = 4;
  AlignmentOptions options = options_;
  if (angle_) options.angle = angle_;  // 0 for a circular motion, as here
  double by = middle_;
  try {
    const Trajectory run = even_run(read_({}));
    if (run.status != Status::kOk) return std::nullopt;
    by = align(record_, SampledRun(run), options).shift;
  } catch (const MeasuredError&) {
    return std::nullopt;
  }
  std::optional<Point> best = point_at({}, by);
  if (options_.shift) return best;
  // Gauss-Newton steps, because the alignment interpolated between rows.
  for (int step = 0; step < kSteps && best; ++step) {
    const Fitting::Effects g = best->fitting->effects(best->fit, best->shift);
    const Eigen::VectorXcd alone = g.ee > 0.0 ? Eigen::VectorXcd(g.d - g.de / g.ee * g.e) : g.d;
    if (!(alone.squaredNorm() > 0.0)) break;
    const double change = alone.dot(best->fit.left()).real() / alone.squaredNorm();
    if (!(std::abs(change) < record_.interval)) break;
    auto next = point_at({}, best->shift + change);
    if (!next || !(next->rms() < best->rms())) break;
    best = std::move(next);
  }
  return best;
}

void Residuals::weigh(const Point& point) {
  constexpr double kLeast = 1e-6;  // relative to the run's deviation, for a record without noise
  std::vector<double> left;
  for (const Channel& channel : channels_) left.push_back(point.fitting->rms(channel, point.fit));
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    const double by = std::max(left[k], kLeast);
    channels_[k].scale *= by;
    channels_[k].value /= by;
  }
}

}  // namespace rotorub::identify
