#include "native_model/film/film_forces.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace rotorub {
namespace {

constexpr int kVolumes = 480;  // over the circumference
constexpr int kCoarsestVolumes = 60;
constexpr int kNodes = 8;  // unknown pressures along half the length

using Row = Eigen::Matrix<double, kNodes, 1>;
using Block = Eigen::Matrix<double, kNodes, kNodes>;
using Free = Eigen::Array<bool, kNodes, 1>;

// P_n and P_n' at x in [-1, 1].
std::array<double, 2> legendre_and_slope(int n, double x) {
  double before = 1.0, p = x, slope_before = 0.0, slope = 1.0;
  for (int k = 1; k < n; ++k) {
    const double next = ((2 * k + 1) * x * p - k * before) / (k + 1);
    const double slope_next = slope_before + (2 * k + 1) * p;
    before = p, p = next;
    slope_before = slope, slope = slope_next;
  }
  return {p, slope};
}

// The polynomials along half the length, z in [0, 1]: Lagrange's at the points of Gauss and
// Lobatto, without the last one, z = 1, where the pressure is 0.
struct Axial {
  Row weight;       // int of each polynomial, by the quadrature of these points
  Block stiffness;  // int of the products of their derivatives

  Axial() {
    constexpr int n = kNodes;  // degree; n + 1 points x_k, where (1 - x^2) P_n' = 0
    std::array<double, n + 1> x{}, p{};
    for (int k = 0; k <= n; ++k) {
      x[k] = -std::cos(std::numbers::pi * k / n);
      for (int step = 0; step < 50 && k > 0 && k < n; ++step) {
        // Newton with (1 - x^2) P_n'' = 2 x P_n' - n (n + 1) P_n.
        const auto [value, slope] = legendre_and_slope(n, x[k]);
        const double second = (2.0 * x[k] * slope - n * (n + 1) * value) / (1.0 - x[k] * x[k]);
        x[k] -= slope / second;
      }
      p[k] = legendre_and_slope(n, x[k])[0];
    }
    // Derivative of polynomial j at point k, on [-1, 1]; on [0, 1] twice that.
    Eigen::Matrix<double, n + 1, n + 1> derivative;
    Eigen::Matrix<double, n + 1, 1> share;
    for (int k = 0; k <= n; ++k) {
      share[k] = 1.0 / (n * (n + 1) * p[k] * p[k]);
      for (int j = 0; j <= n; ++j) {
        const double end = 0.25 * n * (n + 1) * (k == 0 ? -1.0 : k == n ? 1.0 : 0.0);
        derivative(k, j) = k == j ? end : p[k] / (p[j] * (x[k] - x[j]));
      }
    }
    derivative *= 2.0;
    weight = share.head<n>();
    stiffness = (derivative.transpose() * share.asDiagonal() * derivative).topLeftCorner<n, n>();
  }
};

// One volume of the circumference, around t.
struct Volume {
  double cosine, sine;          // of t
  double gap;                   // H
  double forward;               // H^3 dg/dt / (step of g) at its end, towards the next one
  double forward_slope;         // its derivative by e at constant t
  double width;                 // int dt
  double int_cosine, int_sine;  // int cos t dt, int sin t dt
};

// `count` volumes around the points g = 2 pi i / count of Sommerfeld's variable,
// (1 + e cos t) (1 - e cos g) = 1 - e^2; P = 0 in the first one, t = 0 and 2 pi.
std::vector<Volume> volumes(double e, int count) {
  const double root = std::sqrt(1.0 - e * e), step = 2.0 * std::numbers::pi / count;
  struct At {
    double cosine, sine, gap;
  };
  const auto at = [&](double g) {
    const double below = 1.0 - e * std::cos(g);
    return At{(std::cos(g) - e) / below, root * std::sin(g) / below, root * root / below};
  };
  std::vector<Volume> all;
  for (int i = 0; i < count; ++i) {
    const At here = at(i * step), begin = at((i - 0.5) * step), end = at((i + 0.5) * step);
    const double forward = end.gap * end.gap * root / step;
    all.push_back({here.cosine, here.sine, here.gap, forward, 3.0 * end.cosine / end.gap * forward,
                   here.gap * step / root, end.sine - begin.sine, begin.cosine - end.cosine});
  }
  return all;
}

// The discrete equation -div(H^3 grad P) = load at the points that are free; P = 0 at the others.
class FilmEquation {
 public:
  FilmEquation(double length_to_diameter, double e)
      : axial_(1.0 / (length_to_diameter * length_to_diameter)),
        e_(e),
        volumes_(volumes(e, kCoarsestVolumes)),
        free_(volumes_.size(), Free::Constant(true)) {
    free_[0].setConstant(false);
  }
  bool is_finest() const { return volumes_.size() == kVolumes; }
  // Halves the volumes. A new point is free if its two neighbours are.
  void refine() {
    const std::size_t n = volumes_.size();
    std::vector<Free> free;
    const auto is_free = [&](std::size_t i) {
      return i == 0 || i == n ? Free(Free::Constant(true)) : free_[i];
    };
    for (std::size_t i = 0; i < n; ++i) {
      free.push_back(free_[i]);
      free.push_back(is_free(i) && is_free(i + 1));
    }
    free_ = std::move(free);
    volumes_ = volumes(e_, 2 * static_cast<int>(n));
  }
  const std::vector<Volume>& volumes_of() const { return volumes_; }

  // -div(H^3 grad P) in volume i; `slope`: its derivative by e at constant P and t.
  Row applied(const std::vector<Row>& P, std::size_t i, bool slope) const {
    const auto conductance = [&](const Volume& v) { return slope ? v.forward_slope : v.forward; };
    const std::size_t next = (i + 1) % volumes_.size();
    const Volume& v = volumes_[i];
    const Row around =
        conductance(v) * (P[i] - P[next]) + conductance(volumes_[i - 1]) * (P[i] - P[i - 1]);
    return around.cwiseProduct(basis().weight) + axial(v, slope) * (basis().stiffness * P[i]);
  }

