#include "native_model/rotor/whirl_eigenvalues.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/lowest_modes.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// Velocities and W q as state, W about the frequencies: all entries are then of the size of a
// frequency, whatever the mode. A coordinate without a stiffness is left as it is.
Eigen::VectorXd state_scale(const Eigen::MatrixXd& stiffness) {
  return stiffness.diagonal().unaryExpr([](double k) { return k > 0.0 ? std::sqrt(k) : 1.0; });
}

// Sense of the orbit x = Re(x^ e^{st}), y = Re(y^ e^{st}), Im s > 0: the sign of its angular
// momentum, sum Im(x^ conj(y^)) in coordinates of unit mass; planar to round-off: forward.
bool forward(const Eigen::VectorXcd& x, const Eigen::VectorXcd& y) {
  constexpr double kPlanar = 1e-10;
  const double momentum = (x.array() * y.array().conjugate()).imag().sum();
  return momentum > -kPlanar * (x.squaredNorm() + y.squaredNorm());
}

void sort_by_frequency(std::vector<Whirl>& all) {
  std::sort(all.begin(), all.end(), [](const Whirl& a, const Whirl& b) {
    return std::abs(a.s.imag()) < std::abs(b.s.imag());
  });
  // Whirl at rest comes in pairs that differ by round-off alone: backward first, as it is at speed.
  constexpr double kEqual = 1e-9;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const double first = all[i].s.imag(), second = all[i + 1].s.imag();
    const bool equal = std::abs(second) - std::abs(first) <= kEqual * std::abs(first);
    if (equal && first > 0.0 && second < 0.0) std::swap(all[i], all[i + 1]);
  }
}

// Well below the lowest mode, and off a rigid one.
double shift_of(const Eigen::VectorXd& W) { return 0.05 * W.minCoeff(); }

std::vector<Whirl> with_rates(const LowestModes& modes) {
  std::vector<Whirl> all;
  for (Eigen::Index j = 0; j < modes.values.size(); ++j)
    all.push_back({modes.values[j], modes.rates.col(j)});
  return all;
}
// Of all of them: of a first-order form whose state ends with q'.
LowestModes all_of(std::optional<EigenModes> modes) {
  if (!modes) throw RotorNotSolvable("no eigenvalues can be found");
  return {std::move(modes->values), modes->vectors.bottomRows(modes->vectors.rows() / 2)};
}

void sort_by_size(std::vector<Whirl>& all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const Whirl& a, const Whirl& b) { return std::abs(a.s) < std::abs(b.s); });
}

// The lowest by |s|, which overdamping does not make small: as many of each sense, since the spin
// lowers backward whirl and lifts the other. Each eigenvalue is one whirl.
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

// Both planes as real equations. Of each complex pair one eigenvalue stands for the whirl, and of
// the real ones, which also come in twos, every other, the greatest first.
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

}  // namespace

std::vector<Whirl> whirls(const WhirlSystem& system, double speed) {
  std::vector<Whirl> all =
      system.isotropic ? isotropic_whirls(system, speed) : anisotropic_whirls(system, speed);
  sort_by_frequency(all);
  return all;
}

std::vector<Complex> whirl_eigenvalues(const WhirlSystem& system, double speed) {
  std::vector<Complex> s;
  for (const Whirl& whirl : whirls(system, speed)) s.push_back(whirl.s);
  return s;
}

}  // namespace rotorub
