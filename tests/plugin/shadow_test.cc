// The native model beside MuJoCo's has the bits of a native run, and exchanges nothing with MuJoCo
// but commands.
#include "plugin/shadow.h"
#include "plugin/make_config.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/model/dynamics.h"
#include "native_model/stepping/stepper.h"
#include "plugin/hooks.h"
#include "tests/plugin/shadow.h"
#include "tests/support/counted_new.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

// The row's coordinates in the native layout. (The velocities that the shadow keeps are those of
// half a step before.)
std::vector<double> row(const Trajectory& t, const Model& model, std::size_t k) {
  std::vector<double> q;
  const Layout& l = model.layout;
  const auto put = [&](const std::string& name) { q.push_back(t.column(name)[k]); };
  for (const char* plane : {"x_", "y_"}) {
    for (int i = 1; i <= l.modes; ++i) put(plane + std::to_string(i));
  }
  if (l.spin) put("spin_angle");
  for (int i = 1; i <= l.torsion; ++i) put("torsion_" + std::to_string(i));
  for (const char* axis : {"x", "y"}) {
    if (l.stator) put("stator_" + std::string(axis));
  }
  return q;
}

// The test does not depend on the number of modes.
const std::vector<std::string> kFewModes{"rotor.modes=2"};

struct ShadowCase {
  const char* name;
  double end;  // s
};
class ShadowBits : public Shadow, public ::testing::WithParamInterface<ShadowCase> {};

TEST_P(ShadowBits, AreThoseOfANativeRun) {
  const std::string name = GetParam().name;
  const scene::Scene scene =
      shadowed(name, name.starts_with("paper") ? kFewModes : std::vector<std::string>{});
  const int steps = static_cast<int>(std::lround(GetParam().end / scene.run.step));
  const Trajectory native = every_step(scene, steps);
  ASSERT_EQ(native.status, Status::kOk);
  ASSERT_EQ(native.rows(), static_cast<std::size_t>(steps) + 1);
  const ModelPointer m = load(mjcf(scene));
  const plugin::Config config = plugin::make_config(m.get());
  const DataPointer d = start(m.get());
  const double h = scene.run.step;
  double impulse = 0.0;
  int in_contact = 0;
  for (std::size_t k = 0; k <= static_cast<std::size_t>(steps); ++k) {
    mj_step(m.get(), d.get());  // the sensors are those of k h, before the step
    ASSERT_EQ(shadow_coordinates(config, d.get()), row(native, config.model, k)) << "step " << k;
    ASSERT_EQ(sensor(m.get(), d.get(), names::kShadowGap), native.column("gap")[k]);
    ASSERT_EQ(point(m.get(), d.get(), names::kShadowRotor).x(), native.column("rotor_x")[k]);
    ASSERT_EQ(point(m.get(), d.get(), names::kShadowRotor).y(), native.column("rotor_y")[k]);
    if (config.model.layout.stator) {
      ASSERT_EQ(point(m.get(), d.get(), names::kShadowStator).y(), native.column("stator_y")[k]);
    }
    // Forces are those of the step that has ended; a row has them at its begin.
    if (k == 0) continue;
    const double force = sensor(m.get(), d.get(), names::kShadowNormalForce);
    const double lasting = native.column("normal_force")[k - 1];
    impulse += (k == 1 ? 0.5 * h : h) * force;
    if (!(lasting > 0.0)) continue;  // an impact's impulse is in no row
    ++in_contact;
    ASSERT_DOUBLE_EQ(force, lasting) << k;
    ASSERT_DOUBLE_EQ(sensor(m.get(), d.get(), names::kShadowFrictionForce),
                     native.column("friction_force")[k - 1]);
  }
  EXPECT_GT(native.impacts.size(), 0u);
  EXPECT_GT(in_contact, 100) << "the rub itself is compared";
  // Half of the kick about the end belongs to the run.
  impulse += 0.5 * h * native.column("normal_force").back();
  EXPECT_NEAR(impulse, native.statistics.impulse_total, 1e-12 * impulse) << "impacts included";
}

// Long enough for impacts, lasting contact and, in paper_sliding, the controller (on at 0.1 s).
INSTANTIATE_TEST_SUITE_P(Scenes, ShadowBits,
                         ::testing::Values(ShadowCase{"bench_ring", 0.03},
                                           ShadowCase{"paper_passive", 0.2},
                                           ShadowCase{"paper_sliding", 0.15},
                                           ShadowCase{"paper_magnetic", 0.12}),
                         [](const auto& which) { return std::string(which.param.name); });

