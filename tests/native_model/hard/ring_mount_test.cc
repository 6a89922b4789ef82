// Rings on more than a spring and a damper, by whole runs against exact answers: matrix
// exponentials, first integrals, and a program in this test through impacts.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>

#include "native_model/numerics/matrix_functions.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

using scene::Integrator;
using test::run_with;

// The rotor is out of reach at rest, so the ring moves alone.
constexpr const char* kAlone = R"(
[run]
end = 0.02
step = 1e-5
output_step = 5e-4
[rotor]
speed = 100.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [0.0]
[contact]
radius = 0.05
clearance = 0.02
friction = 0.2
restitution = 0.5
)";

scene::Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return scene::parse_scene(kAlone + text, "mount.toml", overrides);
}

// Largest |of(row)| over the run.
double largest(const Trajectory& t, const std::function<double(std::size_t)>& of) {
  double most = 0.0;
  for (std::size_t k = 0; k < t.rows(); ++k) most = std::max(most, std::abs(of(k)));
  return most;
}

// Order of an error over halved steps.
double order_of(Integrator integrator, const scene::Scene& s,
                const std::function<double(const Trajectory&)>& error, double step = 2e-5) {
  return test::convergence({step, step / 2.0, step / 4.0, step / 8.0},
                           [&](double h) { return error(run_with(s, integrator, h)); })
      .order();
}

// ---------------------------------------------------------------- a housing
constexpr const char* kHoused = R"(
[stator]
mass = [1.0, 1.3]
damping = [200.0, 150.0]
stiffness = [1e5, 1.7e5]
[stator.mount]
mass = [3.0, 2.5]
stiffness = [4e5, 3e5]
damping = [50.0, 80.0]
[initial]
stator = [1e-3, -0.6e-3]
stator_velocity = [0.2, 0.1]
)";

// (ring, housing) and their rates, of a plane.
Eigen::Matrix4d housed(double m, double d, double k, double mass, double damping,
                       double stiffness) {
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  a.topRightCorner<2, 2>().setIdentity();
  a.row(2) << -k / m, k / m, -d / m, d / m;
  a.row(3) << k / mass, -(k + stiffness) / mass, d / mass, -(d + damping) / mass;
  return a;
}

double housing_error(const Trajectory& t) {
  const Eigen::Matrix4d x = housed(1.0, 200.0, 1e5, 3.0, 50.0, 4e5);
  const Eigen::Matrix4d y = housed(1.3, 150.0, 1.7e5, 2.5, 80.0, 3e5);
  return largest(t, [&](std::size_t k) {
    const double at = t.column("t")[k];
    const Eigen::Vector4d of_x = matrix_exp(x * at) * Eigen::Vector4d(1e-3, 0.0, 0.2, 0.0);
    const Eigen::Vector4d of_y = matrix_exp(y * at) * Eigen::Vector4d(-0.6e-3, 0.0, 0.1, 0.0);
    return std::max(
        std::hypot(t.column("stator_x")[k] - of_x[0], t.column("stator_y")[k] - of_y[0]),
        std::hypot(t.column("housing_x")[k] - of_x[1], t.column("housing_y")[k] - of_y[1]));
  });
}

TEST(RingMount, RingAndHousingAreAMatrixExponential) {
  const scene::Scene s = scene_of(kHoused);
  EXPECT_LT(housing_error(test::sound_event(s)), 1e-12);
  EXPECT_GT(order_of(Integrator::kVerlet, s, housing_error), 1.9);
  EXPECT_GT(order_of(Integrator::kEuler, s, housing_error, 2e-6), 0.9);
}

