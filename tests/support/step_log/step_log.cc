// Preloaded into an unmodified MuJoCo program: after step number ROTORUB_STEP_LOG_AT of an mjData,
// counted from time 0, appends one line to the file named by ROTORUB_STEP_LOG_FILE: the sensor
// rotorub_active (0, 1, or - for none), then time, qpos and qvel as the 16 hexadecimal digits of
// their bits.
#include <dlfcn.h>
#include <mujoco/mujoco.h>

#include <bit>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string>

namespace {

std::mutex mutex;
std::map<const mjData*, long>& steps() {
  static auto* const all = new std::map<const mjData*, long>;
  return *all;
}

void write(std::string& line, const double* values, int count) {
  char text[20];
  for (int i = 0; i < count; ++i) {
    std::snprintf(text, sizeof text, "%016" PRIx64 " ", std::bit_cast<std::uint64_t>(values[i]));
    line += text;
  }
}

std::string line_of(const mjModel* m, const mjData* d) {
  const int active = mj_name2id(m, mjOBJ_SENSOR, "rotorub_active");
  std::string line = active < 0 ? "- " : d->sensordata[m->sensor_adr[active]] == 1.0 ? "1 " : "0 ";
  write(line, &d->time, 1);
  write(line, d->qpos, m->nq);
  write(line, d->qvel, m->nv);
  return line + "\n";
}

}  // namespace

extern "C" void mj_step(const mjModel* m, mjData* d) {
  static const auto step =
      reinterpret_cast<void (*)(const mjModel*, mjData*)>(dlsym(RTLD_NEXT, "mj_step"));
  const bool first = d->time == 0.0;
  step(m, d);
  const char* name = std::getenv("ROTORUB_STEP_LOG_FILE");
  const char* at = std::getenv("ROTORUB_STEP_LOG_AT");
  if (!name || !at) return;
  const std::lock_guard<std::mutex> lock(mutex);
  long& count = steps()[d];
  count = first ? 1 : count + 1;
  if (count != std::atol(at)) return;
  // A single write, so that a program that waits for the line sees all of it.
  if (std::FILE* file = std::fopen(name, "a")) {
    std::fputs(line_of(m, d).c_str(), file);
    std::fclose(file);
  }
}
