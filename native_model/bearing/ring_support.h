// Supports of the ring of an auxiliary bearing beyond a linear spring and damper: a ball bearing
// with play, a squeeze film and dry friction; also the dry drag on its spin. They act between the
// ring and its housing, or the base if there is no housing. r and w are the ring's displacement and
// velocity relative to it.
//
// Dry friction follows Dahl (1968, "A solid friction model"). Its state s is the friction force
// relative to the limit, with opposite sign:
//
//   ds/dt = (w - |w| s) / d,   force = -limit s
//
// with d the presliding distance. In steady slip s = w / |w|, which is Coulomb's law. After a
// reversal the force changes sign within a displacement of a few d. At rest it holds any load up to
// the limit, and always |s| <= 1. For d -> 0 it becomes the set-valued law, with an error of O(d).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <vector>

#include "native_model/scene/auxiliary_bearing.h"

namespace rotorub {

// The film between two circles whose axes are a distance r apart, by the short-bearing theory
// (Reynolds' equation without circumferential flow; e.g. Vance 1988, ch. 6). With the thickness
// h(a) = c - r . n(a), where n is the direction at angle a, integration over the length gives
//
//   p L = mu L^3 (w . n) / h^3,   F = -R int p L n da = -mu R L^3 (int n n^T / h^3 da) w
//
// over the whole circumference, or with cavitation over the half where w . n > 0.
class SqueezeFilmLaw {
 public:
  explicit SqueezeFilmLaw(const scene::SqueezeFilm& film)
      : clearance_(film.clearance),
        scale_(film.viscosity * film.radius * film.length * film.length * film.length /
               (film.clearance * film.clearance * film.clearance)),
        cavitates_(film.cavitation) {}

  // N, on the ring. Beyond kReach of the clearance the film is evaluated at kReach.
  Eigen::Vector2d force(const Eigen::Vector2d& r, const Eigen::Vector2d& w) const;
  // m: |r| at which the ring would touch its housing.
  double clearance() const { return clearance_; }

  static constexpr double kReach = 0.99;

 private:
  double clearance_;
  double scale_;  // N s/m, mu R L^3 / c^3
  bool cavitates_;
};

// Equally spaced balls with Hertz's law: a ball carries k (r . n - play)^(3/2) where the bracket is
// positive (Stribeck 1907: for many balls without play the sum is balls/4.37 times the most loaded
// one).
class BallBearingLaw {
 public:
  explicit BallBearingLaw(const scene::BallSupport& balls);
  // N, on the ring.
  Eigen::Vector2d force(const Eigen::Vector2d& r) const;
  // N/m: an upper bound of the slope of the force at |r|.
  double stiffness(double r) const;

 private:
  double stiffness_, play_;
  std::vector<Eigen::Vector2d> directions_;  // from the centre to the balls
};

struct RingSupport {
  std::optional<BallBearingLaw> balls;
  std::optional<SqueezeFilmLaw> film;
  std::optional<scene::DryFriction> dry;
  std::optional<scene::RingSpin> drag;  // present if it has dry drag

  // N, on the ring. bristle: state s of the dry friction, used only with `dry`.
  Eigen::Vector2d force(const Eigen::Vector2d& r, const Eigen::Vector2d& w,
                        const Eigen::Vector2d& bristle) const;
  // N m, magnitude of the dry drag if the support transmits a force of magnitude `load` (N).
  double drag_torque(double load) const;
  // True if a support acts on the ring's motion and not only on its spin.
  bool bears() const { return balls || film || dry; }
};

// The friction state after a time dt (s) at constant velocity, from s. This is the exact solution,
// so that |s| <= 1 for any dt.
template <class Vector>
Vector bristle_after(const Vector& velocity, double speed, const Vector& s, double presliding,
                     double dt) {
  if (speed == 0.0) return s;
  const Vector full = velocity / speed;
  return full + std::exp(-speed * dt / presliding) * (s - full);
}

// ds/dt of dry friction, 1/s, for velocity and presliding in m/s and m, or in rad/s and rad.
inline Eigen::Vector2d bristle_rate(const Eigen::Vector2d& velocity, const Eigen::Vector2d& s,
                                    double presliding) {
  return (velocity - velocity.norm() * s) / presliding;
}
inline double bristle_rate(double velocity, double s, double presliding) {
  return (velocity - std::abs(velocity) * s) / presliding;
}

}  // namespace rotorub
