// Runs in MuJoCo with the test's choice of contact model and step.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "compare/engine/mujoco_engine.h"

namespace rotorub::test {

// contact, step (s): by default the scene's.
inline MujocoOptions mujoco_options(std::optional<scene::ContactModel> contact,
                                    std::optional<double> step = {}) {
  MujocoOptions options;
  options.contact = contact;
  options.step = step;
  return options;
}

// Fails the test if the run does not end well.
inline Trajectory mujoco_run(const scene::Scene& scene,
                             std::optional<scene::ContactModel> contact = {},
                             std::optional<double> step = {}) {
  Trajectory t = run_mujoco(scene, mujoco_options(contact, step));
  EXPECT_EQ(t.status, Status::kOk) << t.message;
  return t;
}

}  // namespace rotorub::test
