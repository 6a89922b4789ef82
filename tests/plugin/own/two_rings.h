// A user's model of a rigid shaft of 2 kg, free to move, tilt and spin, in two rings 0.2 m apart.
#pragma once

#include <string>

namespace rotorub::test {

struct TwoRings {
  std::string contact = "rigid";
  double friction = 0.0, restitution = 0.5;
  double clearance[2] = {5e-4, 5e-4};
  int rings = 2;           // 1: one ring in the middle
  double ring_mass = 0.0;  // 0: fixed rings
  bool tilts = true;
  std::string second = "_2";  // ending of the names of the second contact
  std::string custom = "", bodies = "", constraints = "", sensors = "";
  std::string userdata = "64";
};

inline std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

inline std::string ring_body(const TwoRings& x, const std::string& name, const std::string& z) {
  const std::string joints =
      x.ring_mass > 0.0
          ? R"(<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><inertial pos="0 0 0"
                 mass=")" +
                number(x.ring_mass) + R"(" diaginertia="1e-3 1e-3 1e-3"/>)"
          : "";
  return "<body name=\"" + name + "\" pos=\"0 0 " + z + "\">" + joints + "<geom name=\"" + name +
         "\" type=\"cylinder\" size=\"0.06 0.01\"/></body>";
}

inline std::string numbers_of(const TwoRings& x, int which, const std::string& disc,
                              const std::string& ring, const std::string& end) {
  const auto text = [&](const std::string& name, const std::string& data) {
    return "<text name=\"rotorub_" + name + end + "\" data=\"" + data + "\"/>";
  };
  const auto numeric = [&](const std::string& name, double data) {
    return "<numeric name=\"rotorub_" + name + end + "\" data=\"" + number(data) + "\"/>";
  };
  return text("rotor_geom", disc) + text("ring_geom", ring) + text("contact", x.contact) +
         numeric("clearance", x.clearance[which]) + numeric("friction", x.friction) +
         numeric("restitution", x.restitution);
}

inline std::string document(const TwoRings& x) {
  const std::string pair = x.contact == "rigid" ? "condim=\"1\" margin=\"5e-6\" gap=\"1\""
                                                : "condim=\"1\" solref=\"-4e8 -10211.0255\" "
                                                  "solimp=\"0.9999 0.9999 0.001\" margin=\"5e-7\"";
  const auto sensors = [](const std::string& end) {
    std::string all;
    for (const char* name : {"gap", "gap_rate", "slip", "normal_force", "friction_force"}) {
      all += "<user name=\"" + (name + end) +
             "\" objtype=\"body\" objname=\"shaft\" datatype=\"real\" "
             "needstage=\"vel\" dim=\"1\"/>";
    }
    return all;
  };
  const bool two = x.rings == 2;
  const auto disc = [](const std::string& name, const std::string& z) {
    return "<geom name=\"" + name + "\" type=\"cylinder\" size=\"0.05 0.01\" pos=\"0 0 " + z +
           "\"/>";
  };
  const auto contact = [&](const std::string& a, const std::string& b) {
    return "<pair geom1=\"" + a + "\" geom2=\"" + b + "\" " + pair + "/>";
  };
  return R"(<mujoco><option timestep="1e-5" gravity="0 0 0" collision="predefined"/>
  <size nuserdata=")" +
         x.userdata + R"("/>
  <worldbody>
    <body name="shaft">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>)" +
         (x.tilts ? R"(<joint type="hinge" axis="1 0 0"/><joint type="hinge" axis="0 1 0"/>)"
                  : "") +
         R"(<joint type="hinge" axis="0 0 1"/>
      <inertial pos="0 0 0" mass="2" diaginertia="0.02 0.02 2e-3"/>)" +
         (two ? disc("disc", "-0.1") + disc("far", "0.1") : disc("disc", "0")) + "</body>" +
         (two ? ring_body(x, "ring", "-0.1") + ring_body(x, "holder", "0.1")
              : ring_body(x, "ring", "0")) +
         x.bodies + "</worldbody><contact>" + contact("disc", "ring") +
         (two ? contact("far", "holder") : "") + "</contact>" + x.constraints + "<sensor>" +
         sensors("") + (two ? sensors(x.second) : "") + x.sensors + "</sensor><custom>" +
         numbers_of(x, 0, "disc", "ring", "") +
         (two ? numbers_of(x, 1, "far", "holder", x.second) : "") + x.custom + "</custom></mujoco>";
}

}  // namespace rotorub::test
