// A rotor that moves along the axis of its ring, as users write it.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {

inline constexpr double kLiftMass = 2.0, kLiftRadius = 0.05, kPlay = 5e-4, kWeight = 19.62,
                        kLiftStep = 1e-5;

// A rotor of 2 kg in a fixed ring, on slides across and along the axis and a hinge, unless `joints`
// says otherwise.
struct Lift {
  std::string across = R"(<joint type="slide" axis="0 1 0"/>)";
  std::string joints = "";
  double inertia = 5e-3;  // kg m^2, about every axis: m r^2
  double armature = 0.0;  // of the spin
  double friction = 0.5, restitution = 0.0, tangential = 0.0, step = kLiftStep;
  std::string contact = "rigid";
  std::string turn = "1 0 0 0";  // of the whole machine
  std::string bodies = "", more = "";
};

inline std::string document(const Lift& x) {
  const std::string soft = " solref=\"-4e8 -39900\" solimp=\"0.9999 0.9999 0.001\" margin=\"5e-7\"";
  const std::string both = number(x.friction) + " " + number(x.friction);
  const std::string pair = x.contact == "rigid"  ? R"(condim="1" margin="5e-6" gap="1")"
                           : x.contact == "cone" ? "condim=\"3\" friction=\"" + both + "\"" + soft
                                                 : "condim=\"1\"" + soft;
  const std::string joints = !x.joints.empty()
                                 ? x.joints
                                 : R"(<joint name="press" type="slide" axis="1 0 0"/>)" + x.across +
                                       R"(<joint name="lift" type="slide" axis="0 0 1"/>
      <joint name="spin" type="hinge" axis="0 0 1" armature=")" +
                                       number(x.armature) + "\"/>";
  const bool free = joints == "<freejoint/>";
  const std::string frame = "<body name=\"frame\" quat=\"" + x.turn + "\">";
  const auto sensor = [](const std::string& name) {
    return "<user name=\"" + name +
           R"(" objtype="geom" objname="disc" datatype="real" needstage="acc" dim="1"/>)";
  };
  const auto numeric = [](const std::string& name, double value) {
    return "<numeric name=\"rotorub_" + name + "\" data=\"" + number(value) + "\"/>";
  };
  return "<mujoco><option timestep=\"" + number(x.step) +
         "\" gravity=\"0 0 0\" collision=\"predefined\" cone=\"elliptic\" "
         "tolerance=\"1e-14\"/><size nuserdata=\"40\"/>"
         "<worldbody>" +
         (free ? "" : frame) + R"(<body name="rotor">)" + joints +
         "<inertial pos=\"0 0 0\" mass=\"2\" diaginertia=\"" + number(x.inertia) + " " +
         number(x.inertia) + " " + number(x.inertia) +
         R"("/><geom name="disc" type="sphere" size="0.05"/></body>)" + (free ? frame : "") +
         x.bodies +
         R"(<geom name="bore" type="sphere" size="0.0505"/></body></worldbody>
    <contact><pair geom1="disc" geom2="bore" )" +
         pair + "/></contact>" + x.more + "<sensor>" + sensor("normal_force") +
         sensor("friction_force") + sensor("slip") + sensor("rotorub_active") +
         R"(</sensor><custom><text name="rotorub_rotor_geom" data="disc"/><text name="rotorub_ring_geom" data="bore"/>
    <text name="rotorub_contact" data=")" +
         x.contact + "\"/>" + numeric("clearance", kPlay) + numeric("friction", x.friction) +
         (x.contact == "rigid" ? numeric("restitution", x.restitution) : "") +
         (x.tangential > 0.0 ? numeric("tangential_restitution", x.tangential) : "") +
         "</custom></mujoco>";
}

// A rotor that only friction turns; across the load it is held.
inline Lift held_across() {
  Lift x;
  x.across = "";
  return x;
}

class Axial : public HookedTest {
 protected:
  // Coordinates and speeds of Lift's joints.
  static double& of(const mjModel* m, mjtNum* all, const char* joint) {
    return all[m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, joint)]];
  }
  // Pressed against the ring with 100 N, under its weight.
  static DataPointer pressed(const mjModel* m, double along = 0.0, double spin = 0.0) {
    DataPointer d = start(m);
    of(m, d->qpos, "press") = kPlay;
    of(m, d->qvel, "lift") = along;
    of(m, d->qvel, "spin") = spin;
    of(m, d->qfrc_applied, "press") = 100.0;
    of(m, d->qfrc_applied, "lift") = -kWeight;
    return d;
  }
  static void run(const mjModel* m, mjData* d, double time) {
    const long steps = std::lround(time / m->opt.timestep);
    for (long i = 0; i < steps; ++i) mj_step(m, d);
  }
};

}  // namespace rotorub::test
