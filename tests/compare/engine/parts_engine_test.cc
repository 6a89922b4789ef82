// Parts of a machine in MuJoCo against the native run: contact model rigid in the native step,
// rings on mounts, off the line or turning, friction that falls with the slip, magnets and
// quadratic laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/engine/mujoco_engine.h"
#include "mjcf/writer.h"
#include "native_model/oracles/annular_rub.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "tests/support/hung_rotors.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/turning_ring.h"
#include "tests/support/order.h"
#include "tests/support/said.h"
#include "tests/support/thrown.h"

namespace rotorub::test {
namespace {

using scene::ContactModel;

Trajectory rigid(const scene::Scene& scene, double step) {
  return mujoco_run(scene, scene::ContactModel::kRigid, step);
}

int counted(const Trajectory& t) {
  return static_cast<int>(std::count_if(t.impacts.begin(), t.impacts.end(),
                                        [](const Impact& impact) { return counts(impact); }));
}

// Inertias are up to a thousand times that of MuJoCo's links. The step is still the native one, and
// MuJoCo reaches the state that the plugin requested.
TEST(RigidEngine, KnowsTheStateOfAPartThatWeighsLittle) {
  for (const double inertia : {9.5e-8, 7e-8, 1e-9}) {
    const std::string size = std::to_string(inertia * 1e9) + "e-9";
    for (const std::string& part :
         {"stator.spin={inertia=" + size + ",drag=0.0}",
          "rotor.torsion={inertia=[" + size + "],stiffness=[" + std::to_string(inertia * 4e6) +
              "],damping=[0.0],drive_shape=[0.0]}"}) {
      const scene::Scene scene = shipped("bench_ring", {part, "run.end=0.05"});
      const Trajectory native = run_with(scene, scene::Integrator::kVerlet), t = rigid(scene, 1e-5);
      EXPECT_EQ(counted(t), counted(native)) << part;
      EXPECT_LT(trajectory_error(t, native, scene.first().contact->radius), 1e-11) << part;
    }
  }
}

// Bounces, then an accumulation, then sliding; each impact has one row.
TEST(RigidEngine, HasTheImpactsOfTheRingBench) {
  const Trajectory t = rigid(shipped("bench_ring"), 1e-5);
  ASSERT_GE(t.impacts.size(), 5U);
  const double times[] = {4.0601e-3, 7.5981e-3, 8.9758e-3, 9.5869e-3, 9.8768e-3};
  for (std::size_t i = 0; i < 5; ++i) {
    const Impact& impact = t.impacts[i];
    EXPECT_NEAR(impact.t, times[i], 2e-7) << i;  // as published, to 0.1 us
    EXPECT_NEAR(impact.gap_rate_after, -0.5 * impact.gap_rate_before, 1e-12) << i;
    EXPECT_LT(impact.energy_change, 0.0) << i;
  }
  EXPECT_EQ(t.events.back().kind, EventKind::kSlide);
}

TEST(RigidEngine, ImplicitIntegratorDoesTheSame) {
  const scene::Scene scene = shipped("bench_ring", {"mujoco.integrator=implicit"});
  const Trajectory reference = run_event(scene), t = rigid(scene, 1e-5);
  EXPECT_EQ(t.integrator, "implicit");
  EXPECT_LT(rotor_error(t, reference), 5e-6);
}

const std::vector<std::string> kFalling{
    "contact.friction={static=0.3,kinetic=0.1,stribeck_speed=8.0,viscous=0.004}", "run.end=0.1",
    "run.output_step=1e-3"};

const std::vector<std::string> kMounted{
    "stator.mount={mass=2.5,stiffness=[3e5,4e5],damping=[60.0,90.0]}",
    "stator.dry_friction={force=12.0,presliding=4e-5}",
    "stator.squeeze_film={radius=0.06,length=0.012,clearance=3e-3,viscosity=0.4}",
    "stator.ball_bearing={balls=9,stiffness=4e8,play=0.05e-3,phase=0.2}",
    "stator.spin={inertia=2e-4,dry_drag=0.05,load_factor=2e-3,pitch_diameter=0.08}",
    "run.end=0.08",
    "run.output_step=1e-3"};

// MuJoCo's own step uses the force of each instant: another normal law and another step, but the
// same laws of the ring and of friction that falls with the slip, to the order of the step.
TEST(CoulombInMujoco, ConvergesToTheNativeRun) {
  const auto of_all = [](const Trajectory& a, const Trajectory& b) {
    return trajectory_error(a, b);
  };
  const struct {
    std::vector<std::string> parts;
    double (*error)(const Trajectory&, const Trajectory&);
    double coarse, fine, gain, left;  // s, s, of the errors, m
  } cases[] = {{kMounted, of_all, 2e-5, 5e-6, 0.5, 1e-4},
               {kFalling, rotor_error, 4e-5, 1e-5, 0.4, 3e-5}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.parts.front());
    const scene::Scene s = shipped("bench_ring", c.parts);
    const Trajectory exact = run_event(s);
    const double coarse = c.error(mujoco_run(s, ContactModel::kCoulomb, c.coarse), exact);
    const double fine = c.error(mujoco_run(s, ContactModel::kCoulomb, c.fine), exact);
    EXPECT_LT(fine, c.gain * coarse);
    EXPECT_LT(fine, c.left);
  }
}

TEST(FallingFrictionInMujoco, ConeHasOneCoefficient) {
  for (const char* model : {"cone", "cone-coulomb"}) {
    std::vector<std::string> overrides = kFalling;
    overrides.push_back(std::string("mujoco.contact=") + model);
    EXPECT_TRUE(contains(message_of([&] { mjcf(shipped("bench_ring", overrides)); }),
                         R"(mujoco.contact = "rigid" or "coulomb")"));
  }
}

TEST(RingOffsetEngine, AMachineMovedIsTheSameMachine) {
  const std::vector<std::string> plain = {"run.end=0.02",
                                          "stator={mass=1.0,stiffness=1e5,damping=100.0}"};
  std::vector<std::string> moved = plain;
  moved.insert(moved.end(),
               {"contact.offset=[2.5e-4,-1.25e-4]", "initial.x=[2.5e-4]", "initial.y=[-1.25e-4]"});
  const scene::Scene there = scene::parse_scene(kThrown, "thrown.toml", moved);
  const scene::Scene here = scene::parse_scene(kThrown, "thrown.toml", plain);
  for (const auto contact :
       {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb, scene::ContactModel::kCone}) {
    const Trajectory a = mujoco_run(there, contact, 1e-5), b = mujoco_run(here, contact, 1e-5);
    ASSERT_EQ(a.status, Status::kOk) << a.message;
    EXPECT_FALSE(b.impacts.empty());
    EXPECT_EQ(a.impacts.size(), b.impacts.size());
    for (std::size_t k = 0; k < a.rows(); ++k) {
      EXPECT_NEAR(a.column("rotor_x")[k] - 2.5e-4, b.column("rotor_x")[k], 1e-10) << k;
      EXPECT_NEAR(a.column("stator_y")[k] + 1.25e-4, b.column("stator_y")[k], 1e-10) << k;
      EXPECT_NEAR(a.column("gap")[k], b.column("gap")[k], 1e-10) << k;
    }
  }
}

// ---------------------------------------------------------------- magnets

// The sliding law moves the ring to the rotor, limited by the voltage.
TEST(MagnetsEngine, TheVoltageLimitIsTheSameOnBothSides) {
  const scene::Scene scene =
      shipped("paper_magnetic", {"run.end=0.106", "rotor.modes=2", "actuator.coil_lag=1e-4",
                                 "actuator.voltage_limit=5", "actuator.inductance=20 mH",
                                 "actuator.resistance=2 Ohm"});
  const Trajectory native = run_native(scene);
  ASSERT_EQ(native.status, Status::kOk) << native.message;
  const Trajectory t = mujoco_run(scene, {}, 2e-6);
  EXPECT_NEAR(t.column("current_1").back(), native.column("current_1").back(),
              1e-3 * largest_size(native, "current_1"));
}

// ---------------------------------------------------------------- a quadratic law

TEST(QuadraticEngine, MuJoCoComesToTheNativeRun) {
  for (const Hanging& hanging : hung_rotors()) {
    for (const char* kind : {"lqr", "lqg"}) {
      SCOPED_TRACE(hanging.name + ", " + kind);
      scene::Scene s = levitated(hanging, kind);
      const Trajectory exact = run_event(s);
      ASSERT_EQ(exact.status, Status::kOk) << exact.message;
      const Convergence c = convergence({1e-5, 5e-6, 2.5e-6}, [&](double step) {
        s.run.step = step;
        const Trajectory t = mujoco_engine(scene::ContactModel::kCoulomb)->run(s, {});
        EXPECT_EQ(t.status, Status::kOk) << t.message;
        EXPECT_EQ(t.rows(), exact.rows());
        double most = 0.0;
        for (std::size_t k = 0; k < std::min(t.rows(), exact.rows()); ++k)
          most = std::max(most, std::abs(t.column("stator_x")[k] - exact.column("stator_x")[k]));
        return most;
      });
      EXPECT_NEAR(c.order(), 1.0, 0.1) << c.text();
      EXPECT_LT(c.errors.back(), 2e-7) << c.text() << ": of 0.1 mm";
    }
  }
}

// ---------------------------------------------------------------- a ring that turns
// A ring that turns, [stator.spin], in MuJoCo: spun up by a rub whose force is known, on the modal
// chain and under the segment rotor, and beside its shadow.

constexpr double kInertia = 2e-3, kStart = 3.0;  // kg m^2, rad/s

struct Rub {
  scene::Scene scene;
  double torque;  // N m, of friction on the ring
};
// bench_annular_elastic, in which the normal force is constant; drag holds the ring near 60 rad/s,
// well below rolling.
Rub rub() {
  const scene::Scene plain = shipped("bench_annular_elastic");
  const scene::RotorModal& m = *plain.rotor.modal;
  const scene::Stator& ring = *plain.first().stator;
  const auto exact = oracle::annular_rub({m.mass[0], m.damping[0], m.stiffness[0]},
                                         {ring.mass.x(), ring.damping.x(), ring.stiffness.x()},
                                         plain.first().contact->clearance,
                                         plain.first().contact->friction.coefficient,
                                         plain.forces[0].amplitude, plain.forces[0].frequency);
  const double torque = plain.first().contact->friction.coefficient * exact.value().force *
                        (plain.first().contact->radius + plain.first().contact->clearance);
  const std::string spin = "stator.spin={inertia=" + std::to_string(kInertia) +
                           ",drag=" + std::to_string(torque / 60.0) +
                           ",speed=" + std::to_string(kStart) + "}";
  Rub out{shipped("bench_annular_elastic", {spin, "run.end=0.1"}), torque};
  return out;
}

double largest_miss(const Rub& r, const Trajectory& t) {
  const oracle::TurningRing ring{
      kInertia, r.scene.first().stator->spin->drag,
      r.scene.first().contact->radius + r.scene.first().contact->clearance};
  double most = 0.0;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const double exact = oracle::ring_speed(ring, r.torque, kStart, t.column("t")[k]);
    most = std::max(most, std::abs(t.column("ring_speed")[k] - exact));
  }
  return most;
}

