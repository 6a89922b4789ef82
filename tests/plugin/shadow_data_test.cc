// The shadow's memory is in mjData, and a program may change the time without harm.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/prepare/prepare.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/make_config.h"
#include "tests/plugin/shadow.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

constexpr int kShadowSteps = 3000;

// Its controller is sampled and on from the start, so that all of its memory is in use.
class ShadowData : public HookedTest {
 protected:
  ShadowData()
      : model_(
            load(mjcf(shadowed("paper_sliding", {"controller.on=0.0", "controller.sample_time=1e-4",
                                                 "force[0].on=0.0", "initial.steady=false",
                                                 "contact.clearance=0.1 mm", "rotor.modes=2"})))),
        config_(plugin::make_config(model_.get())) {}
  void steps(mjData* d, int count) const {
    for (int k = 0; k < count; ++k) mj_step(model_.get(), d);
  }
  std::vector<double> shadow(const mjData* d) const { return shadow_of(config_, d); }
  std::vector<double> shadow_after(int count) const {
    const DataPointer d = start(model_.get());
    steps(d.get(), count);
    return shadow(d.get());
  }

  ModelPointer model_;
  plugin::Config config_;
};

// A viewer writes the keyframe into mjData and continues: the time goes back.
TEST_F(ShadowData, KeyframeInTheMiddleStartsAnew) {
  const std::vector<double> wanted = shadow_after(500);
  const DataPointer d = start(model_.get());
  steps(d.get(), kShadowSteps);
  d->time = model_->key_time[0];
  std::copy_n(model_->key_qpos, model_->nq, d->qpos);
  std::copy_n(model_->key_qvel, model_->nv, d->qvel);
  steps(d.get(), 500);
  EXPECT_EQ(shadow(d.get()), wanted);
}

// A jump forward, and a state that is set before the first step: MuJoCo's state counts.
TEST_F(ShadowData, StartsFromMujocosState) {
  const DataPointer d = start(model_.get());
  const double h = model_->opt.timestep;
  mj_forward(model_.get(), d.get());
  d->qpos[0] = 2e-5;
  mj_forward(model_.get(), d.get());
  EXPECT_EQ(shadow(d.get())[0], 2e-5);
  steps(d.get(), 100);
  d->time += 7.3 * h;
  d->qpos[0] = 3e-5;
  mj_forward(model_.get(), d.get());
  EXPECT_EQ(shadow(d.get())[0], 3e-5);
  EXPECT_EQ(shadow_entries(config_, d.get()).origin, d->time);
  steps(d.get(), 2);
  EXPECT_EQ(shadow_entries(config_, d.get()).steps, 1.0);
}

TEST_F(ShadowData, RepeatedPassesChangeNothing) {
  const DataPointer d = start(model_.get());
  steps(d.get(), kShadowSteps);
  mj_forward(model_.get(), d.get());
  const auto memory = [&] {
    return std::vector<double>(d->userdata + config_.shadow->userdata,
                               d->userdata + model_->nuserdata);
  };
  const std::vector<double> before = memory();
  mj_forward(model_.get(), d.get());
  mj_step1(model_.get(), d.get());
  EXPECT_EQ(memory(), before);
  mj_step2(model_.get(), d.get());
  mj_forward(model_.get(), d.get());
  EXPECT_NE(memory(), before);
  EXPECT_EQ(shadow(d.get()), shadow_after(kShadowSteps + 2));
}

// The step may change between two steps; the clock continues with the new one.
TEST_F(ShadowData, ANewStepStartsAnew) {
  const DataPointer d = start(model_.get());
  steps(d.get(), 100);
  mj_forward(model_.get(), d.get());  // the shadow has come to the time of the change
  const double changed = d->time;
  model_->opt.timestep *= 0.5;
  steps(d.get(), 11);
  EXPECT_EQ(shadow_entries(config_, d.get()).step, model_->opt.timestep);
  EXPECT_EQ(shadow_entries(config_, d.get()).origin, changed);
  EXPECT_EQ(shadow_entries(config_, d.get()).steps, 10.0);
}

// At 1e6 s the round-off of the time is larger than a millionth of the step.
TEST_F(ShadowData, FollowsEveryStepAtLargeTimes) {
  const ModelPointer m = load(mjcf(shadowed("bench_ring", {"initial.x=[1e-4]"})));
  const DataPointer d = start(m.get());
  const plugin::Config config = plugin::make_config(m.get());
  d->time = 1e6;
  for (int k = 0; k < 101; ++k) mj_step(m.get(), d.get());
  EXPECT_EQ(shadow_entries(config, d.get()).origin, 1e6);
  EXPECT_EQ(shadow_entries(config, d.get()).steps, 100.0);
}

