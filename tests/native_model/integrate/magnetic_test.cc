// Runs with the magnetic actuator against exact answers: the ring on its axes alone, linear for
// small motions, and a rub in which the magnets give exactly the force of an ideal actuator.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "native_model/bearing/actuator.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

constexpr double kRingMass = 1.0, kRingDamping = 200.0, kRingStiffness = 1e5;  // of the ring
constexpr double kConstant = 3e-4, kBias = 3.0, kAirGap = 5e-3;                // of the magnets
constexpr double kAddedStiffness = 8e4, kAddedDamping = 150.0;                 // asked of them
constexpr double kMagnetStart = 1e-7, kMagnetEnd = 0.02;                       // m along axis 1, s

scene::Actuator magnets(double lag) {
  return {.kind = scene::ActuatorKind::kElectromagnet,
          .force_constant = kConstant,
          .bias_current = kBias,
          .air_gap = kAirGap,
          .coil_lag = lag};
}

scene::Scene ring_alone(double lag, bool controlled) {
  scene::Scene s = test::make_scene({.stiffness = 2e5});
  test::add_ring(s, kRingMass, kRingDamping, kRingStiffness);
  s.first().contact.reset();
  s.run.end = kMagnetEnd;
  s.first().stator->position = from_axes({kMagnetStart, 0.0});
  s.first().actuator = magnets(lag);
  if (controlled) {
    s.first().controller = scene::Controller{};
    s.first().controller->stiffness = kAddedStiffness;
    s.first().controller->damping = kAddedDamping;
  }
  return s;
}

// (s, s', i) of axis 1 at the end: the linear system of a ring near the middle,
//   M s'' = -K s - D s' + k_s s + k_i i,   lag i' = -(k s + d s' + k_s s)/k_i - i.
Eigen::Vector3d exact(double lag) {
  const double k_s = 4.0 * kConstant * kBias * kBias / std::pow(kAirGap, 3);
  const double k_i = 4.0 * kConstant * kBias / (kAirGap * kAirGap);
  Eigen::Matrix3d a;
  a << 0.0, 1.0, 0.0,  //
      (k_s - kRingStiffness) / kRingMass, -kRingDamping / kRingMass, k_i / kRingMass,
      -(kAddedStiffness + k_s) / (k_i * lag), -kAddedDamping / (k_i * lag), -1.0 / lag;
  return matrix_exp(kMagnetEnd * a) * Eigen::Vector3d(kMagnetStart, 0.0, 0.0);
}

// (s, s', i) of axis 1 in the last row.
Eigen::Vector3d last(const Trajectory& t) {
  const auto at = [&](const char* x, const char* y) {
    return to_axes({t.column(x).back(), t.column(y).back()}).x();
  };
  return {at("stator_x", "stator_y"), at("stator_vx", "stator_vy"), t.column("current_1").back()};
}

// The terms left out are (s / s_0)^2 = 4e-10 of those kept.
constexpr double kNonlinearity = 1e-8;

TEST(MagneticRing, WithALagIsTheLinearSystem) {
  for (const double lag : {5e-5, 1e-3}) {
    const Trajectory t = test::complete(run_native(ring_alone(lag, true)));
    const Eigen::Vector3d found = last(t), expected = exact(lag);
    const Eigen::Vector3d size{kMagnetStart, kMagnetStart * 500.0, 1e-4};
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(found[k], expected[k], kNonlinearity * size[k]) << lag << " " << k;
    }
    EXPECT_LT(t.statistics.energy_residual(), 1e-10);
  }
}

// A ring too heavy to move asks for the whole current. First the voltage is at its limit,
//   L i' = U - R i:  i = (U/R) (1 - exp(-R t / L))  up to  i* = (I/lag - U/L) / (1/lag - R/L),
// then the lag counts:  i = I - (I - i*) exp(-(t - t*) / lag).
TEST(MagneticRing, TheVoltageLimitIsTheCoilsOwnExponential) {
  constexpr double kVoltage = 10.0, kInductance = 0.02, kResistance = 3.0, kLag = 2e-4, kMost = 2.0;
  scene::Scene s = ring_alone(kLag, true);
  s.first().stator->mass = {1e9, 1e9};
  s.first().stator->position = from_axes({-1e-3, 0.0});
  s.first().controller->stiffness = 1e12;
  s.first().controller->damping = 0.0;
  s.first().actuator->current_limit = kMost;
  s.first().actuator->voltage_limit = kVoltage;
  s.first().actuator->inductance = kInductance;
  s.first().actuator->resistance = kResistance;
  const double rate = kResistance / kInductance;
  const double handover = (kMost / kLag - kVoltage / kInductance) / (1.0 / kLag - rate);
  const double at = -std::log1p(-handover * kResistance / kVoltage) / rate;
  ASSERT_GT(at, 0.1 * kMagnetEnd);
  ASSERT_LT(at, 0.9 * kMagnetEnd);
  const auto error = [&](scene::Integrator integrator, double step) {
    const Trajectory t = test::run_with(s, integrator, step);
    double most = 0.0;
    for (std::size_t k = 0; k < t.column("t").size(); ++k) {
      const double now = t.column("t")[k];
      const double expected = now < at ? -kVoltage / kResistance * std::expm1(-rate * now)
                                       : kMost - (kMost - handover) * std::exp(-(now - at) / kLag);
      most = std::max(most, std::abs(t.column("current_1")[k] - expected));
    }
    return most;
  };
  EXPECT_LT(error(scene::Integrator::kEvent, 1e-5), 1e-9);
  const double coarse = error(scene::Integrator::kVerlet, 2e-5);
  const double fine = error(scene::Integrator::kVerlet, 1e-5);
  EXPECT_LT(fine, 1e-2);
  EXPECT_LT(fine, 0.6 * coarse);
}

