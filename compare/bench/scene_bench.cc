#include "compare/bench/scene_bench.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <thread>

#include "compare/base/version.h"
#include "compare/bench/point.h"

namespace rotorub::bench {
namespace {

// The value of the first line of /proc/cpuinfo that begins with `key`.
std::string cpu_info(const std::string& key) {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const auto colon = line.find(": ");
    if (line.rfind(key, 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string widest(const std::string& flags) {
  for (const char* name : {"avx512f", "avx2", "avx", "sse2"}) {
    if ((" " + flags + " ").find(" " + std::string(name) + " ") != std::string::npos) return name;
  }
  return "unknown";
}

}  // namespace

Machine this_machine() {
  Machine m;
  m.processor = cpu_info("model name");
  m.threads = static_cast<int>(std::thread::hardware_concurrency());
  m.instructions = widest(cpu_info("flags"));
#ifdef __clang__
  m.compiler = "clang " __VERSION__;
#else
  m.compiler = "g++ " __VERSION__;
#endif
  m.mujoco = mujoco_version();
  return m;
}

SceneBench bench_scene(const SceneReader& reader, const BenchParameters& parameters,
                       const Progress& progress, const std::atomic<bool>* interrupt) {
  SceneBench bench;
  bench.scene = reader({});
  bench.engines = parameters.engines;
  if (!bench.scene.has_contact()) {
    throw std::invalid_argument(
        fmt::format("{}: the errors of a bench are shares of contact.clearance, but this scene has "
                    "no [contact]",
                    bench.scene.name));
  }
  // Rough shares of the time; the timed repeats take nearly all of it.
  const auto part = [&](double from, double to) {
    return [&progress, from, to](double share, const std::string& what) {
      progress(from + (to - from) * share, what);
    };
  };
  RunRequest request;
  request.interrupt = interrupt;
  request.output_times = common_times(bench.scene.run, parameters.ladder.steps);
  bench.reference = make_reference(bench.scene, request);

  std::vector<Setting> settings;
  for (const BenchEngine& engine : parameters.engines) {
    for (Setting& s : engine.settings(reader, parameters.ladder)) settings.push_back(std::move(s));
  }
  bench.points = error_pass(settings, bench.reference, part(0.0, 0.1), interrupt);
  timing_pass(bench.points, parameters.timing, part(0.1, 0.9), interrupt);
  bench.levels = levels(bench.points, bench.engines, bench.clearance(), bench.reference.error);
  if (parameters.stability_map && !stopped(interrupt)) {
    bench.stability = stability_map(reader, bench.scene, part(0.9, 1.0), interrupt);
  }
  bench.interrupted = stopped(interrupt);
  return bench;
}

}  // namespace rotorub::bench
