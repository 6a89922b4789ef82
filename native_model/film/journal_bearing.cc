#include "native_model/film/journal_bearing.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>

#include "native_model/film/film_forces.h"

namespace rotorub {
namespace {

constexpr double kLeast = 0.01, kMost = 0.9;  // eccentricities
constexpr int kPoints = 65;                   // in each sense of rotation

FilmForces film_forces(FilmTheory theory, double length_to_diameter, double e) {
  return theory == FilmTheory::kShort ? short_film(length_to_diameter, e)
                                      : finite_film(length_to_diameter, e);
}

// Eccentricities, descending, at which the speed rises by nearly the same factor: it goes about
// with (1 - e)^2 / e.
std::vector<double> eccentricities() {
  const auto rise = [](double e) { return (1.0 - e) * (1.0 - e) / e; };
  std::vector<double> all;
  for (int k = 0; k < kPoints; ++k) {
    const double share = k / (kPoints - 1.0);
    const double s = std::pow(rise(kMost), 1.0 - share) * std::pow(rise(kLeast), share);
    all.push_back(1.0 + 0.5 * s - std::sqrt(s + 0.25 * s * s));
  }
  return all;
}

// Forces at the eccentricities above. They depend on nothing but the theory and length / diameter,
// and take a quarter of a second for a finite length, so the latest are kept. It can be used from
// any thread.
std::vector<FilmForces> all_forces(FilmTheory theory, double length_to_diameter) {
  constexpr std::size_t kKept = 16;
  static std::map<double, std::vector<FilmForces>> known;  // of finite lengths
  static std::mutex mutex;
  const bool keeps = theory == FilmTheory::kFinite;
  if (keeps) {
    const std::lock_guard lock(mutex);
    const auto found = known.find(length_to_diameter);
    if (found != known.end()) return found->second;
  }
  std::vector<FilmForces> all;
  for (const double e : eccentricities()) {
    all.push_back(film_forces(theory, length_to_diameter, e));
  }
  if (keeps) {
    const std::lock_guard lock(mutex);
    if (known.size() >= kKept) known.clear();
    known[length_to_diameter] = all;
  }
  return all;
}

// rad/s, > 0, at which the film carries the load.
double speed_of(const JournalBearing& b, const FilmForces& f) {
  const double radius = 0.5 * b.diameter, slenderness = radius / b.clearance;
  return b.load /
         (b.viscosity * radius * b.length * slenderness * slenderness * std::hypot(f.r, f.t));
}

FilmPoint point_of(const JournalBearing& b, const FilmForces& f, double e, double sense) {
  FilmPoint point;
  const double speed = speed_of(b, f), size = std::hypot(f.r, f.t);
  point.speed = sense * speed;
  point.eccentricity = e;
  point.attitude = std::atan2(f.t, -f.r);
  // Axes r and t, for rotation about +z: a displacement along t turns the line of centres by
  // dt / (c e), and its rate takes 2 phi' / Omega of the force.
  Eigen::Matrix2d K, C;
  K << -f.slope_r, f.t / e, -f.slope_t, -f.r / e;
  C << -f.damping_r, 2.0 * f.r / e, -f.damping_t, 2.0 * f.t / e;
  K *= b.load / (size * b.clearance);
  C *= b.load / (size * b.clearance * speed);
  // To the load's axis and the one 90 degrees ahead of it, where the other sense of rotation is a
  // mirror image; then to x and y.
  const auto turned = [](const Eigen::Matrix2d& A, double angle) -> Eigen::Matrix2d {
    Eigen::Matrix2d R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return R * A * R.transpose();
  };
  std::size_t at = 0;
  for (const Eigen::Matrix2d& A : {K, C}) {
    Eigen::Matrix2d load = turned(A, point.attitude);
    load(0, 1) *= sense;
    load(1, 0) *= sense;
    const Eigen::Matrix2d xy = turned(load, b.load_angle);
    for (const double value : {xy(0, 0), xy(0, 1), xy(1, 0), xy(1, 1)}) {
      point.coefficients[at++] = value;
    }
  }
  return point;
}

struct FilmAt {
  double eccentricity;
  FilmForces forces;
};

// The film that carries the load at this speed, from the nearby eccentricity e: Newton's method for
// log(speed). A finite film takes about 25 ms, and the scenes of a study often share their
// bearings, so the latest are kept. It can be used from any thread.
FilmAt film_at(const JournalBearing& b, double speed, double e) {
  constexpr double kClose = 1e-12;
  constexpr int kSteps = 20;
  constexpr std::size_t kKept = 256;
  const double ratio = b.length / b.diameter;
  const std::array<double, 6> key{b.diameter, b.length, b.clearance, b.viscosity, b.load, speed};
  static std::map<std::array<double, 6>, FilmAt> known;  // of finite films
  static std::mutex mutex;
  const bool keeps = b.theory == FilmTheory::kFinite;
  if (keeps) {
    const std::lock_guard lock(mutex);
    const auto found = known.find(key);
    if (found != known.end()) return found->second;
  }
  FilmForces f = film_forces(b.theory, ratio, e);
  for (int step = 0; step < kSteps; ++step) {
    const double square = f.r * f.r + f.t * f.t;
    const double rate = -(f.r * f.slope_r + f.t * f.slope_t) / square;  // d log(speed) / de
    const double change = std::log(speed / speed_of(b, f)) / rate;
    e = std::clamp(e + change, 0.5 * kLeast, 0.5 * (1.0 + kMost));
    f = film_forces(b.theory, ratio, e);
    if (std::abs(change) < kClose) break;
  }
  if (keeps) {
    const std::lock_guard lock(mutex);
    if (known.size() >= kKept) known.clear();
    known.insert({key, {e, f}});
  }
  return {e, f};
}

// The point at this speed between two of the eccentricities, of which e is one.
FilmPoint point_at(const JournalBearing& b, double speed, double e) {
  const FilmAt film = film_at(b, std::abs(speed), e);
  FilmPoint point = point_of(b, film.forces, film.eccentricity, speed > 0.0 ? 1.0 : -1.0);
  point.speed = speed;
  return point;
}

}  // namespace

FilmPoint film_point(const JournalBearing& bearing, double e, double sense) {
  return point_of(bearing, film_forces(bearing.theory, bearing.length / bearing.diameter, e), e,
                  sense);
}

std::vector<FilmPoint> film_points(const JournalBearing& bearing, std::vector<double> exact) {
  const std::vector<double> e = eccentricities();
  const std::vector<FilmForces> forces =
      all_forces(bearing.theory, bearing.length / bearing.diameter);
  std::vector<FilmPoint> all;
  for (std::size_t k = e.size(); k-- > 0;) all.push_back(point_of(bearing, forces[k], e[k], -1.0));
  for (std::size_t k = 0; k < e.size(); ++k) all.push_back(point_of(bearing, forces[k], e[k], 1.0));
  for (const double speed : exact) {
    constexpr double kSame = 1e-6;  // relative distance of speeds that count as equal
    const auto next = std::lower_bound(all.begin(), all.end(), speed,
                                       [](const FilmPoint& p, double s) { return p.speed < s; });
    if (next == all.begin() || next == all.end() || next->speed * (next - 1)->speed < 0.0) continue;
    const FilmPoint point = point_at(bearing, speed, next->eccentricity);
    const auto same = [&](const FilmPoint& p) {
      return std::abs(p.speed - speed) <= kSame * std::abs(speed);
    };
    if (same(*next)) {
      *next = point;
    } else if (same(*(next - 1))) {
      *(next - 1) = point;
    } else {
      all.insert(next, point);
    }
  }
  return all;
}

}  // namespace rotorub