TEST_F(ShadowData, AStepThatIsTooLargeIsRefusedByItsKey) {
  EXPECT_TRUE(contains(load_refusal(mjcf(shadowed("bench_ring", {"run.step=0.05"}))),
                       {"mujoco.shadow", "the limit of the stiffest bending mode", "run.step"}));
}

TEST(ShadowMark, ChangesWithTheCurrentLimitOfMagnets) {
  Model m = prepare(shipped("paper_magnetic"));
  const double before = plugin::mark_of(m);
  m.first().magnets->current_limit *= 0.5;
  EXPECT_NE(plugin::mark_of(m), before);
}

int warnings = 0;

// An edited mjModel is another machine: the shadow follows it from then on, and reports this once.
TEST_F(ShadowData, AnEditStartsItAnewWithAWord) {
  const ModelPointer m = load(mjcf(shadowed("bench_ring", {"initial.x=[1e-4]"})));
  const DataPointer d = start(m.get());
  const auto said_by_fixture = mju_user_warning;
  mju_user_warning = [](const char* text) {
    ++warnings;
    EXPECT_NE(std::string(text).find("edited"), std::string::npos) << text;
  };
  warnings = 0;
  const int joint = mj_name2id(m.get(), mjOBJ_JOINT, names::bending_joint('x', 1).c_str());
  for (int edit = 1; edit <= 2; ++edit) {
    for (int k = 0; k < 100; ++k) mj_step(m.get(), d.get());
    const double changed = d->time;
    m->jnt_stiffness[joint] *= 0.5;
    for (int k = 0; k < 101; ++k) mj_step(m.get(), d.get());
    const plugin::Config config = plugin::make_config(m.get());
    EXPECT_NEAR(shadow_entries(config, d.get()).origin, changed, 1e-12) << edit;
    EXPECT_EQ(shadow_entries(config, d.get()).steps, 100.0) << edit;
    // Both differ by the start's velocity, half a step old: about 1e-6 m. The old stiffness would
    // move it by dk x t^2 / (2 m) = 1.2e-5 m.
    const Eigen::Vector2d here(d->qpos[m->jnt_qposadr[joint]], 0.0);
    EXPECT_NEAR(shadow_of(config, d.get())[0], here.x(), 3e-6) << edit;
    EXPECT_EQ(warnings, 1) << edit;
  }
  mju_user_warning = said_by_fixture;
}

// A failure is reported once, and no sensor ever has a NaN.
TEST_F(ShadowData, AFailureStopsItWithOneWarning) {
  const ModelPointer m = load(mjcf(shadowed("paper_passive", {"rotor.modes=2"})));
  const plugin::Config config = plugin::make_config(m.get());
  const DataPointer d = start(m.get());
  for (int k = 0; k < 100; ++k) mj_step(m.get(), d.get());
  const int velocity =
      config.shadow->userdata + plugin::kEntries<plugin::ShadowEntries> + 6 + config.model.nq();
  d->userdata[velocity] = d->userdata[velocity + 1] = 1.7e308;
  const auto said_by_fixture = mju_user_warning;
  mju_user_warning = [](const char* text) {
    ++warnings;
    EXPECT_NE(std::string(text).find("shadow"), std::string::npos) << text;
  };
  warnings = 0;
  const std::vector<double> before = shadow_of(config, d.get());
  for (int k = 0; k < 100; ++k) {
    mj_step(m.get(), d.get());
    for (const char* name : {names::kShadowGap, names::kShadowNormalForce,
                             names::kShadowFrictionForce, names::kShadowRotor}) {
      ASSERT_TRUE(std::isfinite(sensor(m.get(), d.get(), name))) << name;
    }
  }
  EXPECT_EQ(warnings, 1);
  EXPECT_EQ(shadow_of(config, d.get()), before) << "it stays where it was";
  EXPECT_EQ(shadow_entries(config, d.get()).status, static_cast<double>(Status::kDiverged));

  // The user enlarges the step beyond what the native model takes.
  warnings = 0;
  mj_resetDataKeyframe(m.get(), d.get(), 0);
  m->opt.timestep = 1e-2;
  for (int k = 0; k < 5; ++k) {
    if (k > 2) d->time += m->opt.timestep;
    mj_forward(m.get(), d.get());
  }
  EXPECT_EQ(warnings, 1);
  EXPECT_EQ(shadow_entries(config, d.get()).steps, 0.0) << "it stands still";
  mju_user_warning = said_by_fixture;
}

}  // namespace
}  // namespace rotorub::test
