// A user's program: reads bench_ring with the installed library, runs it natively, loads it into
// MuJoCo, and compares both with values computed by hand. It prints errors and then has the exit
// code 1.

#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>

#include "mjcf/writer.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "plugin/hooks.h"
#include "plugin/linearise.h"

namespace {

bool is(const char* what, double value, double expected, double tolerance) {
  if (std::abs(value - expected) <= tolerance * std::abs(expected)) return true;
  std::fprintf(stderr, "%s: %.9g, expected %.9g\n", what, value, expected);
  return false;
}

// A rotor of 2 kg and a ring of 1 kg, restitution 0.5, no friction.
bool native_impact(const rotorub::scene::Scene& scene) {
  const rotorub::Trajectory run = rotorub::run_native(scene);
  if (run.impacts.empty()) {
    std::fprintf(stderr, "no impact: %s\n", run.message.c_str());
    return false;
  }
  const rotorub::Impact& first = run.impacts.front();
  return is("rebound, m/s", first.gap_rate_after, -0.5 * first.gap_rate_before, 1e-9) &&
         is("impulse, N s", first.normal_impulse,
            -1.5 * first.gap_rate_before / (1.0 / 2.0 + 1.0 / 1.0), 1e-9);
}

// In flight the trace of A is minus the sum of damping over mass: twice 40/2 of the rotor, twice
// 200/1 of the ring, and the drive's 0.5/1e-3.
bool mujoco_in_flight(const rotorub::scene::Scene& scene, const char* file) {
  const rotorub::plugin::Hooks hooks;
  std::ofstream(file) << rotorub::mjcf(scene);
  char error[1000] = "";
  mjModel* m = mj_loadXML(file, nullptr, error, sizeof error);
  if (m == nullptr) {
    std::fprintf(stderr, "%s\n", error);
    return false;
  }
  mjData* d = mj_makeData(m);
  mj_step(m, d);  // the first step from a state that was set is half a kick (differences.h)
  const bool right =
      rotorub::plugin::hooks_installed() &&
      is("trace of A, 1/s", rotorub::plugin::linearise(m, d).A.trace(), -940.0, 1e-3);
  mj_deleteData(d);
  mj_deleteModel(m);
  return right;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fprintf(stderr, "usage: outside bench_ring.toml FILE.xml\n");
    return 2;
  }
  const std::string smooth[] = {"contact.friction=0"};
  const rotorub::scene::Scene scene = rotorub::scene::read_scene(argv[1], smooth);
  if (!native_impact(scene) || !mujoco_in_flight(scene, argv[2])) return 1;
  std::printf("rotorub beside MuJoCo %s\n", mj_versionString());
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
