// The laws of every single step of `midpoint`, with the multipliers' equations built anew:
// velocities at the step's end against the gap of the next midpoint, (12), (13).
#include <gtest/gtest.h>

#include <cmath>

#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/stepper.h"
#include "tests/native_model/hard/random_scenes.h"
#include "tests/native_model/hard/rules.h"

namespace rotorub {
namespace {

struct Worst {
  double complementarity = 0.0, coulomb = 0.0;
  std::int64_t contacts = 0, sticks = 0;
};

// Scales: the clearance over a step for y_N, the largest force and slip of the run.
Worst worst_of(const Model& model, double step, std::int64_t steps) {
  const int n = model.nq();
  const ContactParameters& c = *model.first().contact;
  const Eigen::VectorXd implicit = model.mass + 0.5 * step * model.damping;
  MidpointStepper stepper(model, step);
  Worst worst;
  double force = 1e-300, slip_scale = 1e-300;
  for (std::int64_t k = 0; k < steps; ++k) {
    const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(stepper.q(), n);
    const Eigen::VectorXd v = Eigen::Map<const Eigen::VectorXd>(stepper.v(), n);
    const FixedStep done = stepper.step(k);
    EXPECT_EQ(done.status, Status::kOk);
    if (done.status != Status::kOk) return worst;
    EXPECT_GE(done.normal_impulse, 0.0);
    const Eigen::VectorXd middle = q + 0.5 * step * v;
    const ContactPoint p = contact_point(model, middle.data(), stepper.v());
    if (!done.impacts.empty() || !p.has_normal) continue;
    const double normal = done.normal_impulse, friction = done.friction_impulse;
    force = std::max(force, normal);
    slip_scale = std::max(slip_scale, std::abs(p.slip));
    if (normal == 0.0) continue;
    if (done.reversed) continue;  // friction is the mean of both signs
    // Of the next middle; linearised along e_r where a step is too coarse for a point of the
    // circle.
    const Eigen::Vector3d moved = contact_admittance(model, implicit.data(), 0.0, middle.data()) *
                                  contact_load(p.e_r, c.radius, normal, friction);
    const Eigen::Vector2d free = p.dv - moved.head<2>();
    const double whole = c.clearance - (p.d + step * p.dv).norm();
    const double linear =
        c.clearance - (p.d + step * free).norm() - step * p.e_r.dot(moved.head<2>());
    const double gap = std::abs(linear) < std::abs(whole) ? linear : whole;
    // A step that goes round the ring by more than this is too coarse for a point of the circle.
    constexpr double kTurn = 0.05;  // rad
    if (step * p.dv.norm() > kTurn * c.clearance || p.gap < -1e-3 * c.clearance) continue;
    ++worst.contacts;
    worst.sticks += done.mode == Mode::kStick ? 1 : 0;
    const ContactResidual r = contact_residual(
        gap, normal, friction, p.slip, c.friction.coefficient, c.clearance, force, slip_scale);
    worst.complementarity = std::max(worst.complementarity, r.complementarity);
    worst.coulomb = std::max(worst.coulomb, r.coulomb);
  }
  return worst;
}

TEST(HardPaperLaws, EveryStepOfTheRigWithAHeldSpin) {
  for (const double mu : {0.0, 0.15, 0.6}) {
    SCOPED_TRACE(mu);
    scene::Scene scene = test::shipped("bench_ring");
    scene.drive.reset();
    scene.first().contact->friction = mu;
    const Worst worst = worst_of(make_model(scene), 1e-5, 20000);
    EXPECT_LT(worst.complementarity, test::kLaws);
    EXPECT_LT(worst.coulomb, test::kLaws);
    EXPECT_GT(worst.contacts, 1000);
  }
}

TEST(HardPaperLaws, EveryStepOfRandomMachines) {
  test::RandomScenes scenes(5);
  std::int64_t contacts = 0, sticks = 0;
  for (int k = 0; k < 60; ++k) {
    scene::Scene scene = scenes.next();
    scene.first().controller.reset();
    scene.drive.reset();
    const Worst worst = worst_of(make_model(scene), 1e-5, 2000);
    SCOPED_TRACE(k);
    EXPECT_LT(worst.complementarity, test::kLaws);
    EXPECT_LT(worst.coulomb, test::kLaws);
    contacts += worst.contacts;
    sticks += worst.sticks;
  }
  EXPECT_GT(contacts, 1000);
  EXPECT_GT(sticks, 100);
}

}  // namespace
}  // namespace rotorub
