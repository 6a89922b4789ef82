// A ball slides on a floor in MuJoCo alone, without rotorub's library. The program prints how much
// of the time the ball is in contact, with which force, and how friction brakes it: for MuJoCo as
// it is; with a small friction reference B_t (in the XML of MuJoCo 2.3.6 and later: <pair
// solreffriction="0 -1"/>); and with the cone corrected for sliding by the callback below, which
// may be copied into any program. The exact answers are 100 %, 9.81 N and 4.905 m/s^2.
//
//   g++ -std=c++20 -O2 sliding_contact.cc -lmujoco -o sliding_contact && ./sliding_contact
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdio>
#include <vector>

// Coulomb's law for MuJoCo's elliptic cone: mjcb_control = coulomb_cones. In sliding the cone lifts
// a contact by |z|, z_i = mu_i (a + R f - a_ref)_i of the friction rows; the normal reference is
// lowered by the same amount (de Saxce and Feng 1998). |z| is unknown before the solution, so
// MuJoCo's solver is run four times to find it. This is enough while mu^2 A_TT < A_NN, where A are
// the mobilities at the contact; rotorub's plugin has no such limit (rotorub_cone_coulomb_pair).
void coulomb_cones(const mjModel* m, mjData* d) {
  const std::vector<mjtNum> reference(d->efc_aref, d->efc_aref + d->nefc);
  std::vector<mjtNum> y(reference.size());
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  for (int asked = 0; asked < 4; ++asked) {
    mj_fwdConstraint(m, d);
    mj_mulJacVec(m, d, y.data(), d->qacc);
    for (int i = 0; i < d->ncon; ++i) {
      const mjContact& contact = d->contact[i];
      const int row = contact.efc_address;
      if (row < 0 || contact.dim < 3) continue;
      mjtNum squares = 0.0;
      for (int k = 1; k < contact.dim; ++k) {
        const int t = row + k;
        const mjtNum z =
            contact.friction[k - 1] * (y[t] + d->efc_R[t] * d->efc_force[t] - d->efc_aref[t]);
        squares += z * z;
      }
      d->efc_aref[row] = reference[row] - std::sqrt(squares);
    }
  }
}

namespace {

constexpr mjtNum kFrictionReference = 1.0;  // 1/s, B_t
void friction_reference(const mjModel*, mjData* d) {
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    for (int k = 1; contact.efc_address >= 0 && k < contact.dim; ++k) {
      const int t = contact.efc_address + k;
      d->efc_aref[t] = -kFrictionReference * d->efc_vel[t];
    }
  }
}

constexpr mjtNum kBraking = 0.5 * 9.81;  // m/s^2, mu g
constexpr const char* kFile = "sliding_contact.xml";
constexpr const char* kModel = R"(<mujoco>
  <option timestep="0.001" cone="elliptic"/>
  <worldbody>
    <geom name="floor" type="plane" size="100 100 1" friction="0.5"/>
    <body pos="0 0 0.1">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint type="slide" axis="0 0 1"/>
      <geom name="ball" type="sphere" size="0.1" mass="1" friction="0.5"/>
    </body>
  </worldbody>
</mujoco>)";

void slide(const mjModel* m, const char* name, mjfGeneric callback, mjtNum speed) {
  // While it slides, but at most 1 s.
  const int steps = static_cast<int>(std::fmin(1.0, 0.9 * speed / kBraking) / m->opt.timestep);
  mjcb_control = callback;
  mjData* d = mj_makeData(m);
  d->qvel[0] = speed;
  int touching = 0;
  mjtNum force = 0.0, highest = 0.0;
  for (int k = 0; k < steps; ++k) {
    mj_step(m, d);
    mjtNum f[6] = {};
    if (d->ncon > 0) mj_contactForce(m, d, 0, f);
    touching += f[0] > 0.0;
    force += f[0] / steps;
    highest = std::fmax(highest, d->qpos[2]);
  }
  std::printf(
      "%5.1f m/s  %-26s contact %5.1f %%  force %6.3f N  brakes with %6.4f m/s^2  hops %5.2f mm\n",
      speed, name, 100.0 * touching / steps, force,
      (speed - d->qvel[0]) / (steps * m->opt.timestep), 1e3 * highest);
  mj_deleteData(d);
}

}  // namespace

int main() {
  std::FILE* file = std::fopen(kFile, "w");
  if (!file || std::fputs(kModel, file) < 0 || std::fclose(file) != 0) return 2;
  char error[500] = "";
  mjModel* m = mj_loadXML(kFile, nullptr, error, sizeof error);
  std::remove(kFile);
  if (!m) {
    std::fprintf(stderr, "%s\n", error);
    return 2;
  }
  std::printf("MuJoCo %s, default solref, mu = 0.5, step 1 ms\n", mj_versionString());
  for (const mjtNum speed : {0.1, 1.0, 10.0}) {
    slide(m, "as it is", nullptr, speed);
    slide(m, "friction reference 1/s", friction_reference, speed);
    slide(m, "corrected for sliding", coulomb_cones, speed);
  }
  mj_deleteModel(m);
  return 0;
}
