#include "compare/identify/identify.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "compare/identify/residuals.h"
#include "native_model/numerics/linear_solve.h"

namespace rotorub::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kEdge = 1e-3;  // relative to the range
constexpr int kSearch = 60;     // runs of the first search per unknown
constexpr int kDescent = 150;   // largest number of runs of a descent per unknown
constexpr int kSteps = 12;      // largest number of Gauss-Newton steps

// Provides the sum of squares to NLopt and keeps the best point.
class Descent {
 public:
  Descent(Residuals& residuals, const Parameters& parameters, int most)
      : residuals_(residuals), parameters_(parameters), most_(most) {}

  double square(const std::vector<double>& x) {
    if (stopped()) throw nlopt::forced_stop();
    const auto square = laid_in_ ? left_at(x) : left_anywhere(x);
    if (parameters_.progress) {
      parameters_.progress(std::min(1.0, static_cast<double>(residuals_.runs()) / most_));
    }
    if (square && *square < best_square) {
      best_square = *square;
      best = x;
    }
    return square.value_or(kNoRun);
  }

  // Searches only the values; each run is aligned with the record at its best shift.
  void search(int runs) {
    laid_in_ = false;
    run(nlopt::GN_DIRECT_L, runs, std::vector<double>(residuals_.values(), 0.5), 0.0);
    laid_in_ = true;
  }

  // Descends from a point, with first steps of `reach` in the unit ranges.
  void descend(const std::vector<double>& from, double reach, int runs) {
    run(nlopt::LN_BOBYQA, runs, from, reach);
  }

  bool stopped() const {
    return parameters_.interrupt && parameters_.interrupt->load(std::memory_order_relaxed);
  }

  std::vector<double> best;
  double best_square = std::numeric_limits<double>::infinity();

 private:
  // Result for a failed run: larger than any sum of squares, but finite for the algorithms.
  static constexpr double kNoRun = 1e12;

  std::optional<double> left_at(const std::vector<double>& x) {
    const auto point = residuals_.at(x);
    return point ? std::optional(point->square()) : std::nullopt;
  }
  std::optional<double> left_anywhere(const std::vector<double>& values) {
    const auto laid = residuals_.aligned(values);
    return laid ? laid->residual : std::nullopt;
  }

  void run(nlopt::algorithm method, int runs, std::vector<double> x, double reach) {
    nlopt::opt search(method, static_cast<unsigned>(x.size()));
    search.set_lower_bounds(0.0);
    search.set_upper_bounds(1.0);
    search.set_maxeval(runs);
    search.set_xtol_abs(1e-9);
    search.set_min_objective([](const std::vector<double>& at, std::vector<double>&,
                                void* self) { return static_cast<Descent*>(self)->square(at); },
                             this);
    if (reach > 0.0) search.set_initial_step(reach);
    double least = 0.0;
    try {
      search.optimize(x, least);
    } catch (const nlopt::roundoff_limited&) {  // as accurate as round-off permits
    } catch (const nlopt::forced_stop&) {
    }
  }

  Residuals& residuals_;
  const Parameters& parameters_;
  int most_;
  bool laid_in_ = true;
};

// The difference at a point and its derivatives by the unknowns: central differences, one-sided at
// an end of the range. Empty if a neighbouring run fails.
struct Linearised {
  Residuals::Point point;
  Eigen::MatrixXcd slopes;  // values x unknowns
};

std::optional<Linearised> linearised(Residuals& residuals, const std::vector<double>& x) {
  constexpr double kNudge = 1e-5;  // relative to the range
  auto point = residuals.at(x);
  if (!point) return std::nullopt;
  Linearised all{std::move(*point), {}};
  all.slopes.resize(all.point.fit.record.size(), static_cast<Index>(x.size()));
  for (std::size_t k = 0; k < x.size(); ++k) {
    std::vector<double> before = x, after = x;
    before[k] = std::max(0.0, x[k] - kNudge);
    after[k] = std::min(1.0, x[k] + kNudge);
    const auto low = residuals.at(before), high = residuals.at(after);
    if (!low || !high) return std::nullopt;
    all.slopes.col(static_cast<Index>(k)) =
        (high->fit.left() - low->fit.left()) / (after[k] - before[k]);
  }
  return all;
}

MatrixXd normal_matrix(const Eigen::MatrixXcd& slopes) {
  return (slopes.adjoint() * slopes).real();
}

// (J^T J)^-1 for the unknowns that matter, 0 for those on which the difference does not depend;
// scaled internally, so that units do not matter. Empty if it is singular to round-off.
std::optional<MatrixXd> inverse_normal(MatrixXd normal) {
  constexpr double kSingular = 1e-12;
  const double least = 1e-18 * normal.diagonal().maxCoeff();
  const VectorXd scale = normal.diagonal().unaryExpr(
      [&](double square) { return square > least ? 1.0 / std::sqrt(square) : 0.0; });
  normal = (scale.asDiagonal() * normal * scale.asDiagonal()).eval();
  for (Index k = 0; k < scale.size(); ++k) {
    if (scale[k] == 0.0) normal(k, k) = 1.0;
  }
  const ConditionedInverse found = ldlt_inverse(normal);
  if (!(found.reciprocal_condition > kSingular)) return std::nullopt;
  return scale.asDiagonal() * found.inverse * scale.asDiagonal();
}

