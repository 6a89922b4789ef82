// Critical speeds: Campbell's diagram where a whirl goes in step with the spin.

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/root.h"
#include "native_model/rotor/campbell.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

// Positive Omega of K u = Omega^2 A u. K is symmetric but for magnets that sense elsewhere, A is
// and not necessarily definite.
std::vector<double> synchronous_speeds(const Eigen::MatrixXd& K, const Eigen::MatrixXd& A) {
  std::vector<double> inverse_squares;
  if (K == K.transpose() && Eigen::LLT<Eigen::MatrixXd>(K).info() == Eigen::Success) {
    const Eigen::VectorXd values = found_by(symmetric_eigenvalues(A, K));
    inverse_squares.assign(values.begin(), values.end());
  } else {
    // Magnets stronger than the shaft, or that sense elsewhere: K^-1 A, whose real eigenvalues
    // count.
    constexpr double kReal = 1e-9;
    for (const std::complex<double>& mu : found_by(real_eigenvalues(K.fullPivLu().solve(A)))) {
      if (std::abs(mu.imag()) <= kReal * std::abs(mu)) inverse_squares.push_back(mu.real());
    }
  }
  std::vector<double> speeds;
  for (double mu : inverse_squares) {
    if (mu > 0.0) speeds.push_back(1.0 / std::sqrt(mu));
  }
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

// With the springs that the bearings have at one speed.
WhirlSystem with_springs_at(WhirlSystem system, double speed) {
  for (const WhirlFilm& film : system.films) {
    const BearingCoefficients<double> c = film.law.at(speed);
    const Eigen::MatrixXd uu = film.station * film.station.transpose();
    system.stiffness_x += c[0] * uu;
    system.stiffness_y += c[3] * uu;
  }
  system.films.clear();
  return system;
}

// Of springs that do not change.
std::vector<double> of_constant_springs(const WhirlSystem& system) {
  const Eigen::Index n = system.size();
  std::vector<double> speeds;
  std::size_t most = static_cast<std::size_t>(system.kept);
  if (system.isotropic) {
    // Forward: x + i y ~ e^{i Omega t}.
    const Eigen::MatrixXd inertia = Eigen::MatrixXd::Identity(n, n) - system.gyroscopic;
    speeds = synchronous_speeds(system.stiffness_x, inertia);
  } else {
    // (x, -i y) ~ e^{i Omega t}: 1 + [0 G; G^T 0].
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * n, 2 * n),
                    A = Eigen::MatrixXd::Identity(2 * n, 2 * n);
    K.topLeftCorner(n, n) = system.stiffness_x;
    K.bottomRightCorner(n, n) = system.stiffness_y;
    A.topRightCorner(n, n) = system.gyroscopic;
    A.bottomLeftCorner(n, n) = system.gyroscopic.transpose();
    speeds = synchronous_speeds(K, A);
    most *= 2;
  }
  if (speeds.size() > most) speeds.resize(most);
  return speeds;
}

}  // namespace

// Between two points of a table the springs change evenly.
std::vector<double> table_speeds(const WhirlSystem& system, double sense) {
  std::vector<double> speeds{0.0};
  for (const WhirlFilm& film : system.films) {
    if (!film.law.follows()) continue;
    for (const double speed : film.law.tables.front()->speeds()) {
      if (sense * speed > 0.0) speeds.push_back(sense * speed);
    }
  }
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  return speeds;
}

std::vector<double> critical_speeds(const WhirlSystem& system, double sense) {
  const bool follows = std::any_of(system.films.begin(), system.films.end(),
                                   [](const WhirlFilm& film) { return film.law.follows(); });
  if (!follows) return of_constant_springs(with_springs_at(system, 0.0));
  // Each speed is critical with the springs that it has itself: the k-th critical speed of springs
  // at a speed, less that speed, is 0. Beyond the tables the springs stay.
  const auto at = [&](double speed) {
    return of_constant_springs(with_springs_at(system, sense * speed));
  };
  constexpr int kParts = 8;  // of the way between two points of a table
  constexpr double kAccuracy = 1e-14;
  const std::vector<double> points = table_speeds(system, sense);
  std::vector<double> all_found;
  std::vector<double> low = at(points.front());
  double begin = points.front();
  const auto between = [&](double end) {
    const std::vector<double> high = at(end);
    for (std::size_t k = 0; k < std::min(low.size(), high.size()); ++k) {
      const auto miss = [&](double speed) {
        const std::vector<double> all = at(speed);
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
    low = high;
    begin = end;
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    for (int part = 1; part <= kParts; ++part) {
      between(points[i] + (points[i + 1] - points[i]) * part / kParts);
    }
  }
  for (const double speed : low) {
    if (speed > begin) all_found.push_back(speed);
  }
  std::sort(all_found.begin(), all_found.end());
  return all_found;
}

}  // namespace rotorub
