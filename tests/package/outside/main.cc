// A stranger's program: reads a scene with the installed library, assembles its model, and asks it
// something that can be worked out by hand. Prints what is wrong; exit code 1 then.

#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdio>
#include <exception>

#include "native_model/dynamics/dynamics.h"
#include "native_model/scene/reader.h"
#include "native_model/system/model.h"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: outside bench_ring.toml\n");
    return 2;
  }
  const rotorub::Model model = rotorub::make_model(rotorub::scene::read_scene(argv[1]));
  const rotorub::State state = rotorub::initial_state(model);
  const Eigen::Matrix3d admittance = rotorub::contact_admittance(model, state.t, state.q.data());

  // bench_ring: a rotor of 2 kg against a ring of 1 kg, so 1/2 + 1/1.
  if (std::abs(admittance(0, 0) - 1.5) > 1e-12) {
    std::fprintf(stderr, "contact admittance %g /kg, expected 1.5 /kg\n", admittance(0, 0));
    return 1;
  }
  std::printf("rotorub beside MuJoCo %s\n", mj_versionString());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
