// What carries the ring of an auxiliary bearing beside a linear spring and damper: a ball bearing
// with play, a squeeze film, dry friction; and what drags its spin. All of them act between the
// ring and its housing, or the base; r and w are the ring's displacement and velocity relative to
// that.
//
// Dry friction is Dahl's (1968, "A solid friction model"): its state s, the force over its limit,
// follows the way,
//
//   ds/dt = (w - |w| s) / d,   force = -limit s
//
// d the presliding distance. In steady slip s = w / |w|, Coulomb's law; after a reversal it turns
// on the way of a few d; at rest it holds any load up to the limit, and |s| <= 1 always. For d -> 0
// it is the set-valued law, from which it differs by O(d).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

// The film between two circles whose axes are r apart, by the short-bearing theory (Reynolds'
// equation without flow around the circumference; e.g. Vance 1988, ch. 6). With the thickness
// h(a) = c - r . n(a), n the direction at the angle a, integrated over the length,
//
//   p L = mu L^3 (w . n) / h^3,   F = -R int p L n da = -mu R L^3 (int n n^T / h^3 da) w
//
// over the whole circumference, or with cavitation over the half on which w . n > 0.
class SqueezeFilmLaw {
 public:
  explicit SqueezeFilmLaw(const scene::SqueezeFilm& film)
      : clearance_(film.clearance),
        scale_(film.viscosity * film.radius * film.length * film.length * film.length /
               (film.clearance * film.clearance * film.clearance)),
        cavitates_(film.cavitation) {}

  // N, on the ring. Beyond kReach of the clearance it is the film there.
  Eigen::Vector2d force(const Eigen::Vector2d& r, const Eigen::Vector2d& w) const;
  // m: |r| at which the ring would be in its housing.
  double clearance() const { return clearance_; }
  // N s/m: of small motion about the middle, without cavitation.
  double centred_damping() const;

  static constexpr double kReach = 0.99;

 private:
  double clearance_;
  double scale_;  // N s/m, mu R L^3 / c^3
  bool cavitates_;
};

// Balls at equal angles, each pressed by Hertz's law: k (r . n - play)^(3/2) where that is positive
// (Stribeck 1907: for many of them without play the sum is balls/4.37 times the most loaded one).
class BallBearingLaw {
 public:
  explicit BallBearingLaw(const scene::BallSupport& balls);
  // N, on the ring.
  Eigen::Vector2d force(const Eigen::Vector2d& r) const;
  // N/m: an upper bound of its slope at |r|.
  double stiffness(double r) const;

 private:
  double stiffness_, play_;
  std::vector<Eigen::Vector2d> directions_;  // of the balls
};

struct RingSupport {
  std::optional<BallBearingLaw> balls;
  std::optional<SqueezeFilmLaw> film;
  std::optional<scene::DryFriction> dry;
  std::optional<scene::RingSpin> drag;  // where it drags dry

  // N, on the ring; bristle: the state s of dry friction, read where that is.
  Eigen::Vector2d force(const Eigen::Vector2d& r, const Eigen::Vector2d& w,
                        const Eigen::Vector2d& bristle) const;
  // N m: the size of the dry drag under the force `load` (N) of the whole support.
  double drag_torque(double load) const;
  // It acts on the ring's motion, not on its spin alone.
  bool bears() const { return balls || film || dry; }
};

// Its state after a time dt (s) at that velocity, from s: exactly. Never beyond 1, at any dt.
template <class Vector>
Vector bristle_after(const Vector& velocity, double speed, const Vector& s, double presliding,
                     double dt) {
  if (speed == 0.0) return s;
  const Vector full = velocity / speed;
  return full + std::exp(-speed * dt / presliding) * (s - full);
}

// ds/dt of dry friction, 1/s, for a velocity of m/s and m, or of rad/s and rad.
inline Eigen::Vector2d bristle_rate(const Eigen::Vector2d& velocity, const Eigen::Vector2d& s,
                                    double presliding) {
  return (velocity - velocity.norm() * s) / presliding;
}
inline double bristle_rate(double velocity, double s, double presliding) {
  return (velocity - std::abs(velocity) * s) / presliding;
}

}  // namespace rotorub