TEST_F(Shadow, LeavesMujocosMotionToTheBit) {
  const std::vector<std::string> early = {"force[0].on=0.0", "initial.steady=false",
                                          "contact.clearance=0.1 mm", "rotor.modes=2"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), early.begin(), early.end());
    return more;
  };
  struct Machine {
    const char* name;
    std::vector<std::string> overrides;
  };
  const std::vector<Machine> machines = {
      {"bench_ring", {}},
      {"bench_ring", {"mujoco.contact=coulomb"}},
      {"bench_ring", {"mujoco.contact=cone", "contact.friction=0.3"}},
      {"bench_drop", {}},
      {"paper_passive", with({"mujoco.contact=rigid"})},
      {"paper_passive", with({"mujoco.integrator=implicit"})},
      {"paper_passive", with({"mujoco.rotor=segments", "mujoco.segments=10"})},
      {"paper_passive",
       with({"mujoco.rotor=segments", "mujoco.segments=10", "mujoco.contact=coulomb"})},
      {"paper_sliding", with({"controller.on=0.0", "controller.sample_time=1e-4"})}};
  for (const Machine& machine : machines) {
    SCOPED_TRACE(machine.name);
    const ModelPointer without = load(mjcf(shipped(machine.name, machine.overrides)));
    const ModelPointer beside = load(mjcf(shadowed(machine.name, machine.overrides)));
    ASSERT_GT(beside->nmocap, 0);
    ASSERT_EQ(without->nmocap, 0);
    const DataPointer a = start(without.get()), b = start(beside.get());
    bool touched = false;
    for (int k = 0; k < 4000; ++k) {
      mj_step(without.get(), a.get());
      mj_step(beside.get(), b.get());
      touched = touched || sensor(without.get(), a.get(), names::kNormalForce) > 0.0;
      ASSERT_EQ(state_of(without.get(), a.get()), state_of(beside.get(), b.get())) << k;
      ASSERT_EQ(sensor(without.get(), a.get(), names::kNormalForce),
                sensor(beside.get(), b.get(), names::kNormalForce));
    }
    EXPECT_TRUE(touched || std::string(machine.name) == "bench_drop");
  }
}

// The segment rotor is another model: its shadow starts where its modes are and stays near.
TEST_F(Shadow, RunsBesideSegments) {
  const scene::Scene scene =
      shadowed("paper_passive", {"mujoco.rotor=segments", "mujoco.segments=12", "force[0].on=0.0",
                                 "initial.steady=false", "rotor.modes=2"});
  const ModelPointer m = load(mjcf(scene));
  const plugin::Config config = plugin::make_config(m.get());
  const DataPointer d = start(m.get());
  VerletStepper native(config.model, scene.run.step);
  double apart = 0.0, size = 0.0;
  bool touched = false;
  for (int k = 0; k < 3000; ++k) {
    mj_step(m.get(), d.get());
    const std::vector<double> now = shadow_of(config, d.get());
    if (k == 0) native.begin(0.0, now.data(), now.data() + config.model.nq());
    ASSERT_TRUE(std::equal(now.begin(), now.begin() + config.model.nq(), native.q())) << k;
    touched = native.step(k).contacts[0].normal_impulse > 0.0 || touched;
    if (touched) continue;
    const Eigen::Vector2d own = point(m.get(), d.get(), names::kRotorPosition);
    apart = std::max(apart, (own - point(m.get(), d.get(), names::kShadowRotor)).norm());
    size = std::max(size, own.norm());
  }
  EXPECT_TRUE(touched);
  EXPECT_GT(size, 4e-4);
  EXPECT_LT(apart, 0.01 * size) << "12 segments against the beam, before the first touch";
}

// RK4 passes four times a step, once at its end.
TEST_F(Shadow, StepsOnceAStepOfRungeKutta) {
  const scene::Scene scene = shadowed("bench_ring", {"mujoco.contact=coulomb"});
  const ModelPointer m = load(mjcf(scene));
  m->opt.integrator = mjINT_RK4;
  const plugin::Config config = plugin::make_config(m.get());
  const DataPointer d = start(m.get());
  VerletStepper native(config.model, scene.run.step);
  for (int k = 0; k < 1500; ++k) {
    mj_step(m.get(), d.get());
    native.step(k);
  }
  mj_forward(m.get(), d.get());
  const std::vector<double> now = shadow_of(config, d.get());
  EXPECT_TRUE(std::equal(now.begin(), now.begin() + config.model.nq(), native.q()));
  EXPECT_EQ(shadow_entries(config, d.get()).steps, 1500.0);
}

TEST_F(Shadow, GhostsShowIt) {
  const scene::Scene scene = shadowed("bench_ring");
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 3000; ++k) mj_step(m.get(), d.get());
  mj_forward(m.get(), d.get());
  mj_kinematics(m.get(), d.get());
  const auto at = [&](const char* body) {
    const mjtNum* x = d->xpos + 3 * mj_name2id(m.get(), mjOBJ_BODY, body);
    return Eigen::Vector2d(x[0], x[1]);
  };
  EXPECT_EQ(at(names::kGhostRotor), point(m.get(), d.get(), names::kShadowRotor));
  EXPECT_EQ(at(names::kGhostRing), point(m.get(), d.get(), names::kShadowStator));
  EXPECT_GT(at(names::kGhostRotor).norm(), 1e-3);
}

// ---------------------------------------------------------------- actuators
// The native model beside MuJoCo's under the actuator: the user's commands, coils that lag, the
// force of a magnet.

