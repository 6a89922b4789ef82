// The solref that a run of MuJoCo reports.
#include <gtest/gtest.h>

#include "compare/engine/mujoco_engine.h"
#include "mjcf/soft_contact.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

TEST(Solref, OfTheDefaultIsMujocos) {
  mjtNum solref[mjNREF], solimp[mjNIMP];
  mj_defaultSolRefImp(solref, solimp);
  EXPECT_EQ(solref[0], DefaultSolref::kTimeConstant);
  EXPECT_EQ(solref[1], DefaultSolref::kDampingRatio);
  EXPECT_EQ(DefaultSolref::kStiffness, 2500.0);
  EXPECT_EQ(DefaultSolref::kDamping, 100.0);
}

std::string told_by(const Engine& engine, const scene::Scene& scene) {
  std::string told;
  RunRequest request;
  request.solref = &told;
  EXPECT_EQ(engine.run(scene, request).status, Status::kOk);
  return told;
}

TEST(Solref, IsThatOfTheRun) {
  using enum scene::ContactModel;
  const scene::Scene scene = shipped("bench_ring", {"run.end=1e-3"});
  EXPECT_EQ(told_by(*mujoco_engine(kRigid), scene), "");
  for (const scene::ContactModel model : {kCoulomb, kCone, kConeCoulomb}) {
    const SoftContact soft = soft_contact(scene, model, scene.run.step);
    EXPECT_EQ(told_by(*mujoco_engine(model), scene), solref_text(-soft.stiffness, -soft.damping));
  }
  EXPECT_EQ(told_by(*default_cone_engine(), scene), "0.02 1");
  // A compliant contact has its own stiffness and damping.
  EXPECT_EQ(told_by(*mujoco_engine(kCoulomb), shipped("compliant_ring", {"run.end=1e-3"})), "");
}

}  // namespace
}  // namespace rotorub::test
