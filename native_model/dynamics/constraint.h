// Impulses of the contacts on the coordinates, and the way back onto the constraints that round-off
// and the step's error leave: the least change in the norm of M.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "native_model/system/model.h"

namespace rotorub {

class Constraint {
 public:
  // The model, with a contact, must outlive it.
  explicit Constraint(const Model& model);

  // qdot += M^-1 (W_N normal + W_T friction); impulses, N s.
  void apply(double t, const double* q, double* v, const Eigen::Vector2d& e_r, double normal,
             double friction, std::size_t contact = 0);

  // What a closed contact asks of the velocities: nothing, gdot_N = 0, or gdot_N = gdot_T = 0.
  enum class Velocity { kKept, kAlong, kStuck };
  struct Closed {
    std::size_t contact = 0;
    Velocity velocity = Velocity::kKept;
  };
  // q onto the circles of all that are closed, g_N = 0.
  void to_circles(double t, double* q, const double* v, std::span<const Closed> closed);
  // The same; then the velocities.
  void project(double t, double* q, double* v, std::span<const Closed> closed);

  // Of the first contact, and of anything with t, q() and v().
  void project(double t, double* q, double* v, Velocity velocity) {
    const Closed first{0, velocity};
    project(t, q, v, std::span(&first, 1));
  }
  template <class Motion>
  void apply(Motion& motion, const Eigen::Vector2d& e_r, double normal, double friction,
             std::size_t contact = 0) {
    apply(motion.t, motion.q(), motion.v(), e_r, normal, friction, contact);
  }
  template <class Motion>
  void project(Motion& motion, Velocity velocity) {
    project(motion.t, motion.q(), motion.v(), velocity);
  }
  template <class Motion>
  void project(Motion& motion, std::span<const Closed> closed) {
    project(motion.t, motion.q(), motion.v(), closed);
  }

 private:
  void solve(double t, const double* q, const Eigen::Vector3d& load, std::size_t contact);
  void one_to_circle(double t, double* q, const double* v, std::size_t contact);
  void project_one(double t, double* q, double* v, const Closed& closed);
  void project_several(double t, double* q, double* v, std::span<const Closed> closed);

  const Model* model_;
  std::vector<double> change_;
};

}  // namespace rotorub
