// The normal force of a steady rub in MuJoCo, as the sensors show it.
#pragma once

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {

// The force of an annular rub is to be met at a step of 1e-5; MuJoCo's implicit damping alone, d
// times the velocity of half a step away, makes 6.5e-5 of it.
inline constexpr double kForce = 1e-4;
inline constexpr double kScatter = 1e-3;

struct NormalForce {
  double mean = 0.0, deviation = 0.0;  // N
  int steps_in_contact = 0;
};

// Over the last `steps` of a scene; the friction force is the law's at each of them.
inline NormalForce normal_force(const scene::Scene& scene, int steps) {
  namespace names = mjcf_names;
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const auto all = static_cast<int>(std::lround(scene.run.end / scene.run.step));
  double sum = 0.0, squares = 0.0;
  NormalForce out;
  for (int k = 0; k < all; ++k) {
    mj_step(m.get(), d.get());
    if (k < all - steps) continue;
    const double force = sensor(m.get(), d.get(), names::kNormalForce);
    sum += force;
    squares += force * force;
    if (force > 0.0) ++out.steps_in_contact;
    EXPECT_NEAR(sensor(m.get(), d.get(), names::kFrictionForce),
                -scene.first().contact->friction.coefficient * force, 1e-9 * force);
  }
  out.mean = sum / steps;
  out.deviation = std::sqrt(std::max(0.0, squares / steps - out.mean * out.mean));
  return out;
}

}  // namespace rotorub::test