// Gauss-Newton steps from the best point, each halved until it improves the fit.
void polish(Residuals& residuals, Descent& descent) {
  for (int step = 0; step < kSteps && !descent.stopped(); ++step) {
    const auto at = linearised(residuals, descent.best);
    if (!at) return;
    const auto inverse = inverse_normal(normal_matrix(at->slopes));
    if (!inverse) return;
    const VectorXd change = -*inverse * (at->slopes.adjoint() * at->point.fit.left()).real();
    const std::vector<double> from = descent.best;
    const double before = descent.best_square;
    for (double share = 1.0; share > 1e-3 && descent.best_square >= before; share *= 0.5) {
      std::vector<double> next = from;
      for (std::size_t k = 0; k < next.size(); ++k) {
        next[k] = std::clamp(next[k] + share * change[static_cast<Index>(k)], 0.0, 1.0);
      }
      descent.square(next);
    }
    if (!(descent.best_square < before * (1.0 - 1e-12))) return;
  }
}

// Standard deviations and correlations, in the unknowns of the search.
struct Known {
  std::vector<std::optional<double>> error;
  MatrixXd correlation;
};

Known known(const Linearised& at) {
  const Index n = at.slopes.cols();
  Known all{std::vector<std::optional<double>>(static_cast<std::size_t>(n)),
            MatrixXd::Identity(n, n)};
  const auto inverse = inverse_normal(normal_matrix(at.slopes));
  if (!inverse) return all;
  for (Index i = 0; i < n; ++i) {
    if ((*inverse)(i, i) == 0.0) continue;
    // For an estimate sum(f r) / sum(f f) with f = J (J^T J)^-1 e_i, times sum(f f).
    const VectorXcd f = at.slopes * inverse->col(i);
    if (const auto error = at.point.fitting->error(f, at.point.fit))
      all.error[static_cast<std::size_t>(i)] = *error * f.squaredNorm();
    for (Index j = 0; j < n; ++j) {
      const double size = std::sqrt((*inverse)(i, i) * (*inverse)(j, j));
      all.correlation(i, j) = size > 0.0 ? (*inverse)(i, j) / size : 0.0;
    }
  }
  return all;
}

// The final alignment, which was fitted together with the values.
Alignment alignment_at(const Residuals& residuals, const std::vector<double>& x,
                       const Residuals::Point& point) {
  Alignment a = residuals.laid();
  a.shift = residuals.shift(x);
  a.angle = point.fit.angle;
  a.correlation = point.fit.correlation();
  if (point.fit.run.norm() > 0.0) a.residual = point.fit.left().norm() / point.fit.run.norm();
  a.gain = point.fit.gain();
  a.other_size = std::nullopt;
  a.shift_error = a.angle_error = std::nullopt;
  a.next = std::nullopt;
  return a;
}

}  // namespace

bool Result::is_exact() const {
  constexpr double kRoundOff = 1e-12;  // of the rms of the run
  return left_before && alignment.residual && *left_before < kRoundOff &&
         *alignment.residual < kRoundOff;
}

bool Result::no_better() const {
  constexpr double kRoundOff = 1e-6;
  return left_before && alignment.residual && !is_exact() &&
         *left_before < *alignment.residual * (1.0 - kRoundOff);
}

double Found::low() const { return std::max(wanted.from, value - kSure * error.value_or(0.0)); }
double Found::high() const { return std::min(wanted.to, value + kSure * error.value_or(0.0)); }

Result identify(const ReadScene& read, MeasuredRecord record, const Parameters& parameters) {
  Residuals residuals(read, std::move(record), parameters);
  Result result;

  const int unknowns = static_cast<int>(residuals.unknowns());
  const int most = (kSearch + 3 * kDescent) * unknowns;
  Descent everywhere(residuals, parameters, most);
  everywhere.search(kSearch * static_cast<int>(residuals.values()));
  result.interrupted = everywhere.stopped();
  if (result.interrupted) return result;
  if (everywhere.best.empty()) {
    throw MeasuredError(
        "the record agrees with no run within the ranges; the units may be wrong, the motion may "
        "be "
        "another one or chaotic; to fit it anyway, give the shift with --measured-shift");
  }
  residuals.align_record(everywhere.best);
  result.samples = residuals.samples();
  std::vector<double> start = everywhere.best;
  start.resize(residuals.unknowns(), 0.5);
  Descent first(residuals, parameters, most);
  first.square(start);
  first.descend(start, 0.05, kDescent * unknowns);

  // Repeated with each channel weighted by its difference.
  Descent second(residuals, parameters, most);
  if (!first.stopped() && !first.best.empty()) {
    if (const auto point = residuals.at(first.best)) residuals.weigh(*point);
    second.square(first.best);
    second.descend(first.best, 0.01, kDescent * unknowns);
    polish(residuals, second);
  }
  result.runs = residuals.runs();
  result.interrupted = second.stopped();
  if (result.interrupted) return result;

  const auto at = linearised(residuals, second.best);
  if (!at)
    throw MeasuredError(
        "a run with values next to the ones found ended early, so their errors are unknown");
  const Known how = known(*at);
  const auto n = static_cast<Index>(parameters.wanted.size());
  for (std::size_t k = 0; k < parameters.wanted.size(); ++k) {
    const double x = second.best[k];
    Found found{parameters.wanted[k], residuals.value(k, x), how.error[k],
                x < kEdge || x > 1.0 - kEdge};
    if (found.error) *found.error *= residuals.slope(k, x);
    result.found.push_back(std::move(found));
  }
  result.correlation = how.correlation.topLeftCorner(n, n);
  result.alignment = alignment_at(residuals, second.best, at->point);
  // In the measure that was minimised: the same samples, weights and reference run.
  if (const auto before = residuals.as_it_stands(); before && result.alignment.residual) {
    result.left_before = before->rms() / at->point.run_rms();
  }
  result.overrides = residuals.overrides(second.best);
  result.runs = residuals.runs();
  return result;
}

}  // namespace rotorub::identify