TEST(TurningRingEngine, TheRubSpinsItUpAsTheClosedFormSays) {
  const Rub r = rub();
  const auto expect = [&](scene::ContactModel contact, double gain) {
    const Trajectory coarse = mujoco_run(r.scene, contact, 1e-4),
                     fine = mujoco_run(r.scene, contact, 1e-5);
    EXPECT_GT(fine.column("ring_speed").back(), 20.0);
    EXPECT_GT(largest_miss(r, coarse) / largest_miss(r, fine), gain) << fine.contact_model;
    EXPECT_LT(largest_miss(r, fine), 1e-3 * 60.0) << fine.contact_model;
  };
  expect(scene::ContactModel::kRigid, 80.0);  // of second order
  expect(scene::ContactModel::kCoulomb, 8.0);
}

// The lever of the cone's contact is also the ring's bore: its mean friction spins the ring up.
TEST(TurningRingEngine, TheConeSpinsItUpToo) {
  const Rub r = rub();
  const Trajectory t = mujoco_run(r.scene, scene::ContactModel::kCone, 1e-5);
  EXPECT_LT(largest_miss(r, t), 0.2 * 60.0);
}

// Impacts and a lasting rub on the rig cut into segments, against the native beam.
TEST(TurningRingEngine, TheSegmentRotorTurnsItAsTheNativeBeamDoes) {
  const scene::Scene scene =
      shipped("paper_passive",
              {"mujoco={rotor=\"segments\", segments=12}", "run.step=1e-5", "run.end=0.02",
               "force[0].on=0.0", "initial.steady=false", "contact.friction=0.1", "rotor.modes=5",
               "rotor.torsion.modes=3", "stator.spin={inertia=2e-4,drag=1e-4}"});
  const Trajectory native = run_native(scene);
  const double exact = native.column("ring_speed").back();
  ASSERT_GT(exact, 5.0);
  for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
    EXPECT_NEAR(mujoco_run(scene, contact, 1e-5).column("ring_speed").back(), exact, 0.05 * exact);
  }
}

}  // namespace
}  // namespace rotorub::test
