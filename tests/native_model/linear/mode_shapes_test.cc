#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cmath>
#include <complex>
#include <numbers>

#include "native_model/linear/free_motion.h"
#include "native_model/linear/mode_shapes.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/rotor/modal_rotor.h"
#include "tests/native_model/rotor/rotors.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector2cd;

constexpr double kPi = std::numbers::pi;
constexpr double kShape = 1e-8;  // of a mode 1 high: Ritz shapes are right to the root of 1e-16

// Rayleigh's shaft on two pins: sin(n pi z / L), whatever its rotary inertia.
TEST(ModeShapes, OfAPinnedShaftAreSines) {
  const ModeShapes shapes = mode_shapes(test::scene_of(test::pinned_shaft(4))).value();
  ASSERT_EQ(shapes.x.shape.cols(), 4);
  EXPECT_TRUE(shapes.same_planes);
  EXPECT_EQ(shapes.z[0], 0.0);
  EXPECT_EQ(shapes.z[shapes.z.size() - 1], 1.0);
  for (int n = 1; n <= 4; ++n) {
    EXPECT_NEAR(shapes.x.frequency[n - 1] / test::kShaft.forward(n, 0.0), 1.0, 1e-9);
    for (Eigen::Index i = 0; i < shapes.z.size(); ++i) {
      const double sine = std::sin(n * kPi * shapes.z[i]);
      EXPECT_NEAR(std::abs(shapes.x.shape(i, n - 1)), std::abs(sine), 1e-6) << n << " " << i;
    }
  }
  EXPECT_EQ(shapes.x.shape, shapes.y.shape);
}

// At a station between the points of the line too, here the drive's.
TEST(ModeShapes, GiveTheValuesAtTheStations) {
  scene::Scene s = test::scene_of(test::pinned_shaft(2));
  test::add_contact(s, 0.3);
  s.drive.emplace().station = 0.123456789;
  s.forces.resize(2);
  s.forces[0].station = 0.8;
  s.forces[1].station = 0.6;
  s.rotor.geometry->discs = {{.z = 0.5}};
  const ModeShapes shapes = mode_shapes(s).value();

  std::vector<std::string> names;
  for (const Station& station : shapes.stations) names.push_back(station.name);
  EXPECT_EQ(names, (std::vector<std::string>{"bearing 1", "drive", "contact", "disc", "force 2",
                                             "force 1", "bearing 2"}));
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (int n = 1; n <= 2; ++n) {
      const double expected =
          std::sin(n * kPi * shapes.stations[i].z) / std::sin(n * kPi * s.first().contact->station);
      EXPECT_NEAR(shapes.x.at_stations(static_cast<Eigen::Index>(i), n - 1), expected, kShape)
          << names[i] << ", mode " << n;
    }
  }
}

// The mode values that the model itself uses, of both planes.
TEST(ModeShapes, AreThoseOfTheModel) {
  scene::Scene s = test::anisotropic_rotor();
  test::add_contact(s, 0.4);
  s.magnetic_bearings.emplace_back().station = 0.9;
  const ModeShapes shapes = mode_shapes(s).value();
  const ModalRotor rotor = modal_rotor(s);
  EXPECT_FALSE(shapes.same_planes);
  EXPECT_GT((shapes.x.frequency - shapes.y.frequency).minCoeff(), 0.0) << "softer in y";
  bool found = false;
  for (std::size_t i = 0; i < shapes.stations.size(); ++i) {
    if (shapes.stations[i].kind != StationKind::kMagneticBearing) continue;
    found = true;
    const Eigen::Index row = static_cast<Eigen::Index>(i);
    const Eigen::VectorXd x = shapes.x.at_stations.row(row), y = shapes.y.at_stations.row(row);
    EXPECT_LT((x - rotor.magnets[0].station.x).cwiseAbs().maxCoeff(), kShape);
    EXPECT_LT((y - rotor.magnets[0].station.y).cwiseAbs().maxCoeff(), kShape);
    EXPECT_GT((x - y).cwiseAbs().maxCoeff(), 1e-3) << "the planes differ";
  }
  EXPECT_TRUE(found);
}

