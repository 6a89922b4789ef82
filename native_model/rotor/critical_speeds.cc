// Critical speeds: Campbell's diagram where a whirl goes in step with the spin.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <map>
#include <optional>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/numerics/root.h"
#include "native_model/rotor/campbell.h"
#include "native_model/rotor/refusal.h"
#include "native_model/rotor/spring_crossings.h"

namespace rotorub {
namespace {

// Positive Omega of K u = Omega^2 A u. K is symmetric but for magnets that sense elsewhere, A is
// and not necessarily definite.
std::vector<double> synchronous_speeds(const Eigen::MatrixXd& K, const Eigen::MatrixXd& A) {
  std::vector<double> inverse_squares;
  if (K == K.transpose() && Cholesky(K).positive()) {
    const Eigen::VectorXd values = found_by(symmetric_eigenvalues(A, K));
    inverse_squares.assign(values.begin(), values.end());
  } else {
    // Magnets stronger than the shaft, or that sense elsewhere: K^-1 A, whose real eigenvalues
    // count.
    constexpr double kReal = 1e-9;
    for (const std::complex<double>& mu : found_by(real_eigenvalues(full_lu_solve(K, A)))) {
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

// K u = Omega^2 A u.
struct Synchronous {
  Eigen::MatrixXd K, A;
  std::size_t most = 0;  // critical speeds of interest: the lowest
};

// Of springs that do not change.
Synchronous synchronous(const WhirlSystem& system) {
  const Eigen::Index n = system.size();
  const auto kept = static_cast<std::size_t>(system.kept);
  if (system.isotropic) {
    // Forward: x + i y ~ e^{i Omega t}.
    return {system.stiffness_x, Eigen::MatrixXd::Identity(n, n) - system.gyroscopic, kept};
  }
  // (x, -i y) ~ e^{i Omega t}: 1 + [0 G; G^T 0].
  Synchronous both{Eigen::MatrixXd::Zero(2 * n, 2 * n), Eigen::MatrixXd::Identity(2 * n, 2 * n),
                   2 * kept};
  both.K.topLeftCorner(n, n) = system.stiffness_x;
  both.K.bottomRightCorner(n, n) = system.stiffness_y;
  both.A.topRightCorner(n, n) = system.gyroscopic;
  both.A.bottomLeftCorner(n, n) = system.gyroscopic.transpose();
  return both;
}

std::vector<double> of_constant_springs(const WhirlSystem& system) {
  const Synchronous found = synchronous(system);
  std::vector<double> speeds = synchronous_speeds(found.K, found.A);
  if (speeds.size() > found.most) speeds.resize(found.most);
  return speeds;
}

// The films' springs as those of both planes, or of x + i y.
std::optional<SpringCrossings> counted(const WhirlSystem& system, double sense, double reference) {
  const Eigen::Index n = system.size(), planes = system.isotropic ? 1 : 2,
                     films = static_cast<Eigen::Index>(system.films.size());
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(planes * n, planes * films);
  for (Eigen::Index j = 0; j < films; ++j) {
    for (Eigen::Index plane = 0; plane < planes; ++plane) {
      shapes.block(plane * n, planes * j + plane, n, 1) =
          system.films[static_cast<std::size_t>(j)].station;
    }
  }
  const auto springs = [&system, sense, planes, films](double speed) {
    Eigen::VectorXd all(planes * films);
    for (Eigen::Index j = 0; j < films; ++j) {
      const auto c = system.films[static_cast<std::size_t>(j)].law.at(sense * speed);
      all[planes * j] = c[0];
      if (planes == 2) all[planes * j + 1] = c[3];
    }
    return all;
  };
  const Synchronous there = synchronous(with_springs_at(system, sense * reference));
  return SpringCrossings::of(there.K, there.A, shapes, springs, reference);
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
  std::map<double, std::vector<double>> known;  // the search of each k asks at many the same
  const auto at = [&](double speed) -> const std::vector<double>& {
    const auto [place, fresh] = known.try_emplace(speed);
    if (fresh) place->second = of_constant_springs(with_springs_at(system, sense * speed));
    return place->second;
  };
  constexpr int kParts = 8;  // of the way between two points of a table
  constexpr double kAccuracy = 1e-14;
  const std::vector<double> points = table_speeds(system, sense);
  std::vector<double> all_found;
  // By the eigenvalues at each speed: where springs rise so fast that curves may be crossed twice.
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
  const std::optional<SpringCrossings> counts = counted(system, sense, points.back());
  const auto most = static_cast<Eigen::Index>(system.kept) * (system.isotropic ? 1 : 2);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double from = points[i], to = points[i + 1];
    if (counts && counts->once_between(from, to)) {
      const std::vector<double> found = counts->between(from, to, most, kAccuracy * to);
      all_found.insert(all_found.end(), found.begin(), found.end());
      continue;
    }
    double begin = from;
    for (int part = 1; part <= kParts; ++part) {
      const double end = from + (to - from) * part / kParts;
      search(begin, end);
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
