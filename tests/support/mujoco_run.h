// Runs in MuJoCo with a contact model and step of the test's choice.
#pragma once

#include <gtest/gtest.h>

#include "compare/engine/mujoco_engine.h"

namespace rotorub::test {

// step: s. Fails the test where the run does not end well.
inline Trajectory mujoco_run(const scene::Scene& scene, scene::ContactModel contact, double step) {
  MujocoOptions options;
  options.contact = contact;
  options.step = step;
  Trajectory t = run_mujoco(scene, options);
  EXPECT_EQ(t.status, Status::kOk) << t.message;
  return t;
}

}  // namespace rotorub::test