// Without a command the bias current softens the ring's spring by k_s.
TEST(MagneticRing, TheBiasCurrentIsANegativeSpring) {
  const double k_s = 4.0 * kConstant * kBias * kBias / std::pow(kAirGap, 3);
  const Trajectory t = run_native(ring_alone(0.0, false));
  const double decay = kRingDamping / (2.0 * kRingMass);
  const double omega = std::sqrt((kRingStiffness - k_s) / kRingMass - decay * decay);
  ASSERT_LT(k_s, kRingStiffness);
  const double expected =
      kMagnetStart * std::exp(-decay * kMagnetEnd) *
      (std::cos(omega * kMagnetEnd) + decay / omega * std::sin(omega * kMagnetEnd));
  EXPECT_NEAR(last(t).x(), expected, kNonlinearity * kMagnetStart);
  EXPECT_EQ(last(t).z(), 0.0);
}

// With currents below their limit the rub is that of an ideal actuator.
TEST(MagneticRub, IsThatOfAnIdealActuator) {
  scene::Scene ideal = test::shipped("bench_ring");
  ideal.run.end = 0.1;
  ideal.first().controller = scene::Controller{};
  ideal.first().controller->stiffness = 5e4;
  ideal.first().controller->damping = 100.0;
  scene::Scene magnetic = ideal;
  magnetic.first().actuator = magnets(0.0);
  const Trajectory a = run_native(ideal), b = test::complete(run_native(magnetic));
  ASSERT_GT(a.impacts.size(), 5U);
  const double most = test::largest_size(b, "current_1");
  ASSERT_LT(most, kBias);
  EXPECT_GT(most, 0.1);
  for (const char* name : {"rotor_x", "rotor_y", "stator_x", "stator_y"}) {
    EXPECT_NEAR(a.column(name).back(), b.column(name).back(), 1e-13) << name;
  }
  EXPECT_NEAR(a.column("control_x").back(), b.column("control_x").back(), 1e-7);
}

// The law given as a table instead: its spline is within 1e-4 of the law.
TEST(MagneticRub, OfATableIsThatOfItsLaw) {
  scene::Scene law = test::shipped("paper_magnetic");
  law.rotor.geometry->modes = 2;
  law.run.end = 0.12;
  scene::Scene table = law;
  const scene::Actuator a = *law.first().actuator;
  const Electromagnet magnet({a.force_constant, a.bias_current, a.air_gap, a.stiffness});
  scene::Actuator& t = *table.first().actuator;
  t = {.kind = scene::ActuatorKind::kTable};
  for (int k = -8; k <= 8; ++k) {
    t.table_position.push_back(2e-3 * k / 8);
    t.table_current.push_back(3.0 * k / 8);
  }
  for (const double s : t.table_position) {
    for (const double i : t.table_current) t.table_force.push_back(magnet.force(s, i));
  }
  const Trajectory of_law = run_native(law), of_table = test::complete(run_native(table));
  EXPECT_NEAR(of_table.mean_force(), of_law.mean_force(), 0.01 * of_law.mean_force());
  EXPECT_NEAR(of_table.column("stator_x").back(), of_law.column("stator_x").back(), 1e-6);
  EXPECT_NEAR(of_table.column("current_2").back(), of_law.column("current_2").back(), 1e-2);
  EXPECT_NE(of_table.column("stator_x").back(), of_law.column("stator_x").back());
}

TEST(MagneticRub, ATableWithoutAnInverseIsRefused) {
  scene::Scene s = ring_alone(0.0, true);
  s.first().actuator = {.kind = scene::ActuatorKind::kTable,
                        .table_position = {-1e-3, -5e-4, 5e-4, 1e-3},
                        .table_current = {-2.0, -1.0, 1.0, 2.0}};
  for (int k = 0; k < 4; ++k) {
    for (const double force : {-1.0, 0.0, 100.0, 101.0})
      s.first().actuator->table_force.push_back(force);
  }
  EXPECT_TRUE(test::contains(test::message_of<scene::SceneError>([&] { prepare(s); }),
                             {"actuator.table_force", "does not rise"}));
}

TEST(MagneticRing, DoesNotStartInACore) {
  scene::Scene s = ring_alone(0.0, true);
  s.first().stator->position = {0.0, 8e-3};
  EXPECT_THROW(prepare(s), scene::SceneError);
}

}  // namespace
}  // namespace rotorub
