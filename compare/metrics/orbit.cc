#include "compare/metrics/orbit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "compare/metrics/fourier.h"
#include "compare/metrics/rows.h"

namespace rotorub {

namespace {

using Complex = std::complex<double>;

// The transform for one length under a Hann window, padded with zeros to `finer` times the length.
class Transform {
 public:
  explicit Transform(std::size_t values, std::size_t finer = 1)
      : values_(static_cast<Eigen::Index>(values)),
        size_(static_cast<Eigen::Index>(finer * values)),
        window_(hann_window(values_)) {}

  // Hz, in the order of the amplitudes.
  std::vector<double> frequencies(double h) const {
    std::vector<double> all;
    for (Eigen::Index k = 0; k < size_; ++k) {
      all.push_back(static_cast<double>(k - size_ / 2) / (static_cast<double>(size_) * h));
    }
    return all;
  }
  void append(std::span<const Complex> z, std::vector<double>& amplitude) {
    const Eigen::Map<const Eigen::ArrayXcd> all(z.data(), values_);
    Eigen::VectorXcd padded = Eigen::VectorXcd::Zero(size_);
    padded.head(values_) = windowed(all, window_);
    fourier_.fwd(spectrum_, padded);
    const Eigen::ArrayXd size = spectrum_.array().abs() / window_.sum();
    const auto first = size.begin() + (size_ - size_ / 2);  // negative frequencies first
    amplitude.insert(amplitude.end(), first, size.end());
    amplitude.insert(amplitude.end(), size.begin(), first);
  }

 private:
  Eigen::Index values_, size_;
  Eigen::ArrayXd window_;
  Eigen::FFT<double> fourier_;
  Eigen::VectorXcd spectrum_;
};

}  // namespace

FullSpectrum full_spectrum(std::span<const Complex> z, double h, std::size_t finer) {
  assert(z.size() >= 2 && h > 0.0 && finer >= 1);
  Transform transform(z.size(), finer);
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

namespace {

// The rotor at the contact at ascending times within the run.
std::vector<Complex> orbit_at(const Trajectory& run, const std::vector<double>& times) {
  const auto along = [&](const char* place, const char* rate) {
    return cubic(run.column("t"), run.column(place), run.column(rate), times);
  };
  const std::vector<double> x = along("rotor_x", "rotor_vx"), y = along("rotor_y", "rotor_vy");
  std::vector<Complex> z;
  for (std::size_t k = 0; k < times.size(); ++k) z.emplace_back(x[k], y[k]);
  return z;
}

}  // namespace

std::vector<Complex> even_orbit(const Trajectory& run, double from, double to, std::size_t count) {
  assert(count >= 2 && run.rows() >= 2);
  return orbit_at(run, even_times(from, to, count));
}

std::vector<Complex> poincare_points(const Trajectory& run, double from) {
  std::vector<Complex> points;
  for (const KeyphasorPass& pass : run.keyphasor) {
    if (pass.t >= from) points.emplace_back(pass.x, pass.y);
  }
  return points;
}

int section_period(const std::vector<Complex>& places, double tolerance) {
  double size = 0.0;
  for (const Complex& place : places) size = std::max(size, std::abs(place));
  for (int turns = 1; turns <= kMostPeriod; ++turns) {
    const auto apart = static_cast<std::size_t>(turns);
    if (places.size() < 2 * apart + 2) return 0;
    bool back = true;
    for (std::size_t k = apart; back && k < places.size(); ++k)
      back = std::abs(places[k] - places[k - apart]) <= tolerance * size;
    if (back) return turns;
  }
  return 0;
}

}  // namespace rotorub
