#include "native_model/linear/campbell.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <utility>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// Scale W of the state (W q, q'), about the frequencies: all entries are then of the size of a
// frequency for every mode. A coordinate without stiffness is left unscaled.
Eigen::VectorXd state_scale(const Eigen::MatrixXd& stiffness) {
  return stiffness.diagonal().unaryExpr([](double k) { return k > 0.0 ? std::sqrt(k) : 1.0; });
}

// Sense of the orbit x = Re(x^ e^{st}), y = Re(y^ e^{st}), Im s > 0: the sign of its angular
// momentum, sum Im(x^ conj(y^)) in coordinates of unit mass. An orbit that is planar to round-off
// counts as forward.
bool forward(const Eigen::VectorXcd& x, const Eigen::VectorXcd& y) {
  constexpr double kPlanar = 1e-10;
  const double momentum = (x.array() * y.array().conjugate()).imag().sum();
  return momentum > -kPlanar * (x.squaredNorm() + y.squaredNorm());
}

// Shift of the Arnoldi iteration: well below the lowest mode, and not at a rigid one.
double shift_of(const Eigen::VectorXd& W) { return 0.05 * W.minCoeff(); }

std::vector<Whirl> with_rates(const LowestModes& modes) {
  std::vector<Whirl> all;
  for (Eigen::Index j = 0; j < modes.values.size(); ++j)
    all.push_back({modes.values[j], modes.rates.col(j)});
  return all;
}
// All modes of a first-order form whose state ends with q'.
LowestModes all_of(std::optional<EigenModes> found) {
  const EigenModes modes = found_by(std::move(found));
  return {modes.values, modes.vectors.bottomRows(modes.vectors.rows() / 2)};
}

void sort_by_size(std::vector<Whirl>& all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Whirl& a, const Whirl& b) { return std::abs(a.s) < std::abs(b.s); });
}

// The lowest whirls by |s|, as many of each sense, since the spin lowers backward whirl and raises
// forward whirl. Overdamping does not make |s| small. Each eigenvalue is one whirl.
std::vector<Whirl> lowest_of_each_sense(std::vector<Whirl> all, std::size_t kept) {
  constexpr double kReal = 1e-9;  // |Im s| / |s| of an overdamped mode, which has no sense
  sort_by_size(all);
  std::vector<Whirl> chosen;
  std::size_t forward_count = 0, backward_count = 0;
  for (Whirl& whirl : all) {
    const bool real = std::abs(whirl.s.imag()) <= kReal * std::abs(whirl.s);
    const bool is_forward = real ? forward_count <= backward_count : whirl.s.imag() > 0.0;
    std::size_t& count = is_forward ? forward_count : backward_count;
    if (count == kept) continue;
    ++count;
    chosen.push_back(std::move(whirl));
  }
  return chosen;
}

std::vector<Whirl> isotropic_whirls(const WhirlSystem& system, double speed) {
  const auto [B, C] = isotropic_matrices(system, speed);
  const Eigen::VectorXd W = state_scale(system.stiffness_x);
  const auto kept = static_cast<std::size_t>(system.kept);
  const auto enough = [&](const Eigen::VectorXcd& values) {
    std::vector<Whirl> all;
    for (const Complex& s : values) all.push_back({s, {}});
    return lowest_of_each_sense(std::move(all), kept).size() == 2 * kept;
  };
  auto part = lowest_modes(B, C, W, shift_of(W), 2 * system.kept, enough);
  if (!part) part = all_of(complex_modes(first_order_form(B, C, W)));
  return lowest_of_each_sense(with_rates(*part), kept);
}

// Both planes as real equations. One eigenvalue of each complex pair stands for the whirl. Real
// eigenvalues also come in pairs; of these every other one counts, the greatest first.
std::vector<Whirl> anisotropic_whirls(const WhirlSystem& system, double speed) {
  const Eigen::Index n = system.size();
  const auto [B, C] = planes_matrices(system, speed);
  Eigen::VectorXd W(2 * n);
  W << state_scale(system.stiffness_x), state_scale(system.stiffness_y);
  const auto enough = [&](const Eigen::VectorXcd& values) {
    const auto real = (values.imag().array() == 0.0).count();
    return (values.imag().array() > 0.0).count() + real / 2 >= 2 * system.kept;
  };
  auto part = lowest_modes(B, C, W, shift_of(W), 4 * system.kept, enough);
  if (!part) part = all_of(real_modes(first_order_form(B, C, W)));

  std::vector<Whirl> all, real;
  for (Whirl& whirl : with_rates(*part)) {
    const Complex s = whirl.s;
    if (s.imag() < 0.0) continue;
    if (s.imag() > 0.0 && !forward(whirl.rates.head(n), whirl.rates.tail(n)))
      whirl.s = std::conj(s);
    (s.imag() > 0.0 ? all : real).push_back(std::move(whirl));
  }
  std::sort(real.begin(), real.end(),
            [](const Whirl& a, const Whirl& b) { return a.s.real() > b.s.real(); });
  for (std::size_t i = 0; i < real.size(); i += 2) all.push_back(std::move(real[i]));
  sort_by_size(all);
  const auto most = 2 * static_cast<std::size_t>(system.kept);
  if (all.size() > most) all.erase(all.begin() + static_cast<std::ptrdiff_t>(most), all.end());
  return all;
}

// s of the mode with |Im s|, since a mode of anisotropic planes may change its sense along the
// branch.
Complex eigenvalue(const WhirlMode& mode) {
  const double ratio = std::clamp(mode.damping_ratio, -1.0, 1.0);
  if (mode.frequency == 0.0) return {-ratio, 0.0};
  const double imaginary = std::abs(mode.frequency);
  return {-ratio * imaginary / std::sqrt(std::max(1.0 - ratio * ratio, 1e-12)), imaginary};
}

// Linear extrapolation of the branch to `speed`.
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

// Continues the live branches by a spectrum and begins new ones; returns the branches that
// continue.
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
  for (ModeShape& at : part.contacts) at = {at.x.head(n).eval(), at.y.head(n).eval()};
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

std::vector<Whirl> whirls(const WhirlSystem& system, double speed) {
  std::vector<Whirl> all =
      system.isotropic ? isotropic_whirls(system, speed) : anisotropic_whirls(system, speed);
  sort_by_frequency(all, [](const Whirl& whirl) { return whirl.s.imag(); });
  return all;
}

std::vector<Complex> whirl_eigenvalues(const WhirlSystem& system, double speed) {
  std::vector<Complex> s;
  for (const Whirl& whirl : whirls(system, speed)) s.push_back(whirl.s);
  return s;
}

WhirlSpectrum whirl_spectrum(const WhirlSystem& system, double speed) {
  std::vector<std::complex<double>> values = whirl_eigenvalues(system, speed);
  if (speed == 0.0 && !system.isotropic) {
    // Orbits at rest are planar, so their sense is taken from the orbits at a small spin. The order
    // of the frequencies does not change, so the senses carry over one by one.
    constexpr double kSmallSpin = 1e-3;
    const std::vector<std::complex<double>> spun =
        whirl_eigenvalues(system, kSmallSpin * std::abs(values.front()));
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (values[j].imag() * spun[j].imag() < 0.0) values[j] = std::conj(values[j]);
    }
  }
  WhirlSpectrum spectrum{speed, {}};
  for (const std::complex<double>& s : values) {
    const double size = std::abs(s);
    // Adding to 0 avoids -0 for an overdamped mode.
    spectrum.modes.push_back({s.imag() + 0.0, size > 0.0 ? (0.0 - s.real()) / size : 0.0});
  }
  return spectrum;
}

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
