// Fixed steps of several contacts: order of convergence to `event`, and closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "native_model/scene/reader.h"
#include "native_model/stepping/fixed_step.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"
#include "tests/support/two_rings.h"

namespace rotorub {
namespace {

using scene::Integrator;

const char* name_of(Integrator integrator) {
  return integrator == Integrator::kVerlet ? "verlet" : "euler";
}

// m, of both rotor points at every row.
double distance(const Trajectory& t, const Trajectory& exact) {
  double most = 0.0;
  for (const char* column : {"rotor_x", "rotor_y", "contact2_rotor_x", "contact2_rotor_y"}) {
    for (std::size_t k = 0; k < t.rows(); ++k) {
      most = std::max(most, std::abs(t.column(column)[k] - exact.column(column)[k]));
    }
  }
  return most;
}

class TwoRings : public testing::TestWithParam<std::tuple<Integrator, const char*>> {};

// `verlet`: from 1e-4 s to 1e-5 s the error falls at least tenfold; of second order it is until the
// ends of accumulations, which a fixed step puts elsewhere, are what is left. Of the first-order
// schemes it is at most the step times kFirstOrder all along.
TEST_P(TwoRings, Converge) {
  constexpr double kFirstOrder = 0.4;  // m/s
  const auto [integrator, name] = GetParam();
  scene::Scene scene = test::two_rings_scene(name);
  scene.run.output_step = 1e-3;
  const Trajectory exact = test::run_event(scene);
  const auto error = [&, of = integrator](double step) {
    const Trajectory t = test::run_with(scene, of, step);
    EXPECT_EQ(t.rows(), exact.rows());
    return distance(t, exact);
  };
  if (integrator != Integrator::kVerlet) {
    for (const double step : {1e-4, 2e-5, 5e-6}) EXPECT_LT(error(step), kFirstOrder * step) << step;
    return;
  }
  const double coarse = error(1e-4), fine = error(1e-5);
  EXPECT_LT(coarse, 2e-6);
  EXPECT_LT(fine, 2e-8);
  EXPECT_LT(fine, 0.1 * coarse);
}

INSTANTIATE_TEST_SUITE_P(, TwoRings,
                         testing::Combine(testing::Values(Integrator::kVerlet, Integrator::kEuler),
                                          testing::Values("drop", "rub", "moving", "rolling",
                                                          "conical", "cylindrical")),
                         [](const auto& of) {
                           return std::string(name_of(std::get<0>(of.param))) + "_" +
                                  std::get<1>(of.param);
                         });

class SeveralContactsBy : public testing::TestWithParam<Integrator> {};

// Both ends at once on half the mode: the result of the same scheme with one contact.
TEST_P(SeveralContactsBy, ACylindricalRubIsThatOfOneContact) {
  const scene::Scene two = test::two_rings_scene("cylindrical");
  scene::Scene one = two;
  one.auxiliary.resize(1);
  one.first().contact->shape.clear();
  one.rotor.modal->mass = one.rotor.modal->mass_y = {two.rotor.modal->mass[0]};
  one.rotor.modal->stiffness = one.rotor.modal->stiffness_y = {two.rotor.modal->stiffness[0]};
  one.rotor.modal->damping = one.rotor.modal->damping_y = {two.rotor.modal->damping[0]};
  one.rotor.modal->internal_damping = one.rotor.modal->gyroscopic = {0.0};
  one.forces[0].shape = {1.0};
  const Trajectory t = test::run_with(two, GetParam(), 2e-5);
  const Trajectory exact = test::run_with(one, GetParam(), 2e-5);
  ASSERT_EQ(t.rows(), exact.rows());
  for (std::size_t k = 0; k < t.rows(); ++k) {
    EXPECT_NEAR(t.column("rotor_x")[k], exact.column("rotor_x")[k], 1e-13);
    EXPECT_NEAR(t.column("contact2_rotor_y")[k], exact.column("rotor_y")[k], 1e-13);
    EXPECT_NEAR(2.0 * t.column("normal_force")[k], exact.column("normal_force")[k], 1e-6);
  }
  EXPECT_NEAR(t.statistics.impulse_total, exact.statistics.impulse_total, 1e-9);
  EXPECT_NEAR(t.statistics.friction_work, exact.statistics.friction_work, 1e-9);
  EXPECT_NEAR(t.statistics.energy_residual(), exact.statistics.energy_residual(), 1e-9);
}

// A bouncing and sliding shaft in two rings that a sampled and a continuous controller drive.
scene::Scene driven_rings() {
  scene::Scene s = test::shaft_in_two_rings(
      3.0, 1.2, -0.7,
      {.damping = 40.0, .stiffness = 3e5, .friction = 0.1, .restitution = 0.3, .speed = 200.0});
  test::add_rotating_force(s, 260.0, 200.0);
  s.forces[0].shape = {1.0, 0.4};
  s.run.end = 0.03;
  for (scene::AuxiliaryBearing& bearing : s.auxiliary) {
    bearing.stator = scene::Stator{{1.0, 1.0}, {100.0, 100.0}, {3e5, 3e5}};
  }
  scene::Controller pd;
  pd.kind = scene::ControllerKind::kPd;
  pd.stiffness = 2e4;
  pd.damping = 50.0;
  s.auxiliary[1].controller = pd;
  pd.sample_time = 1e-3;
  s.auxiliary[0].controller = pd;
  return s;
}

TEST_P(SeveralContactsBy, HaveControllersOfTheirOwn) {
  const bool second = GetParam() == Integrator::kVerlet;
  const scene::Scene s = driven_rings();
  const Trajectory exact = test::run_event(s), t = test::run_with(s, GetParam(), 2e-6);
  EXPECT_LT(exact.statistics.energy_residual(), 1e-10);
  EXPECT_GE(t.impacts.size(), 4u);
  EXPECT_NE(t.column("control_x").back(), 0.0);
  EXPECT_NE(t.column("contact2_control_x").back(), 0.0);
  const double bound = second ? 2e-8 : 2e-6;
  EXPECT_NEAR(t.column("stator_x").back(), exact.column("stator_x").back(), bound);
  EXPECT_NEAR(t.column("contact2_stator_y").back(), exact.column("contact2_stator_y").back(),
              bound);
}

// The order of the contacts has no effect.
TEST_P(SeveralContactsBy, HaveNoOrder) {
  scene::Scene s = driven_rings();
  s.auxiliary.push_back(s.auxiliary[1]);
  s.auxiliary[2].contact->shape = {1.0, -0.2};
  s.auxiliary[2].contact->clearance = 0.45e-3;
  s.auxiliary[2].controller.reset();
  s.run.end = 0.01;
  const Trajectory t = test::run_with(s, GetParam());
  std::swap(s.auxiliary[1], s.auxiliary[2]);
  const Trajectory swapped = test::run_with(s, GetParam());
  EXPECT_GE(t.impacts.size(), 3u);
  EXPECT_NEAR(t.column("x_1").back(), swapped.column("x_1").back(), 1e-11);
  EXPECT_NEAR(t.column("contact2_gap").back(), swapped.column("contact3_gap").back(), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(, SeveralContactsBy,
                         testing::Values(Integrator::kVerlet, Integrator::kEuler),
                         [](const auto& of) { return name_of(of.param); });

// A load that presses both ends onto their rings, and jumps within a step: the contacts open there,
// the slip turns. What the jumps of one contact (jump_test.cc) do, on half the mode.
TEST(SeveralContactsJump, IsThatOfOneContact) {
  const double step = 5e-5;
  for (const double share : {0.1, 0.5, 0.75}) {
    for (const double across : {0.0, 120.0}) {
      const test::Jeffcott of{.mass = 3.0,
                              .damping = 400.0,
                              .stiffness = 2e4,
                              .friction = 0.15,
                              .restitution = 0.3,
                              .speed = across == 0.0 ? 300.0 : 0.0};
      scene::Scene two = test::shaft_in_two_rings(3.0, 1.0, -1.0, of), one = test::make_scene(of);
      for (scene::Scene* s : {&two, &one}) {
        test::add_constant_force(*s, {100.0, 0.0});
        test::add_constant_force(*s, {0.0, across});
        (across == 0.0 ? s->forces[0].off : s->forces[1].on) = 0.01 + share * step;
        s->initial.x = {0.5e-3};
        s->run.end = 0.02;
      }
      two.forces[0].shape = two.forces[1].shape = {1.0, 0.0};
      two.initial.x = {0.5e-3, 0.0};
      test::add_ring(one, 40.0, 800.0, 2e5);
      for (scene::AuxiliaryBearing& bearing : two.auxiliary) {
        bearing.stator = scene::Stator{{20.0, 20.0}, {400.0, 400.0}, {1e5, 1e5}};
      }
      const Trajectory t = test::run_with(two, Integrator::kVerlet, step);
      const Trajectory exact = test::run_with(one, Integrator::kVerlet, step);
      ASSERT_EQ(t.rows(), exact.rows());
      for (std::size_t k = 0; k < t.rows(); ++k) {
        ASSERT_NEAR(t.column("rotor_x")[k], exact.column("rotor_x")[k], 1e-12) << k;
        ASSERT_NEAR(t.column("contact2_rotor_y")[k], exact.column("rotor_y")[k], 1e-12) << k;
      }
    }
  }
}

// Properties that a fixed step supports only for one contact are refused at their place.
TEST(SeveralContactsRefusals, NameTheKeyOfTheContact) {
  const auto refusal = [](const std::string& override) {
    const std::vector<std::string> overrides = {override};
    const std::string moving =
        std::string(ROTORUB_SOURCE_DIR) + "/tests/native_model/event/two_rings/moving.toml";
    return test::message_of<scene::SceneError>(
        [&] { test::run_with(scene::read_scene(moving, overrides), Integrator::kVerlet); });
  };
  EXPECT_TRUE(test::contains(refusal("contact[1].compression_time=1e-4"),
                             {"contact[1].compression_time", "set 0"}));
  EXPECT_TRUE(test::contains(
      refusal("contact[1].actuator={kind='electromagnet',force_constant=1e-4,bias_current=3.0,"
              "air_gap=5e-3,coil_lag=1e-4}"),
      {"contact[1].actuator.coil_lag", "the integrator event"}));
}

// A rotor at rest on both rings stays there: the rings carry the weight, and nothing bounces.
TEST_P(SeveralContactsBy, ARestingShaftStaysAtRest) {
  scene::Scene s = test::shaft_in_two_rings(3.0, 1.2, -0.7, {.friction = 0.3, .restitution = 0.5});
  test::add_constant_force(s, {0.0, -30.0});
  s.forces[0].shape = {1.0, 0.0};
  s.initial.y = {-0.5e-3, 0.0};
  s.run.end = 5e-3;
  const Trajectory t = test::run_with(s, GetParam());
  EXPECT_NEAR(t.column("rotor_y").back(), -0.5e-3, 1e-12);
  EXPECT_NEAR(t.column("normal_force").back() + t.column("contact2_normal_force").back(), 30.0,
              1e-6);
}

// A load beyond the second contact presses it, and lifts the first, which only the other's force
// holds: 20 N at twice the lever are 30 N up at the one, 10 N down at the other.
TEST(SeveralContacts, OnePressesTheOtherInTheBalanceOfALever) {
  const scene::Scene lever = test::lever_in_two_rings();
  const Trajectory t = test::run_with(lever, Integrator::kVerlet, 1e-5);
  EXPECT_NEAR(t.column("normal_force").back(), 30.0, 1e-6);
  EXPECT_NEAR(t.column("contact2_normal_force").back(), 10.0, 1e-6);
  EXPECT_LT(t.events.size(), 6u);
}

// A second contact that is never reached changes nothing: also where the load presses so little
// that the path from the circle begins inward.
TEST(SeveralContacts, OneThatIsNeverReachedChangesNothing) {
  scene::Scene s = test::make_scene(
      {.damping = 20.0, .stiffness = 6e4, .friction = 0.1, .restitution = 0.5, .speed = 200.0});
  test::add_rotating_force(s, 6.0, 200.0);
  s.initial.x = {0.5e-3};
  s.initial.vy = {0.1};
  s.run.end = 0.1;
  const Trajectory one = test::run_with(s, Integrator::kVerlet);
  s.auxiliary.push_back(s.first());
  s.auxiliary[1].contact->clearance = 0.1;
  const Trajectory two = test::run_with(s, Integrator::kVerlet);
  for (std::size_t k = 0; k < one.rows(); ++k) {
    EXPECT_NEAR(two.column("rotor_x")[k], one.column("rotor_x")[k], 1e-13);
  }
}

// A rotor rests on one ring, pressed by 1 N, and the other ring strikes it off within the first
// step, which is half a kick: from there on it flies as a stone.
TEST(SeveralContacts, AContactKnockedOpenInTheFirstStepPressesUntilThen) {
  scene::Scene s = test::make_scene({.mass = 1.0, .clearance = 2e-4, .restitution = 0.5});
  s.auxiliary.push_back(s.first());
  scene::Stator& ring = s.auxiliary[1].stator.emplace();
  ring.mass = {1.0, 1.0};
  ring.position = {8e-5, 0.0};
  ring.velocity = {-0.1, 0.0};
  test::add_constant_force(s, {1.0, 0.0});
  s.initial.x = {2e-4};
  s.run.end = 5e-3;
  const Trajectory run = test::run_with(s, Integrator::kVerlet, 1e-3);
  ASSERT_EQ(run.impacts.size(), 1u);
  EXPECT_NEAR(run.impacts[0].t, 8e-4, 1e-12);
  const double flown = 5e-3 - 8e-4, off = 0.5 * (1.0 + 0.5) * 0.1;
  EXPECT_NEAR(run.column("rotor_vx").back(), flown - off, 1e-12);
}

}  // namespace
}  // namespace rotorub
