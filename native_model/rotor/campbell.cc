#include "native_model/rotor/campbell.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <optional>

#include "native_model/numerics/symmetric_eigenvalues.h"
#include "native_model/rotor/refusal.h"
#include "native_model/rotor/whirl_eigenvalues.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// |s| below this share of the highest is a rigid mode: what it has is round-off.
constexpr double kRigid = 1e-7;

double highest(const std::vector<Complex>& values) {
  double size = 0.0;
  for (const Complex& s : values) size = std::max(size, std::abs(s));
  return size;
}

// Largest Re s / |s| of the kept modes: > 0 where one grows.
double growth(const WhirlSystem& system, double speed) {
  const std::vector<Complex> values = whirl_eigenvalues(system, speed);
  const double size = highest(values);
  double largest = -1.0;
  for (const Complex& s : values) {
    if (std::abs(s) > kRigid * size) largest = std::max(largest, s.real() / std::abs(s));
  }
  return largest;
}

// Nothing can grow: no rotating damping, no oil film, and no negative stiffness left in either plane.
bool passive(const WhirlSystem& system) {
  const auto holds = [](const Eigen::MatrixXd& K) {
    constexpr double kRoundOff = 1e-14;
    const std::optional<Eigen::VectorXd> values = symmetric_eigenvalues(K);
    if (!values) throw RotorNotSolvable("no eigenvalues can be found");
    return values->minCoeff() >= -kRoundOff * values->maxCoeff();
  };
  return system.films.empty() && system.internal_xy.isZero(0.0) && holds(system.stiffness_x) && holds(system.stiffness_y);
}

// Zero of growth between a stable and an unstable speed: Ridders' method, which keeps the bracket.
double crossing(const WhirlSystem& system, double stable, double unstable) {
  constexpr double kAccuracy = 1e-10;
  constexpr int kSteps = 60;
  double low = growth(system, stable), high = growth(system, unstable);
  double last = unstable;
  const auto narrow = [&](double speed, double value) {
    (value > 0.0 ? unstable : stable) = speed;
    (value > 0.0 ? high : low) = value;
  };
  for (int step = 0; step < kSteps && unstable - stable > kAccuracy * unstable; ++step) {
    const double half = 0.5 * (unstable - stable);
    const double middle = stable + half;
    const double value = growth(system, middle);
    const double root = std::sqrt(value * value - low * high);
    const bool usable = low < 0.0 && high > 0.0 && root > 0.0;
    const double better = middle - half * value / root;  // low < 0: towards the stable side if > 0
    narrow(middle, value);
    if (!usable || !(better > stable && better < unstable)) continue;
    const double best = growth(system, better);
    narrow(better, best);
    if (best == 0.0 || std::abs(better - last) <= kAccuracy * better) return better;
    last = better;
  }
  return unstable;
}

}  // namespace

WhirlSpectrum whirl_spectrum(const WhirlSystem& system, double speed) {
  std::vector<Complex> values = whirl_eigenvalues(system, speed);
  if (speed == 0.0 && !system.isotropic) {
    // Orbits at rest are planar: their sense is that of the orbits at a small spin. Frequencies
    // keep their order, so that the senses carry over one by one.
    constexpr double kSmallSpin = 1e-3;
    const std::vector<Complex> spun =
        whirl_eigenvalues(system, kSmallSpin * std::abs(values.front()));
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (values[j].imag() * spun[j].imag() < 0.0) values[j] = std::conj(values[j]);
    }
  }
  WhirlSpectrum spectrum{speed, {}};
  for (const Complex& s : values) {
    const double size = std::abs(s);
    spectrum.modes.push_back({s.imag(), size > 0.0 ? (0.0 - s.real()) / size : 0.0});
  }
  return spectrum;
}

double stability_bound(const WhirlSystem& system) {
  if (passive(system)) return std::numeric_limits<double>::infinity();
  constexpr double kBound = 20.0;
  return kBound * highest(whirl_eigenvalues(system, 0.0));
}

std::optional<double> stability_threshold(const WhirlSystem& system) {
  if (passive(system)) return std::nullopt;
  constexpr double kGrows = 1e-9;  // of |s|: beyond the round-off of an undamped mode
  constexpr double kStep = 1.25;
  constexpr double kFirst = 0.1;  // of the lowest frequency
  if (growth(system, 0.0) > kGrows) return 0.0;

  const double bound = stability_bound(system);
  double lowest = bound;
  for (const Complex& s : whirl_eigenvalues(system, 0.0)) {
    if (std::abs(s) > kRigid * bound) lowest = std::min(lowest, std::abs(s));
  }
  double stable = 0.0;
  for (double speed = kFirst * lowest; stable < bound; speed *= kStep) {
    const double next = std::min(speed, bound);
    if (growth(system, next) > kGrows) return crossing(system, stable, next);
    stable = next;
  }
  return std::nullopt;
}

}  // namespace rotorub
