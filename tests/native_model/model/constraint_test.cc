// Contacts of different radii on one rotor, against dense algebra.
#include "native_model/model/constraint.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>

#include "native_model/model/dynamics.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/scene.h"
#include "tests/support/machine.h"

namespace rotorub {
namespace {

Model two_contacts() {
  return prepare(scene::parse_scene(R"(
[run]
end = 0.1
step = 1e-5
[rotor]
speed = 300.0
[rotor.modal]
mass = [2.0, 1.0]
stiffness = [2e5, 4e5]
damping = [40.0, 40.0]
inertia = 1e-3
[drive]
kind = "linear"
gain = 0.5
speed = 300.0
[[contact]]
radius = 0.05
clearance = 5e-4
friction = 0.2
restitution = 0.5
[contact.stator]
mass = 1.0
damping = 200.0
stiffness = 1e5
[[contact]]
shape = [1.0, -0.6]
radius = 0.03
clearance = 4e-4
friction = 0.1
restitution = 0.5
[contact.stator]
mass = 0.5
damping = 100.0
stiffness = 2e5
)",
                                    "made.toml"));
}

// The rows of W^T: gap rate and slip of each contact per unit of each velocity.
Eigen::MatrixXd rate_rows(const Model& m, const State& s,
                          const ContactList<ClosedContact>& closed) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(m.nq());
  Eigen::MatrixXd rows(2 * static_cast<Eigen::Index>(closed.size()), m.nq());
  for (Eigen::Index k = 0; k < rows.rows() / 2; ++k) {
    const std::size_t contact = closed[static_cast<std::size_t>(k)].index;
    const ContactPoint rest = contact_point(m, s.q.data(), none.data(), contact);
    for (int i = 0; i < m.nq(); ++i) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(m.nq(), i);
      const ContactPoint p = contact_point(m, s.q.data(), unit.data(), contact);
      rows(2 * k, i) = p.gap_rate - rest.gap_rate;
      rows(2 * k + 1, i) = p.slip - rest.slip;
    }
  }
  return rows;
}

TEST(DelassusMatrix, OfContactsWithDifferentRadiiAgainstDense) {
  const Model m = two_contacts();
  for (unsigned seed = 0; seed < 10; ++seed) {
    State s = test::random_state(m, seed);
    const std::array<Constraint::Closed, 2> both{{{0}, {1}}};
    const auto closed = closed_points(m, s.q.data(), s.v.data(), both);
    const Eigen::MatrixXd w = rate_rows(m, s, closed);
    const Eigen::MatrixXd exact =
        w * Cholesky(test::mass_matrix(m, s)).solve(Eigen::MatrixXd(w.transpose()));
    const ContactMatrix g = delassus(m, s.t, s.q.data(), closed);
    EXPECT_LT((Eigen::MatrixXd(g) - exact).norm(), 1e-10 * exact.norm());
  }
}

TEST(Constraint, ProjectsContactsOfDifferentRadiiOntoRest) {
  const Model m = two_contacts();
  Constraint constraint(m);
  for (unsigned seed = 0; seed < 10; ++seed) {
    State s = test::random_state(m, seed);
    const std::array<Constraint::Closed, 2> both{
        {{0, Constraint::Velocity::kStuck}, {1, Constraint::Velocity::kStuck}}};
    constraint.project(s.t, s.q.data(), s.v.data(), both);
    for (const ClosedContact& c : closed_points(m, s.q.data(), s.v.data(), both)) {
      const double speed = c.point.dv.norm() + std::abs(c.point.spin) * 0.05;
      EXPECT_LT(std::abs(c.point.gap_rate) + std::abs(c.point.slip), 1e-11 * (speed + 1.0));
    }
  }
}

}  // namespace
}  // namespace rotorub
