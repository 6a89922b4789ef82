// Contacts that are closed at the same time: the matrix that couples them, their impulses on the
// coordinates, and the projection back onto the constraints. The projection removes round-off and
// the error of the time step by the least change in the norm of M.
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
  ContactPoint point{};   // at the configuration considered
};

// Delassus matrix G = W^T M^-1 W of all contacts, 1/kg. Rows and columns: (normal, friction) of
// each contact in turn.
ContactMatrix delassus(const Model& model, double t, const double* q,
                       std::span<const ClosedContact> closed);

class Constraint {
 public:
  // The model must have a contact and must outlive this object.
  explicit Constraint(const Model& model);

  // v += M^-1 (W_N normal + W_T friction); impulses in N s.
  void apply(double t, const double* q, double* v, const Eigen::Vector2d& e_r, double normal,
             double friction, std::size_t contact = 0);

  // The relative velocity of a closed contact is free (kAny), tangential with gdot_N = 0
  // (kTangential), or zero with gdot_N = gdot_T = 0 (kZero). A compliant contact that sticks has
  // gdot_T = 0 alone (kSticking) and is on no circle.
  enum class Velocity { kAny, kTangential, kZero, kSticking };
  struct Closed {
    std::size_t contact = 0;
    Velocity velocity = Velocity::kAny;
  };
  // Moves q onto the circles of all closed contacts, g_N = 0.
  void to_circles(double t, double* q, const double* v, std::span<const Closed> closed);
  // Calls to_circles() for all that are on one, then makes the conditions on the velocities hold.
  void project(double t, double* q, double* v, std::span<const Closed> closed);

 private:
  void solve(double t, const double* q, const Eigen::Vector3d& load, std::size_t contact);
  void one_to_circle(double t, double* q, const double* v, std::size_t contact);
  void project_one(double t, double* q, double* v, const Closed& closed);
  void project_several(double t, double* q, double* v, std::span<const Closed> closed);

  const Model* model_;
  std::vector<double> change_;
};

// The closed contacts with their contact points at (q, v).
ContactList<ClosedContact> closed_points(const Model& model, const double* q, const double* v,
                                         std::span<const Constraint::Closed> closed);

}  // namespace rotorub