// Along x alone: rotor, ring and housing by matrix exponentials between impacts that bisection
// finds, with Poisson's law for two bodies at each. It shares no code with the product.
struct Impacts {
  std::vector<double> times, impulses;
  Eigen::Matrix<double, 6, 1> end;
};
Impacts by_exponentials(double end) {
  constexpr double kGap = 0.5e-3, kRestitution = 0.5, kRotor = 2.0, kRing = 1.0;
  Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Zero();
  a.topRightCorner<3, 3>().setIdentity();
  a(3, 0) = -2e5 / kRotor;
  const Eigen::Matrix4d ring = housed(kRing, 20.0, 1e5, 3.0, 50.0, 4e5);
  a.block<2, 2>(4, 1) = ring.bottomLeftCorner<2, 2>();
  a.block<2, 2>(4, 4) = ring.bottomRightCorner<2, 2>();
  Eigen::Matrix<double, 6, 1> y;
  y << 0.0, 0.0, 0.0, 0.8, 0.0, 0.0;
  constexpr double kLook = 1e-6;
  const Eigen::Matrix<double, 6, 6> look = matrix_exp(a * kLook);
  Impacts all;
  double t = 0.0;
  while (t < end) {
    Eigen::Matrix<double, 6, 1> next = look * y;
    if (std::abs(next[0] - next[1]) < kGap) {
      y = next;
      t += kLook;
      continue;
    }
    double low = 0.0, high = kLook;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      next = matrix_exp(a * middle) * y;
      (std::abs(next[0] - next[1]) < kGap ? low : high) = middle;
    }
    y = matrix_exp(a * low) * y;
    t += low;
    const double impulse = -(1.0 + kRestitution) * (y[3] - y[4]) / (1.0 / kRotor + 1.0 / kRing);
    y[3] += impulse / kRotor;
    y[4] -= impulse / kRing;
    all.times.push_back(t);
    all.impulses.push_back(std::abs(impulse));
  }
  all.end = matrix_exp(a * (end - t)) * y;
  return all;
}

const char* const kThrown = R"(
[stator]
mass = 1.0
damping = 20.0
stiffness = 1e5
[stator.mount]
mass = 3.0
stiffness = 4e5
damping = 50.0
[initial]
vx = [0.8]
)";

TEST(RingMount, ImpactsAgainstAProgramOfTheTestsOwn) {
  scene::Scene s =
      scene_of(kThrown, {"contact.clearance=0.5e-3", "contact.friction=0.0", "run.end=0.05"});
  const Trajectory t = test::sound_event(s);
  const Impacts own = by_exponentials(s.run.end);
  ASSERT_GT(own.times.size(), 5u);
  ASSERT_EQ(t.impacts.size(), own.times.size());
  for (std::size_t k = 0; k < own.times.size(); ++k) {
    EXPECT_NEAR(t.impacts[k].t, own.times[k], 1e-11);
    EXPECT_NEAR(t.impacts[k].normal_impulse, own.impulses[k], 1e-9);
  }
  EXPECT_NEAR(t.column("rotor_x").back(), own.end[0], 1e-12);
  EXPECT_NEAR(t.column("stator_x").back(), own.end[1], 1e-12);
  EXPECT_NEAR(t.column("housing_x").back(), own.end[2], 1e-12);
}

// ---------------------------------------------------------------- a squeeze film
// Radial motion of a ring that only the film holds: m v + C(r) is constant, with
// C = pi mu R L^3 / c^3 r / (1 - (r/c)^2)^(3/2), whose slope is the film's damping.
double film_error(const Trajectory& t) {
  const double scale = M_PI * 0.03 * 0.04 * 8e-6 / 1e-12, clearance = 0.1e-3;
  const auto momentum = [&](std::size_t k) {
    const double r = std::hypot(t.column("stator_x")[k], t.column("stator_y")[k]);
    const double v = std::hypot(t.column("stator_vx")[k], t.column("stator_vy")[k]);
    return v + scale * r / std::pow(1.0 - std::pow(r / clearance, 2), 1.5);
  };
  return largest(t, [&](std::size_t k) { return momentum(k) - momentum(0); });
}

TEST(RingMount, RadialMotionInASqueezeFilm) {
  const scene::Scene s = scene_of(
      "[stator]\nmass = 1.0\nstiffness = 0.0\n[stator.squeeze_film]\nradius = 0.04\nlength = 0.02\n"
      "clearance = 0.1e-3\nviscosity = 0.03\ncavitation = false\n[initial]\n"
      "stator_velocity = [1.2, 1.6]\n",
      {"run.output_step=1e-4", "run.end=2e-3"});
  EXPECT_LT(film_error(test::sound_event(s)), 1e-9);
  EXPECT_GT(order_of(Integrator::kVerlet, s, film_error, 1e-6), 1.9);
}

TEST(RingMount, ARingThatReachesItsHousingEndsTheRun) {
  const scene::Scene s = scene_of(
      "[stator]\nmass = 5.0\nstiffness = 0.0\n[stator.squeeze_film]\nradius = 0.04\nlength = 0.01\n"
      "clearance = 0.1e-3\nviscosity = 1e-3\n[initial]\nstator_velocity = [1.2, 0.0]\n");
  const Trajectory t = test::attempt_event(s);
  EXPECT_EQ(t.status, Status::kOutOfRange);
  EXPECT_NE(t.message.find("squeeze film"), std::string::npos) << t.message;
  // A fixed step may be too large for the film near its wall.
  EXPECT_NE(test::attempt_with(s, Integrator::kVerlet, 1e-6).status, Status::kOk);
}

