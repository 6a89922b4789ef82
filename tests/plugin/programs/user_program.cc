// A user's program: plain C++ against libmujoco, as people write it, with callbacks of its own. It
// knows nothing of rotorub, unless it is built with ROTORUB_LINKED (then Hooks lives through main).
// Run by user_callbacks_test.cc, which holds its lines together.
//
//   user_program MODEL.xml CASE STEPS ROTOR_GEOM RING_GEOM CLEARANCE
//
// CASE inverse: after STEPS, mj_forward and mj_inverse, prints the largest of qfrc_inverse less
// applied and actuators' forces (N, N m). CASE differences: of A of mjd_transitionFD (eps 1e-8)
// then the row of the first velocity: over the first position, over itself. CASE forces: of the
// force sensor "cell" and mj_contactForce, what the sensors of the rub say, and the size of the
// force on the ring by mj_rnePostConstraint. Every other CASE prints one line: calls of the user's
// callback, share of steps with rotorub_active 1, share of steps with a normal force, largest
// penetration in um, then time, qpos and qvel as bits.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#ifdef ROTORUB_LINKED
#include "plugin/hooks.h"
#endif

namespace {

std::atomic<long> calls = 0;
mjfGeneric old_control = nullptr, old_passive = nullptr;

void mine(const mjModel*, mjData*) { ++calls; }
void other(const mjModel*, mjData*) {}
void my_sensor(const mjModel*, mjData*, int) { ++calls; }
mjtNum my_gain(const mjModel*, const mjData*, int) { return 0.0; }
mjtNum my_bias(const mjModel*, const mjData*, int) { return 0.0; }
// Of whatever arguments MuJoCo's version has.
template <typename... Arguments>
int no_collision(Arguments...) {
  return 0;
}
void chained_control(const mjModel* m, mjData* d) {
  ++calls;
  if (old_control) old_control(m, d);
}
void chained_passive(const mjModel* m, mjData* d) {
  ++calls;
  if (old_passive) old_passive(m, d);
}
// Calls who was there before for a while.
void chained_at_first(const mjModel* m, mjData* d) {
  if (++calls < 10 && old_control) old_control(m, d);
}
// Sets itself whenever it is not found in the place.
void set_if_not_there() {
  if (mjcb_control == chained_control) return;
  old_control = mjcb_control;
  mjcb_control = chained_control;
}

// What the user does before his first step.
void begin(const std::string& what, mjModel* m, int type1, int type2) {
  if (what == "control" || what == "taken_off" || what == "replaced" || what == "threads") {
    mjcb_control = mine;
  } else if (what == "passive") {
    mjcb_passive = mine;
  } else if (what == "sensor") {
    mjcb_sensor = my_sensor;
  } else if (what == "magnets") {
    mjcb_act_gain = my_gain;
    mjcb_act_bias = my_bias;
  } else if (what == "chained" || what == "chained_taken_off") {
    old_control = mjcb_control;
    mjcb_control = chained_control;
  } else if (what == "chained_passive") {
    old_passive = mjcb_passive;
    mjcb_passive = chained_passive;
  } else if (what == "chained_at_first") {
    old_control = mjcb_control;
    mjcb_control = chained_at_first;
  } else if (what == "collision") {
    mjCOLLISIONFUNC[std::min(type1, type2)][std::max(type1, type2)] = no_collision;
  } else if (what == "no_contact" || what == "no_contact_reset" || what == "no_contact_null") {
    m->opt.disableflags |= mjDSBL_CONTACT;
  } else if (what == "no_constraint") {
    m->opt.disableflags |= mjDSBL_CONSTRAINT;
  }
  if (what == "reset" || what == "no_contact_reset") mj_resetCallbacks();
  if (what == "no_contact_null" || what == "null") {
    mjcb_control = mjcb_passive = nullptr;
    mjcb_sensor = nullptr;
  }
}

// And between two steps.
void between(const std::string& what, int step, int steps) {
  const bool half = step == steps / 2;
  if (what == "taken_off" && half) mjcb_control = nullptr;
  if (what == "replaced" && half) mjcb_control = other;
  // As one who set himself in front takes himself off.
  if (what == "chained_taken_off" && half && mjcb_control == chained_control) {
    mjcb_control = old_control;
  }
  if (what == "reset_always") mj_resetCallbacks();
  if (what == "set_if_not_there") set_if_not_there();
}

struct Run {
  int active = 0, touching = 0;
  double penetration = 0.0;
  std::string state;
};

void add_bits(std::string& line, const double* values, int count) {
  char text[20];
  for (int i = 0; i < count; ++i) {
    std::snprintf(text, sizeof text, " %016" PRIx64, std::bit_cast<std::uint64_t>(values[i]));
    line += text;
  }
}

double value(const mjModel* m, const mjData* d, const char* sensor) {
  const int id = mj_name2id(m, mjOBJ_SENSOR, sensor);
  return id < 0 ? 0.0 : d->sensordata[m->sensor_adr[id]];
}

Run run(const mjModel* m, const std::string& what, int steps, int rotor, int ring,
        double clearance) {
  Run out;
  mjData* d = mj_makeData(m);
  const int key = mj_name2id(m, mjOBJ_KEY, "start");
  if (key >= 0) mj_resetDataKeyframe(m, d, key);
  for (int k = 0; k < steps; ++k) {
    between(what, k, steps);
    mj_step(m, d);
    out.active += value(m, d, "rotorub_active") == 1.0;
    out.touching += value(m, d, "normal_force") > 0.0;
    const mjtNum *a = d->geom_xpos + 3 * rotor, *b = d->geom_xpos + 3 * ring;
    out.penetration = std::max(out.penetration, std::hypot(a[0] - b[0], a[1] - b[1]) - clearance);
  }
  add_bits(out.state, &d->time, 1);
  add_bits(out.state, d->qpos, m->nq);
  add_bits(out.state, d->qvel, m->nv);
  mj_deleteData(d);
  return out;
}

mjData* stepped(const mjModel* m, int steps) {
  mjData* d = mj_makeData(m);
  mj_resetDataKeyframe(m, d, 0);
  for (int k = 0; k < steps; ++k) mj_step(m, d);
  return d;
}

double left_by_inverse(const mjModel* m, int steps) {
  mjData* d = stepped(m, steps);
  mj_forward(m, d);
  mj_inverse(m, d);
  double left = 0.0;
  for (int i = 0; i < m->nv; ++i) {
    left = std::max(left, std::abs(d->qfrc_inverse[i] - d->qfrc_applied[i] - d->qfrc_actuator[i]));
  }
  mj_deleteData(d);
  return left;
}

// The rotor's first coordinate over itself and its velocity in A, in flight.
void print_differences(const mjModel* m, int steps) {
  mjData* d = stepped(m, steps);
  const int n = 2 * m->nv + m->na;
  std::vector<mjtNum> A(static_cast<std::size_t>(n * n));
  mjd_transitionFD(m, d, 1e-8, 1, A.data(), nullptr, nullptr, nullptr);
  const auto row = static_cast<std::size_t>(m->nv * n);
  std::printf("%.17g %.17g\n", A[row], A[row + static_cast<std::size_t>(m->nv)]);
  mj_deleteData(d);
}

// A load cell, MuJoCo's force of the only contact along normal and tangent, what the sensors of the
// rub say, and MuJoCo's force on the ring.
void print_forces(const mjModel* m, int steps, int ring) {
  mjData* d = stepped(m, steps);
  mjtNum force[6] = {0};
  mj_contactForce(m, d, 0, force);
  const mjtNum* cell = d->sensordata + m->sensor_adr[mj_name2id(m, mjOBJ_SENSOR, "cell")];
  mj_rnePostConstraint(m, d);
  const mjtNum* on_ring = d->cfrc_ext + 6 * m->geom_bodyid[ring] + 3;
  std::printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", cell[0], cell[1], force[0], force[1],
              value(m, d, "normal_force"), value(m, d, "friction_force"),
              std::hypot(on_ring[0], on_ring[1], on_ring[2]));
  mj_deleteData(d);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) return 2;