TEST(ModeShapes, ModalFormHasNone) {
  EXPECT_FALSE(mode_shapes(test::jeffcott(2.0, 2e5, 40.0)).has_value());
}

TEST(TorsionFrequencies, OfThePublishedRotor) {
  scene::Scene s = test::scene_of(oracle::friswell_rotor());
  EXPECT_TRUE(torsion_frequencies(modal_rotor(s)).empty());
  s.drive.emplace();
  s.rotor.torsion.emplace().modes = 1;
  s.rotor.torsion->damping_ratio = 0.02;
  const std::vector<WhirlMode> modes = torsion_frequencies(modal_rotor(s));
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(modes[0].frequency, oracle::kFriswellTorsion, 5e-4);
  EXPECT_NEAR(modes[0].damping_ratio, 0.02, 1e-14);
}

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

// At rest nothing rotates: the modes are planar, in either plane.
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
    const Eigen::VectorXd q = least_squares(rotor.lines->x, whirl.shape);
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

// ---------------------------------------------------------------- size of orbits
// The largest distance of an orbit: circles and ellipses, off the origin, of one and more
// frequencies.

Vector2cd circle(double radius, double sense, double phase) {
  const Complex x = std::polar(radius, phase);
  return {x, Complex(0.0, -sense) * x};
}

TEST(OrbitSize, NothingMoves) {
  EXPECT_EQ(OrbitSize{}.largest(), 0.0);
  EXPECT_DOUBLE_EQ((OrbitSize{{3.0, 4.0}, {}}).largest(), 5.0);
  EXPECT_DOUBLE_EQ((OrbitSize{{3.0, 0.0}, {{0.0, {0.0, 4.0}}}}).largest(), 5.0)
      << "a constant part";
}

TEST(OrbitSize, CircleOffTheOrigin) {
  EXPECT_NEAR((OrbitSize{{0.3, -0.4}, {{7.0, circle(2.0, 1.0, 0.6)}}}).largest(), 2.5, 1e-9);
}

// Semi-axes a and b along x and y, middle at (c, 0): |d|^2 = (c + a cos)^2 + b^2 sin^2 is largest
// at cos = a c / (b^2 - a^2).
TEST(OrbitSize, EllipseOffTheOrigin) {
  const double a = 1.0, b = 2.0, c = 0.5;
  const double cosine = a * c / (b * b - a * a), sine = std::sqrt(1.0 - cosine * cosine);
  const double exact = std::hypot(c + a * cosine, b * sine);
  EXPECT_NEAR((OrbitSize{{c, 0.0}, {{3.0, {Complex(a), Complex(0.0, -b)}}}}).largest(), exact,
              1e-9);
}

// At whole frequency ratios the phases stay with one another: at phase pi the second circle always
// opposes the first where it would add up. At other ratios every phase occurs.
TEST(OrbitSize, PhasesThatMeetAndThatNeverMeet) {
  const auto size = [](double ratio, double phase) {
    return OrbitSize{{0.0, 0.0},
                     {{5.0, {Complex(1.0), Complex(0.0)}},
                      {5.0 * ratio, {std::polar(1.0, phase), Complex(0.0)}}}}
        .largest();
  };
  // cos t + cos 2 t has 2; cos t + sin 2 t its largest where -sin t + 2 cos 2 t = 0.
  EXPECT_NEAR(size(2.0, 0.0), 2.0, 1e-9);
  const double sine = (-1.0 - std::sqrt(33.0)) / 8.0, cosine = -std::sqrt(1.0 - sine * sine);
  const double other = (-1.0 + std::sqrt(33.0)) / 8.0, beside = std::sqrt(1.0 - other * other);
  const double exact =
      std::max(std::abs(cosine + 2.0 * sine * cosine), std::abs(beside + 2.0 * other * beside));
  EXPECT_NEAR(size(2.0, -0.5 * std::acos(-1.0)), exact, 1e-6);
  EXPECT_LT(exact, 1.8);
  EXPECT_NEAR(size(std::sqrt(2.0), -0.5 * std::acos(-1.0)), 2.0, 1e-9);
}

}  // namespace
}  // namespace rotorub
