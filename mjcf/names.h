// Names of the elements of a generated MJCF, by which plugin, engine and renderer find them.
// Joints: x_1.., y_1.. (bending modes), spin, torsion_1.., ring_x, ring_y, ring_spin, housing_x,
// housing_y, ring_bristle_x, ring_bristle_y, ring_bristle_spin, bearing_integral_x,
// bearing_integral_y.
#pragma once

#include <cstddef>
#include <string>

namespace rotorub::mjcf_names {

// <custom><text>
inline constexpr const char* kSceneText = "rotorub_scene";      // the scene's TOML
inline constexpr const char* kContactText = "rotorub_contact";  // a word of scene/mujoco.h

// <custom> of a user's own model (plugin/own/own_config.h): texts, then numerics
inline constexpr const char* kOwnMark = "rotorub_";  // prefix of all our names in <custom>
inline constexpr const char* kOwnRotorGeom = "rotorub_rotor_geom";
inline constexpr const char* kOwnRingGeom = "rotorub_ring_geom";
inline constexpr const char* kOwnConeCoulombPair = "rotorub_cone_coulomb_pair";
inline constexpr const char* kOwnClearance = "rotorub_clearance";
inline constexpr const char* kOwnRadius = "rotorub_radius";
inline constexpr const char* kOwnFriction = "rotorub_friction";
inline constexpr const char* kOwnRestitution = "rotorub_restitution";
inline constexpr const char* kOwnTangential = "rotorub_tangential_restitution";
inline constexpr const char* kOwnFrictionReference =
    "rotorub_friction_reference";  // also in generated files
inline constexpr const char* kOwnWidth = "rotorub_width";
inline constexpr const char* kOwnUserData = "rotorub_userdata";  // entries for the whole model

// The name of an element of one auxiliary bearing, counted from 0: "ring", "ring_2".
inline std::string of_bearing(std::size_t bearing, const std::string& name) {
  return bearing == 0 ? name : name + "_" + std::to_string(bearing + 1);
}

// Bodies and geoms
inline constexpr const char* kRotor = "rotor";  // body and its visible disc
// body of the modes with a node at the contact
inline constexpr const char* kRotorNodes = "rotor_nodes";
inline constexpr const char* kRing = "ring";                   // body and its visible bore
inline constexpr const char* kRotorContact = "rotor_contact";  // geoms of the contact pair
inline constexpr const char* kRingContact = "ring_contact";

inline constexpr const char* kGhostRotor = "ghost_rotor";  // mocap bodies that show the shadow
inline constexpr const char* kGhostRing = "ghost_ring";

// Joints
inline std::string bending_joint(char plane, int mode) {  // mode: 1-based
  return std::string(1, plane) + "_" + std::to_string(mode);
}
inline std::string torsion_joint(int mode) { return "torsion_" + std::to_string(mode); }
inline constexpr const char* kSpinJoint = "spin";
// Segment rotor, k from 0: the carrier bodies with their tilt joints, the spinning bodies with
// their spin joints, and the slides of the first carrier.
inline std::string segment(std::size_t k) { return "segment_" + std::to_string(k); }
inline std::string spinning(std::size_t k) { return "spinning_" + std::to_string(k); }
inline std::string tilt(char plane, std::size_t k) {
  return std::string("tilt_") + plane + "_" + std::to_string(k);
}
inline std::string spin(std::size_t k) { return "spin_" + std::to_string(k); }
inline constexpr const char* kEndX = "end_x";
inline constexpr const char* kEndY = "end_y";
inline constexpr const char* kRingX = "ring_x";
inline constexpr const char* kRingY = "ring_y";
inline constexpr const char* kRingSpin = "ring_spin";
inline constexpr const char* kHousing = "housing";
inline constexpr const char* kHousingX = "housing_x";
inline constexpr const char* kHousingY = "housing_y";
// Joints whose velocities are the friction states of a ring's support and of its spin.
inline constexpr const char* kBristles = "ring_bristles";
inline constexpr const char* kBristleX = "ring_bristle_x";
inline constexpr const char* kBristleY = "ring_bristle_y";
inline constexpr const char* kSpinBristle = "ring_bristle_spin";
// Joints whose velocities are the states of the feedback of magnetic bearings, such as the current
// held by an integrator, A. They have no visible motion. Each state has two joints and a body:
// "bearing_integral_x", "bearing2_integral_x".
inline std::string bearing_integral(int i) {
  return (i < 2 ? "bearing" : "bearing" + std::to_string(i / 2 + 1)) +
         (i % 2 == 0 ? "_integral_x" : "_integral_y");
}
inline std::string bearing_integrator(int k) {
  return (k == 0 ? "bearing" : "bearing" + std::to_string(k + 1)) + std::string("_integrator");
}

// Actuators of the scene's magnetic bearings, named like their columns: "bearing_current_x",
// "bearing2_current_x".
inline std::string bearing_current(std::size_t k, int axis) {
  return (k == 0 ? "bearing" : "bearing" + std::to_string(k + 1)) +
         (axis == 0 ? "_current_x" : "_current_y");
}

// Actuators and the tendons that they pull, s_k = a_k . q_f
inline constexpr const char* kActuator[2] = {"actuator_1", "actuator_2"};
inline constexpr const char* kAxis[2] = {"axis_1", "axis_2"};

// Keyframes with the initial state; mujoco-testspeed starts from "test"
inline constexpr const char* kStartKey = "start";
inline constexpr const char* kTestKey = "test";

// Cameras
inline constexpr const char* kContactCamera = "contact";  // along -z onto the contact plane
inline constexpr const char* kObliqueCamera = "oblique";
inline constexpr const char* kSideCamera = "side";

// User sensors
inline constexpr const char* kActive = "rotorub_active";         // 1 with the plugin, 0 without
inline constexpr const char* kGap = "gap";                       // m
inline constexpr const char* kGapRate = "gap_rate";              // m/s
inline constexpr const char* kSlip = "slip";                     // m/s
inline constexpr const char* kNormalForce = "normal_force";      // N
inline constexpr const char* kFrictionForce = "friction_force";  // N, on the rotor along e_t
// The same, scaled by the clearance, or by the force in the sensor's `user` data
inline constexpr const char* kGapScaled = "gap_scaled";
inline constexpr const char* kNormalForceScaled = "normal_force_scaled";
inline constexpr const char* kFrictionForceScaled = "friction_force_scaled";
inline constexpr const char* kCurrent = "current";             // A, on the magnets' two axes
inline constexpr const char* kControlForce = "control_force";  // N, x and y, on the ring
// With [mujoco] shadow: MuJoCo's rotor, and the values of the native model
inline constexpr const char* kRotorPosition = "rotor";                    // m, x and y
inline constexpr const char* kShadowRotor = "shadow_rotor";               // m, x and y
inline constexpr const char* kShadowStator = "shadow_stator";             // m, x and y
inline constexpr const char* kShadowGap = "shadow_gap";                   // m
inline constexpr const char* kShadowNormalForce = "shadow_normal_force";  // N
// N, on the rotor along e_t
inline constexpr const char* kShadowFrictionForce = "shadow_friction_force";

// mjData.userdata entries that the plugin uses (plugin/model/user_data.h)
inline constexpr int kUserDataSingle = 21;
// for each contact after the first, after all other entries
inline constexpr int kPairEntries = 13;
// loop: entries for the memory of a sampled controller.
inline int user_data_size(int nq, bool controlled, std::size_t loop) {
  return kUserDataSingle + (controlled ? 2 * nq : 0) + static_cast<int>(loop);
}
// With contacts on the modal chain these are followed by the state of the `verlet` step of `rigid`
// (plugin/contact/verlet.h): velocities and two slots. A slot has `memory` entries for the stepper,
// `hold` for its controller, and the number of the step.
inline constexpr int kVerletSingle = 3;
inline int verlet_data_size(int nq, std::size_t hold, std::size_t memory) {
  return kVerletSingle + nq + 2 * static_cast<int>(hold + memory + 1);
}
// With [mujoco] shadow these are followed by the shadow's entries, of which `hold` belong to its
// controller and `memory` to its stepper.
inline constexpr int kShadowSingle = 9;
inline int shadow_data_size(std::size_t hold, std::size_t memory) {
  return kShadowSingle + static_cast<int>(hold + memory);
}

}  // namespace rotorub::mjcf_names