// ---------------------------------------------------------------- dry friction
// Only dry friction brakes the ring: m v^2/2 + F (x - d (1 - exp(-x/d))) is constant.
double braking_error(const Trajectory& t) {
  constexpr double kForce = 60.0, kWay = 5e-5;
  const auto work = [&](std::size_t k) {
    const double x = std::hypot(t.column("stator_x")[k], t.column("stator_y")[k]);
    const double vx = t.column("stator_vx")[k], vy = t.column("stator_vy")[k];
    return 0.5 * (vx * vx + vy * vy) + kForce * (x - kWay * (1.0 - std::exp(-x / kWay)));
  };
  return largest(t, [&](std::size_t k) { return work(k) - work(0); });
}

TEST(RingMount, DryFrictionBrakes) {
  const scene::Scene s = scene_of(
      "[stator]\nmass = 1.0\nstiffness = 0.0\n[stator.dry_friction]\nforce = 60.0\n"
      "presliding = 5e-5\n[initial]\nstator_velocity = [0.3, 0.4]\n",
      {"run.output_step=1e-4", "run.end=8e-3"});
  const Trajectory event = test::sound_event(s);
  EXPECT_LT(braking_error(event), 1e-10);
  EXPECT_LT(event.statistics.energy_residual(), 1e-9);
  EXPECT_GT(order_of(Integrator::kVerlet, s, braking_error), 1.9);
}

// On a spring each half swing is shorter by 2 F / k, for a presliding distance that goes to 0.
TEST(RingMount, DryFrictionTakesItsPartOfEachSwing) {
  const auto c = test::convergence({4e-6, 2e-6, 1e-6}, [&](double way) {
    const scene::Scene s = scene_of(
        "[stator]\nmass = 1.0\nstiffness = 1e5\n[stator.dry_friction]\nforce = 10.0\npresliding "
        "= " +
            std::to_string(way * 1e6) + "e-6\n[initial]\nstator = [1e-3, 0.0]\n",
        {"run.end=" + std::to_string(M_PI / std::sqrt(1e5)), "run.output_step=1e-3"});
    return std::abs(-test::sound_event(s).column("stator_x").back() - (1e-3 - 2.0 * 10.0 / 1e5));
  });
  EXPECT_GT(c.order(), 0.9) << c.text();
  EXPECT_LT(c.errors.back(), 2e-6);
}

// ---------------------------------------------------------------- the spin's drag
// J w^2/2 + M (a - p (1 - exp(-a/p))) is constant while the ring turns by a, M with the ring's
// weight on its support.
TEST(RingMount, DryDragAndPalmgrensTorque) {
  constexpr double kInertia = 2e-4, kAngle = 0.05, kStart = 120.0;
  constexpr double kTorque = 4e-3 + 1.5e-3 * 0.06 * 1.2 * 9.81;
  const scene::Scene s = scene_of(
      "[gravity]\nacceleration = [0.0, -9.81]\n[stator]\nmass = 1.2\nstiffness = 1e5\n"
      "[stator.spin]\ninertia = 2e-4\nspeed = 120.0\ndry_drag = 4e-3\nload_factor = 1.5e-3\n"
      "pitch_diameter = 0.06\npresliding_angle = 0.05\n[initial]\nstator = [0.0, -1.1772e-4]\n",
      {"run.end=1.0", "run.output_step=0.05"});
  const auto error = [&](const Trajectory& t) {
    return largest(t, [&](std::size_t k) {
      const double a = t.column("ring_angle")[k], w = t.column("ring_speed")[k];
      return 0.5 * kInertia * (w * w - kStart * kStart) +
             kTorque * (a - kAngle * (1.0 - std::exp(-a / kAngle)));
    });
  };
  EXPECT_LT(error(test::sound_event(s)), 1e-10);
  EXPECT_LT(error(run_with(s, Integrator::kVerlet, 1e-4)), 1e-4);
  // Dry friction holds less than its limit: the ring comes to rest and stays.
  scene::Scene held = s;
  held.first().stator->spin->speed = 5.0;
  held.first().stator->spin->drag = 9e-3;  // Dahl's law is a spring to small motion
  const Trajectory t = test::sound_event(held);
  EXPECT_NEAR(t.column("ring_speed").back(), 0.0, 1e-6);
}

}  // namespace
}  // namespace rotorub
