// What MuJoCo's contact models make of a rub: `cone_figures SCENE.toml [CONTACT] [KEY=VALUE...]
// [diagexact]` runs the scene with contact model `cone`, or CONTACT, and prints one line, against
// the native `event`. Built for MuJoCo 2.2.2 and for today's: a table of compare/docs/findings.md.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "plugin/hooks.h"
#include "plugin/model/mujoco_versions.h"

namespace {

using namespace rotorub;

struct Figures {
  double contact = 0.0;  // share of the time from the first touch
  double mean = 0.0;     // N, from then on
  double scatter = 0.0;  // N, standard deviation over the steps
  double error = 0.0;    // m, largest of the rotor's position
  double us_per_step = 0.0;
};

void set_exact_diagonal(mjModel* m) {
#if mjVERSION_HEADER >= 3009000
  m->opt.enableflags |= mjENBL_DIAGEXACT;
#else
  static_cast<void>(m);
  throw std::invalid_argument("diagexact came with MuJoCo 3.9");
#endif
}

Figures step_through(const mjModel* m, double end, const std::vector<double>& times,
                     const Trajectory& reference) {
  mjData* d = mj_makeData(m);
  mj_resetDataKeyframe(m, d, mj_name2id(m, mjOBJ_KEY, mjcf_names::kStartKey));
  const int force = m->sensor_adr[mj_name2id(m, mjOBJ_SENSOR, mjcf_names::kNormalForce)];
  const int rotor = mj_name2id(m, mjOBJ_GEOM, mjcf_names::kRotorContact);
  const double h = m->opt.timestep;
  const auto steps = static_cast<std::int64_t>(std::llround(end / h));
  Figures out;
  double sum = 0.0, squares = 0.0;
  std::int64_t touched = 0, touching = 0;
  std::size_t next = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (std::int64_t k = 0; k < steps; ++k) {
    mj_step(m, d);
    const double f = d->sensordata[force];
    if (f > 0.0 || touched > 0) ++touched;
    if (f > 0.0) ++touching;
    sum += f;
    squares += f * f;
    // geom_xpos belongs to the begin of the step.
    if (next < times.size() && static_cast<double>(k) * h >= times[next] - 0.5 * h) {
      const mjtNum* at = d->geom_xpos + 3 * rotor;
      out.error = std::max(out.error, std::hypot(at[0] - reference.column("rotor_x")[next],
                                                 at[1] - reference.column("rotor_y")[next]));
      ++next;
    }
  }
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
  out.us_per_step = took.count() / static_cast<double>(steps);
  const auto n = static_cast<double>(std::max<std::int64_t>(touched, 1));
  out.contact = static_cast<double>(touching) / n;
  out.mean = sum / n;
  out.scatter = std::sqrt(std::max(0.0, squares / n - out.mean * out.mean));
  mj_deleteData(d);
  return out;
}

int figures(const std::string& file, bool exact, const std::string& contact,
            std::vector<std::string> overrides) {
  overrides.push_back("mujoco.contact=" + contact);
  const scene::Scene scene = scene::read_scene(file, overrides);
  std::vector<double> times;
  const auto steps = std::llround(scene.run.end / scene.run.step);
  for (int i = 1; i <= 400; ++i) {
    times.push_back(static_cast<double>(steps * i / 401) * scene.run.step);
  }
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  options.output_times = times;
  const Trajectory reference = run_native(scene, options);
  const plugin::Hooks hooks;
  char error[1000] = "";
  mjModel* m = plugin::load_text(mjcf(scene), error, sizeof error);
  if (!m) throw std::runtime_error(error);
  if (exact) set_exact_diagonal(m);
  const Figures f = step_through(m, scene.run.end, times, reference);
  std::printf(
      "%-22s MuJoCo %-7s %-8s%-10s contact %6.2f %% (%6.2f %%)  force %10.4f N (%10.4f N) +- "
      "%10.4f N  "
      "error %9.3e m  %5.2f us\n",
      scene.name.c_str(), mj_versionString(), contact.c_str(), exact ? "diagexact" : "",
      100.0 * f.contact, 100.0 * reference.contact_fraction(), f.mean, reference.mean_force(),
      f.scatter, f.error, f.us_per_step);
  mj_deleteModel(m);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2)
      throw std::invalid_argument("cone_figures SCENE.toml [CONTACT] [KEY=VALUE...] [diagexact]");
    bool exact = false;
    std::string contact = "cone";
    std::vector<std::string> overrides;
    for (int i = 2; i < argc; ++i) {
      if (std::strcmp(argv[i], "diagexact") == 0) {
        exact = true;
      } else if (std::strchr(argv[i], '=')) {
        overrides.push_back(argv[i]);
      } else {
        contact = argv[i];
      }
    }
    return figures(argv[1], exact, contact, overrides);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "cone_figures: %s\n", e.what());
    return 2;
  }
}