  // Factorises the equation for the points that are free. Block elimination from the first volume
  // to the last.
  void factorise() {
    const std::size_t n = volumes_.size();
    inverse_.assign(n, Block::Zero());
    for (std::size_t i = 1; i < n; ++i) {
      const Volume& v = volumes_[i];
      Block block = axial(v, false) * basis().stiffness;
      block.diagonal() += (v.forward + volumes_[i - 1].forward) * basis().weight;
      const Row link = coupling(i);
      block -= link.asDiagonal() * inverse_[i - 1] * link.asDiagonal();
      for (int j = 0; j < kNodes; ++j) {
        if (free_[i][j]) continue;
        block.row(j).setZero();
        block.col(j).setZero();
        block(j, j) = 1.0;
      }
      inverse_[i] = block.inverse();
    }
  }

  std::vector<Row> solve(std::vector<Row> load) const {
    const std::size_t n = volumes_.size();
    load[0].setZero();
    for (std::size_t i = 1; i < n; ++i) {
      load[i] += coupling(i).cwiseProduct(inverse_[i - 1] * load[i - 1]);
      load[i] = free_[i].select(load[i].array(), 0.0).matrix();
    }
    std::vector<Row> P(n, Row::Zero());
    for (std::size_t i = n - 1; i >= 1; --i) {
      Row rest = load[i];
      if (i + 1 < n) rest += coupling(i + 1).cwiseProduct(P[i + 1]);
      P[i] = inverse_[i] * rest;
    }
    return P;
  }

  // P >= 0, -div(H^3 grad P) >= load, one of them equal: the primal-dual active set method. The
  // polynomials may let a few points beside the end of the film alternate; these stay at P = 0.
  std::vector<Row> solve_positive(const std::vector<Row>& load) {
    constexpr int kRounds = 20;
    std::vector<Row> P;
    for (int round = 0;; ++round) {
      factorise();
      P = solve(load);
      bool changed = false;
      for (std::size_t i = 1; i < volumes_.size(); ++i) {
        const Row excess = applied(P, i, false) - load[i];
        for (int j = 0; j < kNodes; ++j) {
          const bool stays = free_[i][j] ? P[i][j] > 0.0 : round < kRounds && excess[j] < 0.0;
          changed = changed || stays != free_[i][j];
          free_[i][j] = stays;
        }
      }
      if (!changed) return P;
    }
  }

  static const Axial& basis() {
    static const Axial one;
    return one;
  }

 private:
  double axial(const Volume& v, bool slope) const {
    const double cube = v.gap * v.gap * v.gap * v.width * axial_;
    return slope ? 3.0 * v.cosine / v.gap * cube : cube;
  }
  // Between volume i and the one before it.
  Row coupling(std::size_t i) const {
    const Row weight = volumes_[i - 1].forward * basis().weight;
    return (free_[i] && free_[i - 1]).select(weight.array(), 0.0).matrix();
  }

  double axial_, e_;  // (D/L)^2
  std::vector<Volume> volumes_;
  std::vector<Free> free_;
  std::vector<Block> inverse_;
};

}  // namespace

FilmForces short_film(double length_to_diameter, double e) {
  assert(e > 0.0 && e < 1.0);
  const double scale = length_to_diameter * length_to_diameter, pi = std::numbers::pi;
  const double rest = 1.0 - e * e, root = std::sqrt(rest);
  FilmForces f;
  f.r = -4.0 * scale * e * e / (rest * rest);
  f.t = pi * scale * e / (rest * root);
  f.slope_r = -8.0 * scale * e * (1.0 + e * e) / (rest * rest * rest);
  f.slope_t = pi * scale * (1.0 + 2.0 * e * e) / (rest * rest * root);
  f.damping_r = -2.0 * pi * scale * (1.0 + 2.0 * e * e) / (rest * rest * root);
  f.damping_t = 8.0 * scale * e / (rest * rest);
  return f;
}

FilmForces finite_film(double length_to_diameter, double e) {
  assert(e > 0.0 && e < 1.0);
  FilmEquation film(length_to_diameter, e);
  const Row& weight = FilmEquation::basis().weight;
  const auto load = [&](const auto& of_volume) {
    std::vector<Row> all;
    for (const Volume& v : film.volumes_of()) all.push_back(of_volume(v) * weight);
    return all;
  };
  const auto force = [&](const std::vector<Row>& P, double& r, double& t) {
    r = t = 0.0;
    for (std::size_t i = 0; i < P.size(); ++i) {
      const double along = 6.0 * weight.dot(P[i]);
      r += along * film.volumes_of()[i].int_cosine;
      t += along * film.volumes_of()[i].int_sine;
    }
  };
  // -dH/dt = e sin t.
  const auto wedge = [&](const Volume& v) { return e * v.int_sine; };
  while (!film.is_finest()) {
    film.solve_positive(load(wedge));
    film.refine();
  }
  const std::vector<Row> P = film.solve_positive(load(wedge));
  std::vector<Row> change = load([](const Volume& v) { return v.int_sine; });
  for (std::size_t i = 1; i < P.size(); ++i) change[i] -= film.applied(P, i, true);
  FilmForces f;
  force(P, f.r, f.t);
  force(film.solve(change), f.slope_r, f.slope_t);
  force(film.solve(load([](const Volume& v) { return -2.0 * v.int_cosine; })), f.damping_r,
        f.damping_t);
  return f;
}

}  // namespace rotorub