namespace names = mjcf_names;

// Without a controller in the scene the user's commands drive both.
TEST_F(Shadow, PassiveBearingFollowsTheUsersCommands) {
  const scene::Scene scene =
      shadowed("paper_passive", {"force[0].on=0.0", "initial.steady=false", "rotor.modes=2"});
  const ModelPointer m = load(mjcf(scene));
  const plugin::Config config = plugin::make_config(m.get());
  const DataPointer d = start(m.get());
  VerletStepper native(config.model, scene.run.step);
  double moved = 0.0;
  for (int k = 0; k < 3000; ++k) {
    const double a = 300.0 * std::sin(0.01 * k), b = k < 1500 ? 0.0 : 2e9;  // b: to the limit
    d->ctrl[0] = a;
    d->ctrl[1] = b;
    mj_step(m.get(), d.get());
    const std::vector<double> now = shadow_of(config, d.get());
    ASSERT_TRUE(std::equal(now.begin(), now.begin() + config.model.nq(), native.q())) << k;
    const double f1 = a, f2 = std::min(b, config.model.first().force_limit);
    constexpr double kRoot = 0.70710678118654752440;
    native.step(k, {kRoot * (f1 - f2), kRoot * (f1 + f2)});
    moved = std::max(moved, point(m.get(), d.get(), names::kShadowStator).norm());
  }
  EXPECT_GT(moved, 1e-4) << "the ring was pushed";
}

// Coils that lag are coordinates of the native model that MuJoCo's model lacks.
TEST_F(Shadow, CarriesTheCoils) {
  const scene::Scene scene =
      shadowed("paper_magnetic",
               {"actuator.coil_lag=1e-4", "actuator.current_rate_limit=5000", "force[0].on=0.0",
                "initial.steady=false", "controller.on=0.002", "rotor.modes=2"});
  constexpr int kSteps = 2000;
  const Trajectory native = every_step(scene, kSteps);
  ASSERT_EQ(native.status, Status::kOk);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  for (std::size_t k = 0; k <= kSteps; ++k) {
    mj_step(m.get(), d.get());
    ASSERT_EQ(point(m.get(), d.get(), names::kShadowStator).x(), native.column("stator_x")[k]) << k;
    ASSERT_EQ(point(m.get(), d.get(), names::kShadowRotor).x(), native.column("rotor_x")[k]) << k;
  }
  EXPECT_GT(std::abs(native.column("current_1").back()), 0.1);
}

// What a magnet without a controller gives is known from MuJoCo: the user's current, the bias and
// the lag are in it.
TEST_F(Shadow, TakesTheMagnetsForceFromMujoco) {
  const ModelPointer m = load(mjcf(
      shadowed("paper_magnetic", {"controller=none", "actuator.coil_lag=1e-4", "rotor.modes=2"})));
  const DataPointer d = start(m.get());
  double apart = 0.0, moved = 0.0;
  for (int k = 0; k < 2000; ++k) {
    d->ctrl[0] = std::sin(0.01 * k);
    mj_step(m.get(), d.get());
    const Eigen::Vector2d its = point(m.get(), d.get(), names::kShadowStator);
    const mjtNum* own = d->qpos + m->nq - 2;
    apart = std::max(apart, (its - Eigen::Vector2d(own[0], own[1])).norm());
    moved = std::max(moved, its.norm());
  }
  EXPECT_GT(moved, 1e-4);
  EXPECT_LT(apart, 0.02 * moved);
}

// ---------------------------------------------------------------- allocation
class ShadowAllocation : public MujocoTest {};

TEST_F(ShadowAllocation, NoneInAStepAfterTheFirst) {
  if (!ROTORUB_COUNTS_ALLOCATIONS) GTEST_SKIP() << "the sanitizer owns operator new";
  // The counter works; otherwise the tests below prove nothing.
  const std::int64_t begun = allocations;
  ::operator delete(::operator new(64));
  ASSERT_EQ(allocations - begun, 1);
  const plugin::Hooks hooks;
  const std::vector<std::string> early = {"force[0].on=0.0", "initial.steady=false",
                                          "contact.clearance=0.1 mm", "rotor.modes=2"};
  for (const char* name : {"paper_passive", "paper_sliding", "bench_ring"}) {
    SCOPED_TRACE(name);
    const std::string scene = name;
    const auto overrides = scene == "bench_ring" ? std::vector<std::string>{} : early;
    const ModelPointer m = load(mjcf(shadowed(scene, overrides)));
    const DataPointer d = start(m.get());
    mj_step(m.get(), d.get());
    bool touched = false;
    const std::int64_t before = allocations;
    for (int k = 0; k < 3000; ++k) {
      mj_step(m.get(), d.get());
      touched = touched || sensor(m.get(), d.get(), mjcf_names::kShadowNormalForce) > 0.0;
    }
    const std::int64_t count = allocations - before;
    EXPECT_EQ(count, 0);
    EXPECT_TRUE(touched);
  }
}

}  // namespace
}  // namespace rotorub::test
