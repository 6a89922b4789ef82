#include "compare/metrics/spectrum.h"

#include <fftw3.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// The transform of one length. FFTW_ESTIMATE: the plan does not hang on what a measurement gave.
class Transform {
 public:
  explicit Transform(std::size_t size)
      : size_(size),
        values_(fftw_alloc_complex(size)),
        plan_(fftw_plan_dft_1d(static_cast<int>(size), values_, values_, FFTW_FORWARD, FFTW_ESTIMATE)) {
    for (std::size_t n = 0; n < size; ++n) {
      const double turn = static_cast<double>(n) / static_cast<double>(size);
      window_.push_back(0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * turn));
      weight_ += window_.back();
    }
  }
  ~Transform() {
    fftw_destroy_plan(plan_);
    fftw_free(values_);
  }
  Transform(const Transform&) = delete;
  Transform& operator=(const Transform&) = delete;

  // Hz, of every size in order of amplitudes().
  std::vector<double> frequencies(double h) const {
    std::vector<double> all;
    const auto whole = static_cast<double>(size_);
    for (std::size_t k = 0; k < size_; ++k) {
      all.push_back((static_cast<double>(k) - static_cast<double>(size_ / 2)) / (whole * h));
    }
    return all;
  }
  void append(std::span<const Complex> z, std::vector<double>& amplitude) {
    assert(z.size() == size_);
    Complex mean = 0.0;
    for (const Complex& value : z) mean += value;
    mean /= static_cast<double>(size_);
    for (std::size_t n = 0; n < size_; ++n) {
      const Complex value = window_[n] * (z[n] - mean);
      values_[n][0] = value.real();
      values_[n][1] = value.imag();
    }
    fftw_execute(plan_);
    for (std::size_t k = 0; k < size_; ++k) {
      const std::size_t at = (k + size_ - size_ / 2) % size_;  // the negative ones first
      amplitude.push_back(std::hypot(values_[at][0], values_[at][1]) / weight_);
    }
  }

 private:
  std::size_t size_;
  fftw_complex* values_;
  fftw_plan plan_;
  std::vector<double> window_;
  double weight_ = 0.0;
};

}  // namespace

FullSpectrum full_spectrum(std::span<const Complex> z, double h) {
  assert(z.size() >= 2 && h > 0.0);
  Transform transform(z.size());
  FullSpectrum spectrum{transform.frequencies(h), {}};
  transform.append(z, spectrum.amplitude);
  return spectrum;
}

Waterfall waterfall(std::span<const Complex> z, double h, std::size_t stretch) {
  assert(stretch >= 4 && stretch <= z.size() && h > 0.0);
  Transform transform(stretch);
  Waterfall all{{}, transform.frequencies(h), {}};
  for (std::size_t first = 0; first + stretch <= z.size(); first += stretch / 4) {
    all.time.push_back(h * (static_cast<double>(first) + 0.5 * static_cast<double>(stretch)));
    transform.append(z.subspan(first, stretch), all.amplitude);
  }
  return all;
}

std::vector<Complex> even_orbit(const Trajectory& run, double from, double to, std::size_t count) {
  assert(count >= 2 && run.rows() >= 2);
  const std::vector<double>& t = run.column("t");
  const auto value = [&](const char* x, const char* y, std::size_t row) {
    return Complex(run.column(x)[row], run.column(y)[row]);
  };
  std::vector<Complex> z;
  std::size_t row = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = from + (to - from) * static_cast<double>(k) / static_cast<double>(count - 1);
    while (row + 2 < t.size() && t[row + 1] <= at) ++row;
    const double h = t[row + 1] - t[row], s = std::clamp((at - t[row]) / h, 0.0, 1.0);
    const Complex a = value("rotor_x", "rotor_y", row), b = value("rotor_x", "rotor_y", row + 1);
    const Complex va = value("rotor_vx", "rotor_vy", row), vb = value("rotor_vx", "rotor_vy", row + 1);
    z.push_back(a + s * s * (3.0 - 2.0 * s) * (b - a) +
                h * s * (1.0 - s) * ((1.0 - s) * va - s * vb));
  }
  return z;
}

}  // namespace rotorub
