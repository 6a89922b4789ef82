#include "native_model/rotor/whirl_branches.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>

#include "native_model/rotor/whirl_eigenvalues.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// s of the mode with |Im s|: a mode of anisotropic planes may change its sense on the way.
Complex eigenvalue(const WhirlMode& mode) {
  const double ratio = std::clamp(mode.damping_ratio, -1.0, 1.0);
  if (mode.frequency == 0.0) return {-ratio, 0.0};
  const double imaginary = std::abs(mode.frequency);
  return {-ratio * imaginary / std::sqrt(std::max(1.0 - ratio * ratio, 1e-12)), imaginary};
}

// Where the branch would be at `speed`, were it straight.
Complex continued(const WhirlBranch& branch, double speed) {
  const std::size_t n = branch.speed.size();
  const Complex last = eigenvalue(branch.modes[n - 1]);
  if (n == 1) return last;
  const Complex slope =
      (last - eigenvalue(branch.modes[n - 2])) / (branch.speed[n - 1] - branch.speed[n - 2]);
  return last + slope * (speed - branch.speed[n - 1]);
}

struct Pair {
  double distance;
  std::size_t branch, mode;
};

// Pairs of a live branch and a mode close enough to be its next one, nearest first.
std::vector<Pair> candidates(const std::vector<WhirlBranch>& branches,
                             const std::vector<std::size_t>& live, const WhirlSpectrum& spectrum,
                             bool isotropic, double step) {
  constexpr double kSlope = 3.0;   // a thin disc's forward whirl rises with twice the spin
  constexpr double kShare = 0.03;  // of |s|
  std::vector<Pair> pairs;
  for (std::size_t b : live) {
    const double last = branches[b].modes.back().frequency;
    const Complex guess = continued(branches[b], spectrum.speed);
    for (std::size_t m = 0; m < spectrum.modes.size(); ++m) {
      // Isotropic planes: forward and backward whirl are different solutions.
      if (isotropic && last * spectrum.modes[m].frequency < 0.0) continue;
      const Complex s = eigenvalue(spectrum.modes[m]);
      const double distance = std::abs(s - guess);
      if (distance <= kSlope * step + kShare * std::abs(s)) pairs.push_back({distance, b, m});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.distance < b.distance; });
  return pairs;
}

// Continues the live branches by a spectrum, and begins new ones; returns those that live on.
std::vector<std::size_t> append(std::vector<WhirlBranch>& branches,
                                const std::vector<std::size_t>& live, const WhirlSpectrum& spectrum,
                                bool isotropic, double step) {
  std::vector<bool> taken(spectrum.modes.size()), continued_branch(branches.size());
  std::vector<std::size_t> next;
  const auto add = [&](std::size_t branch, std::size_t mode) {
    branches[branch].speed.push_back(spectrum.speed);
    branches[branch].modes.push_back(spectrum.modes[mode]);
    taken[mode] = true;
    next.push_back(branch);
  };
  for (const Pair& pair : candidates(branches, live, spectrum, isotropic, step)) {
    if (taken[pair.mode] || continued_branch[pair.branch]) continue;
    continued_branch[pair.branch] = true;
    add(pair.branch, pair.mode);
  }
  for (std::size_t m = 0; m < taken.size(); ++m) {
    if (taken[m]) continue;
    branches.emplace_back();
    add(branches.size() - 1, m);
  }
  return next;
}

WhirlSystem leading(const WhirlSystem& system, Eigen::Index n) {
  const auto block = [&](const Eigen::MatrixXd& matrix) {
    return Eigen::MatrixXd(matrix.topLeftCorner(n, n));
  };
  WhirlSystem part = system;
  for (Eigen::MatrixXd* matrix :
       {&part.stiffness_x, &part.stiffness_y, &part.damping_x, &part.damping_y, &part.gyroscopic,
        &part.internal_xx, &part.internal_xy, &part.internal_yy}) {
    *matrix = block(*matrix);
  }
  for (WhirlFilm& film : part.films) film.station = film.station.head(n).eval();
  return part;
}

bool agree(const std::vector<Complex>& a, const std::vector<Complex>& b, double accuracy) {
  if (a.size() != b.size()) return false;
  for (std::size_t j = 0; j < a.size(); ++j) {
    if (std::abs(a[j] - b[j]) > accuracy * std::abs(b[j])) return false;
  }
  return true;
}

}  // namespace

WhirlSystem condensed(const WhirlSystem& system, double speed, double accuracy) {
  Eigen::Index n = 2 * Eigen::Index{system.kept} + 4;
  if (n >= system.size()) return system;
  const std::vector<Complex> at_rest = whirl_eigenvalues(system, 0.0);
  const std::vector<Complex> at_speed = whirl_eigenvalues(system, speed);
  for (; n < system.size(); n += n / 2) {
    WhirlSystem part = leading(system, n);
    if (agree(whirl_eigenvalues(part, 0.0), at_rest, accuracy) &&
        agree(whirl_eigenvalues(part, speed), at_speed, accuracy)) {
      return part;
    }
  }
  return system;
}

std::vector<WhirlBranch> whirl_branches(const WhirlSystem& system,
                                        const std::vector<double>& speeds,
                                        const std::function<void(double)>& progress) {
  std::vector<WhirlBranch> branches;
  std::vector<std::size_t> live;
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    const double step = k > 0 ? speeds[k] - speeds[k - 1] : 0.0;
    assert(step >= 0.0);
    live = append(branches, live, whirl_spectrum(system, speeds[k]), system.isotropic, step);
    if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(speeds.size()));
  }
  std::stable_sort(
      branches.begin(), branches.end(), [](const WhirlBranch& a, const WhirlBranch& b) {
        return std::abs(a.modes.front().frequency) < std::abs(b.modes.front().frequency);
      });
  return branches;
}

std::vector<double> even_speeds(double highest, int count) {
  assert(count >= 2);
  std::vector<double> speeds;
  for (int k = 0; k < count; ++k) speeds.push_back(highest * k / (count - 1));
  return speeds;
}

}  // namespace rotorub
