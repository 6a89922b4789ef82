// Contacts that are closed at the same time: the matrix through which they act on each other, their
// impulses on the coordinates, and the way back onto the constraints that round-off and the step's
// error leave, by the least change in the norm of M.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/kinematics.h"
#include "native_model/model/model.h"

namespace rotorub {

struct ClosedContact {
  std::size_t index = 0;  // of the auxiliary bearing
  ContactPoint point{};   // at the configuration in question
};

// Delassus's matrix G = W^T M^-1 W of all of them, rows and columns (normal, friction) of each in
// turn; 1/kg.
ContactMatrix delassus(const Model& model, double t, const double* q,
                       std::span<const ClosedContact> closed);

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

 private:
  void solve(double t, const double* q, const Eigen::Vector3d& load, std::size_t contact);
  void one_to_circle(double t, double* q, const double* v, std::size_t contact);
  void project_one(double t, double* q, double* v, const Closed& closed);
  void project_several(double t, double* q, double* v, std::span<const Closed> closed);

  const Model* model_;
  std::vector<double> change_;
};

// With their points at (q, v).
ContactList<ClosedContact> closed_points(const Model& model, const double* q, const double* v,
                                         std::span<const Constraint::Closed> closed);

}  // namespace rotorub
