// Machines of users as documents, their twins, and what is said where there is none.
#pragma once

#include <string>

#include "plugin/make_config.h"
#include "plugin/twin/native_twin.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {

inline plugin::NativeTwin twin_of(const mjModel* m) {
  const DataPointer d = start(m);
  return plugin::make_native_twin(m, plugin::make_config(m), d.get());
}
inline plugin::NativeTwin twin_of(const std::string& document) {
  return twin_of(load(document).get());
}

// Empty if there is a twin.
inline std::string twin_refusal(const std::string& document) {
  return message_of<plugin::ConfigError>([&] { twin_of(document); });
}

// A rotor that can bend and tilt in a ring; `rotor` and `ring` are what a test says of their
// bodies.
inline std::string machine(const std::string& rotor, const std::string& ring = "",
                           const std::string& more = "",
                           const std::string& option = "gravity=\"0 0 0\"") {
  return R"(<mujoco><option timestep="1e-5" )" + option + R"(/>
  <size nuserdata="32"/>
  <worldbody>
    )" + rotor +
         R"(
    <body name="ring" pos="0 0 0.1">)" +
         ring + R"(<geom name="bore" type="box" size="0.06 0.06 0.01"
      mass="1" contype="0" conaffinity="0"/></body>
  </worldbody>
  <contact><pair geom1="disc" geom2="bore" condim="1" margin="5e-6" gap="1"/></contact>
  <custom>
    <text name="rotorub_rotor_geom" data="disc"/>
    <text name="rotorub_ring_geom" data="bore"/>
    <text name="rotorub_contact" data="rigid"/>
    <numeric name="rotorub_clearance" data="5e-4"/>
    <numeric name="rotorub_friction" data="0.15"/>
    <numeric name="rotorub_restitution" data="0.5"/>
  </custom>
  )" + more +
         "</mujoco>";
}

inline const std::string kDisc =
    R"(<geom name="disc" type="cylinder" size="0.05 0.01" pos="0 0 0.1" contype="0" conaffinity="0" mass="0"/>)";

// A rigid rotor that tilts in its bearings: a shaft of 3 kg whose centre of mass lies below the
// contact.
inline std::string tilting(const std::string& spin, const std::string& more = "") {
  return machine(R"(<body name="shaft">
      <joint name="x" type="slide" axis="1 0 0" stiffness="3e5" damping="30"/>
      <joint name="y" type="slide" axis="0 1 0" stiffness="4e5" damping="40"/>
      <joint name="tilt_x" type="hinge" axis="1 0 0" stiffness="2e3" damping="0.3"/>
      <joint name="tilt_y" type="hinge" axis="0 1 0" stiffness="3e3" damping="0.2"/>
      <inertial pos="0 0 0.02" mass="1" diaginertia="4e-3 4e-3 1e-3"/>
      <body name="wheel">
        <joint name="spin" type="hinge" axis=")" +
                     spin + R"("/>
        <inertial pos="0 0 0.05" mass="2" diaginertia="6e-3 6e-3 1e-2"/>
        )" + kDisc + R"(
      </body>
    </body>)",
                 "", more);
}

}  // namespace rotorub::test
