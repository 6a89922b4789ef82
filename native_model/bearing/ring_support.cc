#include "native_model/bearing/ring_support.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotorub {
namespace {

// The integrals of cos^2 b, cos b sin b and sin^2 b over (1 - e cos b)^3 with respect to the angle
// b, between two values of Sommerfeld's angle g. With 1 - e cos b = (1 - e^2)/(1 + e cos g), cos b
// = (cos g + e)/(1 + e cos g) and sin b = sqrt(1 - e^2) sin g/(1 + e cos g), the integrands are
// (cos g + e)^2, (cos g + e) sin g and sin^2 g over (1 - e^2) to the power 5/2, 2 and 3/2.
struct FilmIntegrals {
  double cc, cs, ss;
};

FilmIntegrals film_integrals(double e, double from, double to) {
  const double width = to - from, sine = std::sin(to) - std::sin(from);
  const double cosine = std::cos(to) - std::cos(from);
  const double twice = 0.25 * (std::sin(2.0 * to) - std::sin(2.0 * from));
  const double squares = std::cos(to) * std::cos(to) - std::cos(from) * std::cos(from);
  const double root = std::sqrt(1.0 - e * e), square = root * root;
  return {((0.5 + e * e) * width + twice + 2.0 * e * sine) / (square * square * root),
          -(0.5 * squares + e * cosine) / (square * square),
          (0.5 * width - twice) / (square * root)};
}

// Sommerfeld's angle of b, in the same revolution.
double sommerfeld(double e, double b) {
  const double g = std::atan2(std::sqrt(1.0 - e * e) * std::sin(b), std::cos(b) - e);
  return g + 2.0 * std::numbers::pi * std::round((b - g) / (2.0 * std::numbers::pi));
}

}  // namespace

Eigen::Vector2d SqueezeFilmLaw::force(const Eigen::Vector2d& r, const Eigen::Vector2d& w) const {
  const double distance = r.norm(), e = std::min(distance / clearance_, kReach);
  const Eigen::Vector2d radial =
      distance > 0.0 ? Eigen::Vector2d(r / distance) : Eigen::Vector2d(1.0, 0.0);
  const Eigen::Vector2d tangential(-radial.y(), radial.x());
  const double along = w.dot(radial), across = w.dot(tangential);
  // Integrates over the whole circumference, or over the half centred on the direction of w.
  constexpr double kPi = std::numbers::pi;
  double from = -kPi, to = kPi;
  if (cavitates_) {
    const double middle = std::atan2(across, along);
    from = sommerfeld(e, middle - 0.5 * kPi);
    to = sommerfeld(e, middle + 0.5 * kPi);
  }
  const FilmIntegrals i = film_integrals(e, from, to);
  return -scale_ *
         ((i.cc * along + i.cs * across) * radial + (i.cs * along + i.ss * across) * tangential);
}

BallBearingLaw::BallBearingLaw(const scene::BallSupport& balls)
    : stiffness_(balls.stiffness), play_(balls.play) {
  for (int i = 0; i < balls.balls; ++i) {
    const double angle = balls.phase + 2.0 * std::numbers::pi * i / balls.balls;
    directions_.emplace_back(std::cos(angle), std::sin(angle));
  }
}

Eigen::Vector2d BallBearingLaw::force(const Eigen::Vector2d& r) const {
  Eigen::Vector2d sum{0.0, 0.0};
  if (r.squaredNorm() <= play_ * play_) return sum;
  for (const Eigen::Vector2d& n : directions_) {
    const double compressed = r.dot(n) - play_;
    if (compressed > 0.0) sum -= stiffness_ * compressed * std::sqrt(compressed) * n;
  }
  return sum;
}

double BallBearingLaw::stiffness(double r) const {
  const double balls = static_cast<double>(directions_.size());
  return 1.5 * stiffness_ * std::sqrt(std::max(0.0, r - play_)) * (0.5 * balls + 1.0);
}

Eigen::Vector2d RingSupport::force(const Eigen::Vector2d& r, const Eigen::Vector2d& w,
                                   const Eigen::Vector2d& bristle) const {
  Eigen::Vector2d sum{0.0, 0.0};
  if (balls) sum += balls->force(r);
  if (film) sum += film->force(r, w);
  if (dry) sum -= dry->force * bristle;
  return sum;
}

double RingSupport::drag_torque(double load) const {
  return drag->dry_drag + drag->load_factor * drag->pitch_diameter * load;
}

}  // namespace rotorub
