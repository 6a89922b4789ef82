// A single step of DOP853, order 8 with an error estimate of order 5(3) and dense output of order 7
// (Hairer, Norsett, Wanner, section II.10). The caller controls time, step size and events.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "native_model/numerics/dop853_tableau.h"

namespace rotorub {

class Dop853 {
 public:
  static constexpr int kDenseTerms = 7;

  // size: number of components of y. All storage is allocated here.
  explicit Dop853(int size)
      : size_(size),
        padded_((size + kBlock - 1) / kBlock * kBlock),
        stages_(static_cast<std::size_t>(padded_ * dop853::kExtendedStages)),
        dense_(static_cast<std::size_t>(padded_ * kDenseTerms)),
        start_(static_cast<std::size_t>(padded_)),
        end_(start_),
        work_(start_),
        fifth_(start_),
        third_(start_) {}

  // f(t, y) at the start of the next step. Set it before the first step and after every jump of y
  // or f.
  double* first_slope() { return stage(0); }

  // A trial step from (t, y) over h; f(t, y, dy) fills dy. Returns the error relative to the
  // tolerance, max over components of |error_i| / tolerance_i; accept the step if it is <= 1.
  // Components with an infinite tolerance are integrated but not checked.
  template <class F>
  double trial(F&& f, double t, const double* y, double h, const double* tolerance) {
    using namespace dop853;
    std::copy_n(y, size_, start_.begin());
    step_ = h;
    for (int s = 1; s < kStages; ++s) {
      combine(kMatrix[static_cast<std::size_t>(s)], work_.data());
      f(t + kNodes[static_cast<std::size_t>(s)] * h, work_.data(), stage(s));
    }
    combine(kMatrix[kStages], end_.data());
    f(t + h, end_.data(), stage(kStages));
    return error(tolerance);
  }

  // Estimates the fastest rate of the system, for a step at its stability limit, by
  // |f(a) - f(b)| / |a - b| in units of the tolerance, where a and b are the states of the last
  // stage and of the end, both at the same time. Also finds the component that changes fastest.
  // Call it after a trial and before prepare_dense.
  struct Fastest {
    double rate = 0.0;
    int component = 0;
  };
  Fastest fastest(const double* tolerance) const {
    double slopes = 0.0, states = 0.0, largest = 0.0;
    Fastest found;
    for (int i = 0; i < size_; ++i) {
      if (std::isinf(tolerance[i])) continue;
      const auto k = static_cast<std::size_t>(i);
      const double slope =
          (stage(dop853::kStages)[i] - stage(dop853::kStages - 1)[i]) / tolerance[i];
      const double state = (end_[k] - work_[k]) / tolerance[i];
      slopes += slope * slope;
      states += state * state;
      if (std::abs(slope) > largest) largest = std::abs(slope), found.component = i;
    }
    if (states > 0.0) found.rate = std::sqrt(slopes / states);
    return found;
  }

  const double* end() const { return end_.data(); }

  // Computes the extra stages of the dense output, after a trial. The terms are computed on demand;
  // request them before advance() or a new first slope. t: start of the step.
  template <class F>
  void prepare_dense(F&& f, double t) {
    using namespace dop853;
    for (int s = kStages + 1; s < kExtendedStages; ++s) {
      combine(kMatrix[static_cast<std::size_t>(s)], work_.data());
      f(t + kNodes[static_cast<std::size_t>(s)] * step_, work_.data(), stage(s));
    }
    known_ = 0;
    known_alone_ = kNone;
  }

  // y(t + theta h) - y(t), theta in [0, 1], in nested form:
  // theta (F_0 + (1 - theta)(F_1 + theta (...))).
  void increment(double theta, double* y) {
    find_all_terms();
    for (int i = 0; i < size_; ++i) y[i] = nested(i, theta);
  }
  // The same for one component, which computes only that component's terms.
  double increment(int i, double theta) {
    find_terms_of(i);
    return nested(i, theta);
  }
  void find_terms_of(int i) {
    if (known_ == size_ || known_alone_ == i) return;
    known_alone_ = i;
    find_first_terms(i);
    for (int d = 0; d < 4; ++d) {
      double sum = 0.0;
      for (const dop853::Term& w : row_of_dense(d)) sum += w.weight * stage(w.column)[i];
      dense_term(3 + d)[i] = step_ * sum;
    }
  }
  // Increment of a component whose terms have been computed.
  double nested(int i, double theta) const {
    const double* terms = dense_.data() + i;
    double sum = 0.0;
    for (int d = kDenseTerms - 1; d >= 0; --d) {
      sum = (sum + terms[static_cast<std::ptrdiff_t>(d) * padded_]) *
            (d % 2 == 0 ? theta : 1.0 - theta);
    }
    return sum;
  }
  void dense(double theta, double* y) {
    increment(theta, y);
    for (int i = 0; i < size_; ++i) y[i] += start_[static_cast<std::size_t>(i)];
  }
  // F_d of the nested form, for polynomials in theta of functions of y.
  const double* term(int d) {
    find_all_terms();
    return dense_term(d);
  }

