// Impulses of the contact on the coordinates, and the way back onto the constraints that round-off
// and the step's error leave: the least change in the norm of M.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/system/model.h"

namespace rotorub {

class Constraint {
 public:
  // The model, with a contact, must outlive it.
  explicit Constraint(const Model& model);

  // qdot += M^-1 (W_N normal + W_T friction); impulses, N s.
  void apply(double t, const double* q, double* v, const Eigen::Vector2d& e_r, double normal,
             double friction);
  // q onto the circle, g_N = 0.
  void to_circle(double t, double* q, const double* v);
  // The same; then gdot_N = 0 (kAlong), or gdot_N = gdot_T = 0 (kStuck).
  enum class Velocity { kKept, kAlong, kStuck };
  void project(double t, double* q, double* v, Velocity velocity);

  // Of anything with t, q() and v().
  template <class Motion>
  void apply(Motion& motion, const Eigen::Vector2d& e_r, double normal, double friction) {
    apply(motion.t, motion.q(), motion.v(), e_r, normal, friction);
  }
  template <class Motion>
  void project(Motion& motion, Velocity velocity) {
    project(motion.t, motion.q(), motion.v(), velocity);
  }

 private:
  void solve(double t, const double* q, const Eigen::Vector3d& load);

  const Model* model_;
  std::vector<double> change_;
};

}  // namespace rotorub
