// Runs a scene and prints its first impacts.
#include <cstdio>
#include <exception>

#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"

int main(int argc, char** argv) try {
  const auto scene = rotorub::scene::read_scene(argc > 1 ? argv[1] : "rotor.toml");
  const rotorub::Trajectory run = rotorub::run_native(scene);
  for (std::size_t i = 0; i < run.impacts.size() && i < 5; ++i) {
    std::printf("%.4f ms  %.4g N s\n", 1e3 * run.impacts[i].t, run.impacts[i].normal_impulse);
  }
  return run.status == rotorub::Status::kOk ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