#ifdef ROTORUB_LINKED
  const rotorub::plugin::Hooks hooks;
#endif
  mju_user_error = [](const char* message) {
    std::printf("error: %s\n", message);
    std::fflush(stdout);
    std::_Exit(1);
  };
  mju_user_warning = [](const char* message) { std::fprintf(stderr, "warning: %s\n", message); };
  char error[1000] = "";
  mjModel* m = mj_loadXML(argv[1], nullptr, error, sizeof error);
  if (!m) {
    std::printf("load: %s\n", error);
    return 1;
  }
  const std::string what = argv[2];
  const int steps = std::atoi(argv[3]);
  const int rotor = mj_name2id(m, mjOBJ_GEOM, argv[4]), ring = mj_name2id(m, mjOBJ_GEOM, argv[5]);
  const double clearance = std::atof(argv[6]);
  if (what == "inverse") {
    std::printf("%g\n", left_by_inverse(m, steps));
    return 0;
  }
  if (what == "differences") {
    print_differences(m, steps);
    return 0;
  }
  if (what == "forces") {
    print_forces(m, steps, ring);
    return 0;
  }
  begin(what, m, m->geom_type[rotor], m->geom_type[ring]);

  std::vector<Run> runs(what == "threads" ? 4 : 1);
  std::vector<std::thread> threads;
  for (Run& one : runs) {
    threads.emplace_back([&] { one = run(m, what, steps, rotor, ring, clearance); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Run& one : runs) {
    std::printf("%ld %g %g %g%s\n", calls.load() / static_cast<long>(runs.size()),
                static_cast<double>(one.active) / steps, static_cast<double>(one.touching) / steps,
                1e6 * one.penetration, one.state.c_str());
  }
  mj_deleteModel(m);
  return 0;
}
