#include "native_model/rotor/whirl_shapes.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <numbers>

#include "native_model/rotor/modal_rotor.h"
#include "tests/native_model/rotor/rotors.h"

namespace rotorub {
namespace {

std::vector<WhirlShape> shapes_of(const scene::Scene& s, double speed) {
  return whirl_shapes(s, whirl_system(s), speed, mode_shapes(s).value());
}

// Rayleigh's shaft whirls in sines at every speed: its rotary and gyroscopic terms have the same
// shape.
TEST(WhirlShapes, OfAPinnedShaftAreSinesAtAnySpeed) {
  const scene::Scene s = test::scene_of(test::pinned_shaft(3));
  const Eigen::VectorXd z = mode_shapes(s)->z;
  for (const double speed : {0.0, 500.0, -3000.0}) {
    const auto shapes = shapes_of(s, speed);
    ASSERT_EQ(shapes.size(), 6u);
    for (std::size_t j = 0; j < shapes.size(); ++j) {
      const double n = static_cast<double>(j / 2 + 1);
      EXPECT_EQ(shapes[j].roundness, 1.0);
      for (Eigen::Index i = 0; i < z.size(); ++i) {
        EXPECT_NEAR(std::abs(shapes[j].shape[i]), std::abs(std::sin(n * std::numbers::pi * z[i])),
                    1e-6)
            << j << " at " << z[i];
      }
    }
  }
}

// Nothing turns at rest: the planar modes, of either plane its own.
TEST(WhirlShapes, AtRestAreThePlanarModes) {
  const scene::Scene s = test::anisotropic_rotor();
  const ModeShapes planar = mode_shapes(s).value();
  const auto shapes = shapes_of(s, 0.0);
  ASSERT_EQ(shapes.size(), 6u);
  for (const WhirlShape& whirl : shapes) {
    double nearest = 1.0;
    for (const PlaneShapes* plane : {&planar.x, &planar.y}) {
      for (Eigen::Index j = 0; j < plane->frequency.size(); ++j) {
        if (std::abs(plane->frequency[j] / std::abs(whirl.mode.frequency) - 1.0) > 1e-6) continue;
        const Eigen::VectorXd one_high =
            plane->shape.col(j) / plane->shape.col(j).cwiseAbs().maxCoeff();
        nearest = std::min({nearest, (whirl.shape - one_high).cwiseAbs().maxCoeff(),
                            (whirl.shape + one_high).cwiseAbs().maxCoeff()});
      }
    }
    EXPECT_LT(nearest, 1e-6) << whirl.mode.frequency;
    EXPECT_LT(whirl.roundness, 1e-6) << "a line";
  }
  for (const WhirlShape& whirl : shapes_of(s, 300.0))
    EXPECT_GT(whirl.roundness, 1e-3) << "an ellipse at speed";
}

// Put into the modal rotor, whose matrices come another way: (K - w^2 M + w Omega G) q = 0.
TEST(WhirlShapes, SolveTheModalRotor) {
  scene::Scene s = test::scene_of(oracle::friswell_rotor());
  s.rotor.geometry->modes = 12;
  constexpr double kSpeed = 4000.0 * std::numbers::pi / 30.0;
  const ModalRotor rotor = modal_rotor(s);
  const auto shapes = shapes_of(s, kSpeed);
  double forward = 0.0, backward = 0.0;  // of the second mode at the first disc
  for (std::size_t j = 0; j < 6; ++j) {
    const WhirlShape& whirl = shapes[j];
    const double w = whirl.mode.frequency;
    const Eigen::VectorXd q = rotor.lines->x.colPivHouseholderQr().solve(whirl.shape);
    EXPECT_LT((rotor.lines->x * q - whirl.shape).cwiseAbs().maxCoeff(), 1e-3);
    const Eigen::VectorXd stiff = rotor.x.stiffness.cwiseProduct(q);
    const Eigen::VectorXd rest =
        stiff - w * w * rotor.x.mass.cwiseProduct(q) + w * kSpeed * (rotor.gyroscopic * q);
    EXPECT_LT(rest.head(6).norm(), 2e-3 * stiff.norm()) << w;
    if (j / 2 == 1) (w > 0.0 ? forward : backward) = whirl.at_stations[1];
  }
  EXPECT_GT(std::abs(std::abs(forward) - std::abs(backward)), 1e-3)
      << "the spin bends either sense otherwise";
}

// Damping turns the phase along the shaft, and no node makes a jump.
TEST(WhirlShapes, AreSmoothWithDamping) {
  scene::Scene s = test::reference_rig();
  s.rotor.geometry->bearings[0].damping = {300.0, 300.0};
  for (const WhirlShape& whirl : shapes_of(s, 250.0)) {
    for (Eigen::Index i = 1; i < whirl.shape.size(); ++i) {
      EXPECT_LT(std::abs(whirl.shape[i] - whirl.shape[i - 1]), 0.2)
          << whirl.mode.frequency << " at " << i;
    }
  }
}

}  // namespace
}  // namespace rotorub
