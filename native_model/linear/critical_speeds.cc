// Critical speeds: the points of the Campbell diagram where a whirl is synchronous with the spin.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/linear/spring_crossings.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/numerics/root.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

// K u = Omega^2 A u, real; each critical speed occurs `each` times among the eigenvalues.
struct Synchronous {
  Eigen::MatrixXd K, A;
  std::size_t most = 0;  // number of critical speeds of interest, the lowest
  std::size_t each = 1;
};

// Every `each`-th of the ascending values.
std::vector<double> once(const std::vector<double>& values, std::size_t each) {
  std::vector<double> found;
  for (std::size_t k = 0; k < values.size(); k += each) found.push_back(values[k]);
  return found;
}

// Positive Omega of K u = Omega^2 A u. K is symmetric unless magnets sense elsewhere; A is
// symmetric but not necessarily definite.
std::vector<double> synchronous_speeds(const Synchronous& of) {
  const auto& [K, A, most, each] = of;
  std::vector<double> inverse_squares;
  if (K == K.transpose() && Cholesky(K).positive()) {
    const Eigen::VectorXd values = found_by(symmetric_eigenvalues(A, K));
    inverse_squares.assign(values.begin(), values.end());
  } else {
    // With magnets stronger than the shaft, or that sense elsewhere, the real eigenvalues of K^-1 A
    // count. Round-off separates two equal eigenvalues by its square root.
    const double real = each > 1 ? 1e-6 : 1e-9;
    for (const std::complex<double>& mu : found_by(real_eigenvalues(full_lu_solve(K, A)))) {
      if (std::abs(mu.imag()) <= real * std::abs(mu)) inverse_squares.push_back(mu.real());
    }
  }
  std::vector<double> speeds;
  for (double mu : inverse_squares) {
    if (mu > 0.0) speeds.push_back(1.0 / std::sqrt(mu));
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

// Conservative springs of a bearing as stiffnesses along directions: k_xx, k_yy, and for the
// coupling of the planes the mean of k_xy and k_yx, which is a spring along the diagonal minus its
// own stiffness along the axes. The rest, (k_xy - k_yx) / 2, drives whirl like a negative damper.
struct Springs {
  double x, y, diagonal;
};
Springs springs_of(const WhirlFilm& film, double speed) {
  const BearingCoefficients c = film.law.at(speed);
  const double across = 0.5 * (c[1] + c[2]);
  return {c[0] - across, c[3] - across, 2.0 * across};
}

// Whether a spring of any bearing couples the planes, at any speed.
bool crosses(const WhirlSystem& system) {
  return std::ranges::any_of(system.films, [&](const WhirlFilm& film) {
    std::vector<double> speeds{0.0};
    if (film.law.follows()) speeds = film.law.table->speeds();
    return std::ranges::any_of(
        speeds, [&](double speed) { return springs_of(film, speed).diagonal != 0.0; });
  });
}

// Problem with the springs that the bearings have at one speed, for forward and backward whirl that
// is synchronous with the spin:
//   isotropic  x + i y ~ e^{i Omega t}:    K, 1 - G;
//   else       (x, -i y) ~ e^{i Omega t}:  K_x and K_y, 1 + [0 G; G^T 0];
//   crossed    (x, y) ~ e^{i Omega t}:     K, 1 + i B, B = [0 -G; G^T 0], Hermitian: as real and
//              imaginary parts [K 0; 0 K] and [1 -B; B 1], in which each eigenvalue occurs twice.
Synchronous synchronous(const WhirlSystem& system, double speed, bool crossed) {
  using Eigen::MatrixXd;
  const Eigen::Index n = system.size();
  const auto kept = static_cast<std::size_t>(system.kept);
  MatrixXd stiffness_x = system.stiffness_x, stiffness_y = system.stiffness_y,
           cross = MatrixXd::Zero(n, n);
  for (const WhirlFilm& film : system.films) {
    const Springs springs = springs_of(film, speed);
    const MatrixXd uu = film.station * film.station.transpose();
    stiffness_x += (springs.x + 0.5 * springs.diagonal) * uu;
    stiffness_y += (springs.y + 0.5 * springs.diagonal) * uu;
    cross += 0.5 * springs.diagonal * uu;
  }
  if (system.isotropic) {
    return {stiffness_x, MatrixXd::Identity(n, n) - system.gyroscopic, kept, 1};
  }
  const Eigen::Index all = crossed ? 4 * n : 2 * n;
  Synchronous found{MatrixXd::Zero(all, all), MatrixXd::Identity(all, all), 2 * kept,
                    crossed ? 2U : 1U};
  found.K.topLeftCorner(n, n) = stiffness_x;
  found.K.block(n, n, n, n) = stiffness_y;
  if (!crossed) {
    found.A.topRightCorner(n, n) = system.gyroscopic;
    found.A.bottomLeftCorner(n, n) = system.gyroscopic.transpose();
    return found;
  }
  found.K.block(0, n, n, n) = found.K.block(n, 0, n, n) = cross;
  found.K.bottomRightCorner(2 * n, 2 * n) = found.K.topLeftCorner(2 * n, 2 * n).eval();
  MatrixXd B = MatrixXd::Zero(2 * n, 2 * n);
  B.topRightCorner(n, n) = -system.gyroscopic;
  B.bottomLeftCorner(n, n) = system.gyroscopic.transpose();
  found.A.topRightCorner(2 * n, 2 * n) = -B;
  found.A.bottomLeftCorner(2 * n, 2 * n) = B;
  return found;
}

std::vector<double> of_constant_springs(const WhirlSystem& system, double speed, bool crossed) {
  const Synchronous found = synchronous(system, speed, crossed);
  std::vector<double> speeds = once(synchronous_speeds(found), found.each);
  if (speeds.size() > found.most) speeds.resize(found.most);
  return speeds;
}

// Counter of critical speeds with the films' springs acting on x + i y, on both planes, or on two
// copies of both planes if springs couple them.
std::optional<SpringCrossings> counted(const WhirlSystem& system, double sense, double reference,
                                       bool crossed) {
  const Eigen::Index n = system.size(), planes = system.isotropic ? 1 : 2,
                     films = static_cast<Eigen::Index>(system.films.size()),
                     directions = crossed ? 3 : planes, copies = crossed ? 2 : 1;
  const double half = std::sqrt(0.5);
  const double along[3][2] = {{1.0, 0.0}, {0.0, 1.0}, {half, half}};
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(copies * planes * n, copies * directions * films);
  Eigen::Index column = 0;
  for (Eigen::Index copy = 0; copy < copies; ++copy) {
    for (const WhirlFilm& film : system.films) {
      for (Eigen::Index d = 0; d < directions; ++d, ++column) {
        for (Eigen::Index plane = 0; plane < planes; ++plane) {
          shapes.block((copy * planes + plane) * n, column, n, 1) = along[d][plane] * film.station;
        }
      }
    }
  }
  const auto springs = [&system, sense, directions, films, copies](double speed) {
    Eigen::VectorXd all(copies * directions * films);
    Eigen::Index k = 0;
    for (Eigen::Index copy = 0; copy < copies; ++copy) {
      for (const WhirlFilm& film : system.films) {
        const Springs of = springs_of(film, sense * speed);
        const double strengths[3] = {of.x, of.y, of.diagonal};
        for (Eigen::Index d = 0; d < directions; ++d) all[k++] = strengths[d];
      }
    }
    return all;
  };
  const Synchronous there = synchronous(system, sense * reference, crossed);
  return SpringCrossings::of(there.K, there.A, shapes, springs, reference);
}

}  // namespace

// Between two points of a table the springs vary smoothly.
std::vector<double> table_speeds(const WhirlSystem& system, double sense) {
  std::vector<double> speeds{0.0};
  for (const WhirlFilm& film : system.films) {
    if (!film.law.follows()) continue;
    for (const double speed : film.law.table->speeds()) {
      if (sense * speed > 0.0) speeds.push_back(sense * speed);
    }
  }
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  return speeds;
}

const char* to_string(WhirlSense sense) {
  constexpr const char* kWords[] = {"forward", "backward", "planar"};
  return kWords[static_cast<int>(sense)];
}

std::vector<WhirlSense> critical_senses(const WhirlSystem& system,
                                        const std::vector<double>& speeds, double sense) {
  if (system.isotropic) return std::vector(speeds.size(), WhirlSense::kForward);
  constexpr double kPlanar = 1e-10;
  constexpr int kIterations = 3;
  const bool crossed = crosses(system);
  const Eigen::Index n = system.size();
  std::vector<WhirlSense> senses;
  for (const double speed : speeds) {
    // Null vector of K - Omega^2 A, by inverse iteration from a start that contains all modes.
    const Synchronous of = synchronous(system, sense * speed, crossed);
    const Eigen::MatrixXd D = of.K - speed * speed * (1.0 + kPlanar) * of.A;
    Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(D.rows(), 1.0, 1.7);
    for (int k = 0; k < kIterations; ++k) u = lu_solve(D, u.normalized().eval());
    u.normalize();
    // Angular momentum, Im(x conj(y)).
    const double momentum =
        crossed ? u.segment(2 * n, n).dot(u.segment(n, n)) - u.head(n).dot(u.tail(n))
                : -u.head(n).dot(u.tail(n));
    senses.push_back(std::abs(momentum) <= kPlanar ? WhirlSense::kPlanar
                     : momentum > 0.0              ? WhirlSense::kForward
                                                   : WhirlSense::kBackward);
  }
  return senses;
}

std::vector<double> critical_speeds(const WhirlSystem& system, double sense) {
  const bool follows = std::any_of(system.films.begin(), system.films.end(),
                                   [](const WhirlFilm& film) { return film.law.follows(); });
  const bool crossed = !system.isotropic && crosses(system);
  if (!follows) return of_constant_springs(system, 0.0, crossed);
  constexpr int kParts = 8;  // intervals between two points of a table
  constexpr double kAccuracy = 1e-14;
  const std::vector<double> points = table_speeds(system, sense);
  const Eigen::Index each = crossed ? 2 : 1;
  const Eigen::Index most = system.kept * (system.isotropic ? 1 : 2);
  const std::optional<SpringCrossings> counts = counted(system, sense, points.back(), crossed);
  // A speed is critical if it equals the k-th critical speed of the springs at that speed. Beyond
  // the tables the springs are constant.
  std::map<double, std::vector<double>> known;  // cache: each k asks at many of the same speeds
  const auto at = [&](double speed) -> const std::vector<double>& {
    const auto [place, fresh] = known.try_emplace(speed);
    if (fresh) place->second = of_constant_springs(system, sense * speed, crossed);
    return place->second;
  };
  std::vector<double> all_found;
  // Search by the eigenvalues at each speed, where springs rise so fast that curves may be crossed
  // twice.
  const auto search = [&](double begin, double end) {
    const std::vector<double>&low = at(begin), &high = at(end);
    for (std::size_t k = 0; k < std::min(low.size(), high.size()); ++k) {
      const auto miss = [&](double speed) {
        const std::vector<double>& all = at(speed);
        return k < all.size() ? all[k] - speed : -speed;
      };
      std::vector<double> at_speed{begin}, missed{low[k] - begin};
      find_extremes(miss, begin, missed.front(), end, high[k] - end, at_speed, missed);
      at_speed.push_back(end);
      missed.push_back(high[k] - end);
      if (missed.back() == 0.0) all_found.push_back(end);
      for (std::size_t i = 0; i + 1 < missed.size(); ++i) {
        if (!(missed[i] * missed[i + 1] < 0.0)) continue;
        const double accuracy = kAccuracy * end;
        all_found.push_back(
            root(miss, at_speed[i], at_speed[i + 1], missed[i], missed[i + 1], accuracy).first);
      }
    }
  };
  const auto count = [&](double begin, double end) {
    if (!counts || !counts->once_between(begin, end)) return false;
    const std::vector<double> found = once(
        counts->between(begin, end, each * most, kAccuracy * end), static_cast<std::size_t>(each));
    all_found.insert(all_found.end(), found.begin(), found.end());
    return true;
  };
  // Each spring is monotone between two points of its table. If all critical speeds of the springs
  // at both points are far above the interval, none comes down to it between them. (An oil film
  // near standstill has many such points, and its stiffness is not definite there.)
  const auto is_far_above = [&](double speed, double end) {
    constexpr double kFar = 4.0;
    if (const auto below = counts ? counts->frozen_below(speed, kFar * end) : std::nullopt)
      return *below == 0;
    const std::vector<double>& all = at(speed);
    return !all.empty() && all.front() > kFar * end;
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double from = points[i], to = points[i + 1];
    if (count(from, to) || (is_far_above(from, to) && is_far_above(to, to))) continue;
    double begin = from;
    for (int part = 1; part <= kParts; ++part) {
      const double end = from + (to - from) * part / kParts;
      if (!count(begin, end)) search(begin, end);
      begin = end;
    }
  }
  for (const double speed : at(points.back())) {
    if (speed >= points.back()) all_found.push_back(speed);
  }
  std::sort(all_found.begin(), all_found.end());
  return all_found;
}

}  // namespace rotorub
