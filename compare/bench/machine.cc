#include "compare/bench/machine.h"

#include <fstream>
#include <thread>

#include "compare/base/version.h"

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

}  // namespace rotorub::bench