  // Makes the end of the last trial the start of the next step, whose slope is then known.
  void advance() { std::copy_n(stage(dop853::kStages), size_, stage(0)); }
  // Factor for the length of the next step, or of a repeated one, after a step with this error (1:
  // the tolerance). error^(-1/8) is computed by square roots, whose bits, unlike those of pow, are
  // the same on every processor.
  static double step_factor(double error) {
    if (error == 0.0) return 6.0;
    return std::clamp(0.9 * (1.0 / std::sqrt(std::sqrt(std::sqrt(error)))), 0.2, 6.0);
  }
  double step() const { return step_; }
  int size() const { return size_; }

 private:
  // Sums over the stages process the components in blocks (numerics/small_matrix.h). The storage is
  // padded with zeros to whole blocks.
  static constexpr int kBlock = 8;
  static constexpr int kNone = -1;
  static constexpr double kRunsAway = 1e12;  // in tolerances; far above any normal error

  double* stage(int s) { return stages_.data() + static_cast<std::ptrdiff_t>(s) * padded_; }
  const double* stage(int s) const {
    return stages_.data() + static_cast<std::ptrdiff_t>(s) * padded_;
  }
  double* dense_term(int d) { return dense_.data() + static_cast<std::ptrdiff_t>(d) * padded_; }

  // y = start + h times the weighted sum of the stages.
  void combine(const dop853::Row& row, double* y) {
    small_matrix::combine(stages_.data(), padded_, row, step_, start_.data(), y);
  }

  // F_0, F_1, F_2 of a component, from its values and slopes at both ends.
  void find_first_terms(int i) {
    const auto k = static_cast<std::size_t>(i);
    const double dy = end_[k] - start_[k], f0 = stage(0)[i], f1 = stage(dop853::kStages)[i];
    dense_term(0)[i] = dy;
    dense_term(1)[i] = step_ * f0 - dy;
    dense_term(2)[i] = 2.0 * dy - step_ * (f1 + f0);
  }
  void find_all_terms() {
    if (known_ == size_) return;
    for (int i = 0; i < size_; ++i) find_first_terms(i);
    for (int d = 0; d < 4; ++d) {
      small_matrix::combine(stages_.data(), padded_, row_of_dense(d), step_, nullptr,
                            dense_term(3 + d));
    }
    known_ = size_;
  }
  static std::span<const dop853::Term> row_of_dense(int d) {
    return dop853::kDense[static_cast<std::size_t>(d)];
  }

  // Hairer's combination of the two estimates, with the largest component of each:
  // |h| e5^2 / sqrt(e5^2 + 0.01 e3^2).
  double error(const double* tolerance) {
    using namespace dop853;
    small_matrix::combine(stages_.data(), padded_, kFifth, 1.0, nullptr, fifth_.data());
    small_matrix::combine(stages_.data(), padded_, kThirdOfStep, 1.0, nullptr, third_.data());
    double largest5 = 0.0, largest3 = 0.0;
    for (int i = 0; i < size_; ++i) {
      const double e5 = fifth_[static_cast<std::size_t>(i)];
      const double e3 = third_[static_cast<std::size_t>(i)];
      if (!std::isfinite(e5) || !std::isfinite(e3)) return std::numeric_limits<double>::infinity();
      if (std::isinf(tolerance[i])) continue;
      largest5 = std::max(largest5, std::abs(e5) / tolerance[i]);
      largest3 = std::max(largest3, std::abs(e3) / tolerance[i]);
    }
    if (largest5 == 0.0) return 0.0;
    // The stages of a nonlinear force can diverge so that each is the square of the one before.
    // Then e3 is of the size of e5^2, and the combination would be small.
    const double size = std::abs(step_) * std::max(largest5, largest3);
    if (!(size < kRunsAway)) return std::numeric_limits<double>::infinity();
    return std::abs(step_) * largest5 * largest5 /
           std::sqrt(largest5 * largest5 + 0.01 * largest3 * largest3);
  }

  int size_, padded_;
  int known_ = 0;            // number of components with known dense terms: none or all
  int known_alone_ = kNone;  // a single component with known terms, while known_ is 0
  double step_ = 0.0;
  std::vector<double> stages_, dense_, start_, end_, work_;
  std::vector<double> fifth_, third_;  // error estimates per unit of the step's length
};

}  // namespace rotorub
