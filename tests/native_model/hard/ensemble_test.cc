// Runs in the lanes of an ensemble have the bits of a run alone, whatever the parts of the scene.
#include "native_model/stepping/ensemble.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "native_model/dynamics/dynamics.h"
#include "native_model/run/step_commands.h"
#include "native_model/stepping/stepper.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/machine.h"

namespace rotorub {
namespace {

struct Single {
  std::vector<double> q, v;
  double impulse = 0.0, first_touch = -1.0;
  double contact_steps = 0.0;
  Status status = Status::kOk;
};

// The run alone, with its own loop. Its steps lie about the t_k: half of the one about the end
// counts.
Single alone(const Model& model, double step, std::int64_t steps) {
  const auto stepper = make_stepper(scene::Integrator::kVerlet, model, step);
  StepCommands commands(model, *stepper, step);
  Single out;
  for (std::int64_t k = 0; k <= steps; ++k) {
    if (k == steps) {
      out.q.assign(stepper->q(), stepper->q() + model.nq());
      out.v.resize(out.q.size());
      stepper->velocity_now(k, commands.of_step(), out.v.data());
    }
    commands.mean_about(k);
    const FixedStep done = stepper->step(k, commands.of_step(), false);
    if (done.status != Status::kOk) {
      out.status = done.status;
      break;
    }
    const bool last = k == steps;
    if (!(done.normal_impulse > 0.0) || (last && !done.impacts.empty())) continue;
    out.impulse += last ? 0.5 * done.normal_impulse : done.normal_impulse;
    if (last) continue;
    if (out.first_touch < 0.0) out.first_touch = static_cast<double>(k) * step;
    ++out.contact_steps;
  }
  return out;
}

// 11 runs: full groups of lanes and a part of one, each with values of its own.
void expect_same_bits(const std::function<Model(int)>& make, std::int64_t steps = 3000) {
  constexpr int kRuns = 11;
  const double step = 1e-5;
  std::vector<Model> models;
  for (int i = 0; i < kRuns; ++i) {
    models.push_back(make(i));
    if (models.back().first().contact)
      models.back().first().contact->friction.coefficient = 0.02 + 0.05 * i;
    models.back().q0[0] += 1e-6 * i;
  }
  std::vector<Single> singles;
  int touched = 0;
  for (const Model& model : models) {
    singles.push_back(alone(model, step, steps));
    touched += singles.back().first_touch >= 0.0 ? 1 : 0;
  }
  if (models[0].first().contact) {
    EXPECT_GT(touched, 0);
  }
  for (const auto set :
       {InstructionSet::kBaseline, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (set > best_instruction_set()) continue;
    const std::vector<EnsembleRun> runs = Ensemble(models, step, set).run(steps);
    ASSERT_EQ(runs.size(), models.size());
    for (std::size_t i = 0; i < runs.size(); ++i) {
      SCOPED_TRACE("run " + std::to_string(i) + ", set " + std::to_string(static_cast<int>(set)));
      ASSERT_EQ(runs[i].status, singles[i].status);
      ASSERT_EQ(runs[i].q, singles[i].q);
      ASSERT_EQ(runs[i].v, singles[i].v);
      EXPECT_EQ(runs[i].impulse_total, singles[i].impulse);
      EXPECT_EQ(runs[i].first_touch, singles[i].first_touch);
      EXPECT_EQ(runs[i].contact_steps, singles[i].contact_steps);
    }
  }
}

// Friction that falls with slip in every other run, beside a number in the others.
TEST(HardEnsemble, FallingFriction) {
  expect_same_bits([](int i) {
    Model m = make_model(test::shipped("bench_ring"));
    FrictionLaw& friction = m.first().contact->friction;
    friction.excess = i % 2 == 0 ? 0.0 : 0.1;
    friction.stribeck_speed = 5.0;
    friction.viscous = i % 4 == 1 ? 0.01 : 0.0;
    return m;
  });
}

// Torsion, gyroscopics and internal damping between modes, unbalance, dashpots, magnetic bearing,
// gravity, anisotropic everything; with a free spin the mass matrix is coupled.
TEST(HardEnsemble, EveryPartAtOnce) {
  for (const bool driven : {false, true}) {
    SCOPED_TRACE(driven);
    expect_same_bits([&](int i) {
      Model m = test::machine(driven);
      m.first().admittance = contact_admittance(m, m.mass.data(), 0.0, m.q0.data());
      for (AppliedForce& f : m.forces) f.amplitude *= 3.0 + 0.1 * i;
      return m;
    });
  }
}

TEST(HardEnsemble, TheShippedRigs) {
  for (const char* name : {"paper_passive", "paper_sliding", "paper_magnetic"}) {
    SCOPED_TRACE(name);
    expect_same_bits(
        [&](int) {
          scene::Scene scene = test::shipped_rig(name);
          scene.forces[0].on = 0.0;  // contact within the few steps of a test
          scene.initial.steady = false;
          if (scene.first().controller) scene.first().controller->on = 0.001;
          return make_model(scene);
        },
        3000);
  }
}

TEST(HardEnsemble, SampledControllers) {
  expect_same_bits([](int i) {
    scene::Scene scene = test::shipped_rig("paper_sliding");
    scene.forces[0].on = 0.0;
    scene.initial.steady = false;
    scene.first().controller->on = 0.0013;
    scene.first().controller->sample_time = 1e-4 * (1 + i % 3);
    return make_model(scene);
  });
}

TEST(HardEnsemble, CoilsThatLag) {
  expect_same_bits([](int i) {
    scene::Scene scene = test::shipped_rig("paper_magnetic");
    scene.forces[0].on = 0.0;
    scene.initial.steady = false;
    scene.first().controller->on = 0.0013;
    scene.first().actuator->coil_lag = 1e-4 * (1 + i % 3);
    scene.first().actuator->current_rate_limit = 2000.0;
    return make_model(scene);
  });
}

TEST(HardEnsemble, MotorsThatAreNotLinear) {
  expect_same_bits([](int i) {
    scene::Scene scene = test::shipped("bench_ring");
    scene.drive->kind = scene::DriveKind::kKloss;
    scene.drive->breakdown_torque = 1.0 + 0.1 * i;
    scene.drive->breakdown_slip = 0.2;
    scene.drive->synchronous_speed = 330.0;
    return make_model(scene);
  });
}

// Every kind of force, on and off at another time in each lane, with the spin held and free; a
// blade that is lost changes the mass matrix of one lane after the other.
TEST(HardEnsemble, EveryKindOfForce) {
  for (const bool driven : {false, true}) {
    SCOPED_TRACE(driven);
    expect_same_bits([&](int i) {
      scene::Scene scene = test::shipped("bench_ring");
      if (!driven) scene.drive.reset();
      const auto add = [&](scene::ForceKind kind) -> scene::Force& {
        scene::Force f = scene.forces.front();
        f.kind = kind;
        f.amplitude = 20.0 + i;
        f.vector = {90.0, -50.0 + i};
        f.static_moment = 4e-4;
        f.frequency_end = -200.0 - 10.0 * i;
        f.phase = 0.3 * i;
        f.on = 1e-3 + 1e-4 * i;
        f.off = 0.015 + 1e-4 * i;
        return scene.forces.emplace_back(f);
      };
      for (const auto kind : {scene::ForceKind::kSynchronous, scene::ForceKind::kChirp,
                              scene::ForceKind::kPulse, scene::ForceKind::kUnbalance}) {
        add(kind);
      }
      return make_model(scene);
    });
  }
}

TEST(HardEnsemble, MotorsUnderSpeedControl) {
  expect_same_bits([](int i) {
    scene::Scene scene = test::shipped("bench_ring");
    scene.drive->kind = scene::DriveKind::kSpeedControlled;
    scene.drive->gain = 0.3;
    scene.drive->integral_gain = 5.0 + i;
    scene.drive->speed = 330.0 + i;
    scene.drive->acceleration = 2000.0;
    scene.drive->torque_limit = 1.5;
    scene.initial.spin_angle = 0.1 * i;
    return make_model(scene);
  });
}

// A lane that fails leaves its neighbours alone.
TEST(HardEnsemble, AFailedRunStaysItsOwn) {
  std::vector<Model> models;
  for (int i = 0; i < 8; ++i) {
    Model m = make_model(test::shipped("bench_ring"));
    m.q0[0] += 1e-6 * i;
    if (i == 3) m.q0[0] = std::numeric_limits<double>::quiet_NaN();
    models.push_back(m);
  }
  const auto runs = Ensemble(models, 1e-5).run(2000);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(runs[i].status == Status::kOk, i != 3) << i;
    if (i == 3) continue;
    const Single single = alone(models[i], 1e-5, 2000);
    EXPECT_EQ(runs[i].q[0], single.q[0]) << i;
    EXPECT_EQ(runs[i].v[1], single.v[1]) << i;
  }
}

}  // namespace
}  // namespace rotorub
