// A machine as a user writes it: a disc of 2 kg on two slides and a hinge in a ring of 1 kg on two
// slides, without springs. The fields of Machine contain the MJCF that a test adds.
#pragma once

#include <string>

#include "tests/support/mujoco_document.h"

namespace rotorub::test {

inline constexpr double kEps = 0.5;

struct Machine {
  std::string ring_joint = "";   // attributes of the slide ring_x
  std::string rotor_joint = "";  // of rotor_x
  std::string spin = "";         // of the hinge spin
  bool ring_moves = true;        // false: without slides
  std::string bodies = "", constraints = "", ring_geoms = "", pairs = "";
  std::string option = "";
  std::string contact = "rigid";
  double friction = 0.0, restitution = kEps;
  std::string custom = "";  // further elements
};

inline std::string document(const Machine& x) {
  // sqrt(K) h = 0.2; K and B for a restitution of 0.5, as in bench_ring.xml.
  const std::string pair =
      x.contact == "rigid"
          ? "margin=\"5e-6\" gap=\"1\""
          : "solref=\"-4e8 -10211.0255\" solimp=\"0.9999 0.9999 0.001\" margin=\"5e-7\" gap=\"0\"";
  const std::string slides = R"(<joint name="ring_x" type="slide" axis="1 0 0" )" + x.ring_joint +
                             R"(/>
      <joint name="ring_y" type="slide" axis="0 1 0"/>)";
  return R"(<mujoco>
  <option timestep="1e-5" gravity="0 0 0" collision="predefined" )" +
         x.option + R"(/>
  <size nuserdata="32"/>
  <worldbody>
    <body name="shaft">
      <joint name="rotor_x" type="slide" axis="1 0 0" )" +
         x.rotor_joint + R"(/>
      <joint name="rotor_y" type="slide" axis="0 1 0"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/>
      <body name="rotor">
        <joint name="spin" type="hinge" axis="0 0 1" )" +
         x.spin + R"(/>
        <inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/>
        <geom name="disc" type="cylinder" size="0.05 0.01"/>
      </body>
    </body>
    <body name="ring">
      )" +
         (x.ring_moves ? slides : "") +
         R"(
      <inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/>
      <geom name="bore" type="cylinder" size="0.06 0.01"/>
      )" +
         x.ring_geoms +
         R"(
    </body>
    )" + x.bodies +
         R"(
  </worldbody>
  )" + x.constraints +
         R"(
  <contact>
    <pair geom1="disc" geom2="bore" condim="1" )" +
         pair + R"(/>
    )" + x.pairs +
         R"(
  </contact>
  <sensor>
    <user name="normal_force" objtype="geom" objname="disc" datatype="real" needstage="acc" dim="1"/>
    <user name="friction_force" objtype="geom" objname="disc" datatype="real" needstage="acc" dim="1"/>
    <user name="slip" objtype="geom" objname="disc" datatype="real" needstage="vel" dim="1"/>
  </sensor>
  <custom>
    <text name="rotorub_rotor_geom" data="disc"/>
    <text name="rotorub_ring_geom" data="bore"/>
    <text name="rotorub_contact" data=")" +
         x.contact + R"("/>
    <numeric name="rotorub_clearance" data="5e-4"/>
    <numeric name="rotorub_friction" data=")" +
         std::to_string(x.friction) + R"("/>
    <numeric name="rotorub_restitution" data=")" +
         std::to_string(x.restitution) + R"("/>
    )" + x.custom +
         R"(
  </custom>
</mujoco>)";
}

// Constraints as stiff as MuJoCo allows.
inline const std::string kHard = " solimp=\"0.9999 0.9999 0.001\" ";

inline std::string equality(const std::string& what) { return "<equality>" + what + "</equality>"; }
inline Machine welded() {
  Machine x;
  x.constraints = equality("<weld body1=\"ring\"" + kHard + "/>");
  return x;
}
inline Machine locked() {
  Machine x;
  x.constraints = equality("<joint joint1=\"ring_x\"" + kHard + "/>");
  return x;
}
inline Machine pinned() {
  Machine x;
  x.constraints = equality("<connect body1=\"ring\" anchor=\"0 0 0\"" + kHard + "/>");
  return x;
}
inline Machine at_limit() {
  Machine x;  // the ring stands 0.1 um in its limit
  x.ring_joint = "limited=\"true\" range=\"-1 -1e-7\" solimplimit=\"0.9999 0.9999 0.001\"";
  return x;
}
inline Machine at_tendon_limit() {
  Machine x;
  x.constraints =
      "<tendon><fixed name=\"stop\" limited=\"true\" range=\"-1 -1e-7\" solimplimit=\"0.9999 "
      "0.9999 0.001\"><joint joint=\"ring_x\" coef=\"1\"/></fixed></tendon>";
  return x;
}
inline Machine tendon_held() {
  Machine x;
  x.constraints =
      "<tendon><fixed name=\"rope\"><joint joint=\"ring_x\" coef=\"1\"/></fixed></tendon>" +
      equality("<tendon tendon1=\"rope\"" + kHard + "/>");
  return x;
}
inline Machine tied_to(double mass) {
  Machine x;
  x.bodies = R"(<body name="base"><joint type="slide" axis="1 0 0"/>
      <joint type="slide" axis="0 1 0"/><inertial pos="0 0 0" mass=")" +
             std::to_string(mass) + R"(" diaginertia="1 1 1"/></body>)";
  x.constraints = equality("<weld body1=\"shaft\" body2=\"base\"" + kHard + "/>");
  return x;
}
inline constexpr double kLoss = 50.0;  // N
inline Machine rubbing_ring() {
  Machine x;
  x.ring_joint = "frictionloss=\"50\" solimpfriction=\"0.9999 0.9999 0.001\"";
  return x;
}
// A part of 3 kg touches the far side of the ring, 0.1 um deep.
inline Machine loose_part() {
  Machine x;
  x.ring_geoms = R"(<geom name="cheek" type="sphere" size="0.01" pos="0.06 0 0"/>)";
  x.bodies = R"(<body name="part" pos="0.0799999 0 0"><joint type="slide" axis="1 0 0"/>
      <inertial pos="0 0 0" mass="3" diaginertia="1 1 1"/>
      <geom name="part" type="sphere" size="0.01"/></body>)";
  x.pairs = "<pair geom1=\"cheek\" geom2=\"part\" condim=\"1\"" + kHard + "/>";
  return x;
}

}  // namespace rotorub::test
