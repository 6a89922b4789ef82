// What the plugin knows of one mjModel: the native model of the scene in its custom text, and where
// the scene's parts are in MuJoCo's arrays. Constant, shared between threads.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/mujoco.h"
#include "plugin/model/segments.h"

namespace rotorub::plugin {

// A sensor in units of a force that its own `user` data names, N. -1: no such sensor.
struct ScaledSensor {
  int address = -1;    // in mjData.sensordata
  int reference = -1;  // in mjModel.sensor_user
};

// Of one contact, in mjData.sensordata; -1: the model has no such sensor.
struct SensorAddresses {
  int active = -1, gap = -1, gap_rate = -1, slip = -1;
  int normal_force = -1, friction_force = -1;
  int gap_scaled = -1;  // of the clearance
  ScaledSensor normal_force_scaled, friction_force_scaled;
  // Asked for at another stage than that which MuJoCo has them at: filled in mjcb_control.
  bool gap_in_control = false, rates_in_control = false;
};

inline bool are_geoms(int a, int b, int geom1, int geom2) {  // in either order
  return (a == geom1 && b == geom2) || (a == geom2 && b == geom1);
}

// A rotor in its ring: of a generated model, or one of a user's own.
struct ContactPair {
  scene::ContactModel law = scene::ContactModel::kRigid;
  ContactParameters contact{};
  int rotor_geom = -1, ring_geom = -1;
  int pair = -1;  // their <pair>
  int data = 0;   // in mjData.userdata (user_data.h)
  SensorAddresses sensors;
  double friction_reference = 0.0;  // 1/s, B_t of contact model cone; 0: MuJoCo's

  // Of a generated model. Contacts of the modal chain are solved in its own coordinates unless a
  // user's constraints hold its bodies as well (generated_rotor.h).
  bool on_chain = false;  // a ChainSpace (contact/contact_space.h); else a BodySpace
  // Beyond the first on the chain: the modes move the rotor there by other values than 1 and 0, as
  // no body of MuJoCo's does. All of its force is the plugin's, which also places its geoms.
  bool beside = false;
  std::size_t bearing = 0;  // in model.auxiliary
  bool in_world = false;    // the contact plane is the world's x and y, not that of the ring's geom
  double held_spin = 0.0;   // rad/s, of a rotor whose spin is no degree of freedom
  ContactParameters given;  // by the scene, whose geoms draw it: "rotor" and "ring",
  int rotor_shape = -1, ring_shape = -1;  // -1 where they are taken out

  // Of a user's own model.
  double reach = 1e300;          // m: apart along the axis, they do not meet
  bool axial = false;            // with friction, and one moves along the other's axis
                                 // (contact/relative_motion.h)
  std::array<mjtNum, 8> read{};  // sizes of the two geoms, m, and the pair's frictions
};

// The native model that runs alongside (shadow.h). -1: no such sensor or ghost.
struct ShadowConfig {
  // With a controller of its own the whole scene; without one the actuator is ideal, as the force
  // on the ring is MuJoCo's.
  Model model;
  double mark = 0.0;  // of the model's numbers, > 0: another after an edit of mjModel
  int data = -1;      // in mjData.userdata
  int gap = -1, normal_force = -1, friction_force = -1;  // in mjData.sensordata
  int rotor = -1, stator = -1;                           // x and y
  int mujoco_rotor = -1;                                 // MuJoCo's own, x and y
  int ghost_rotor = -1, ghost_ring = -1;                 // in mjData.mocap_pos
};

struct Config {
  Model model;
  scene::ContactModel contact = scene::ContactModel::kRigid;

  // Coordinate i of the native layout is qpos[qpos_address[i]], qvel[dof_address[i]]. With a
  // segment rotor only those of the ring are; the others are -1.
  std::vector<int> qpos_address, dof_address;
  bool same_order = false;  // both are 0, 1, 2, ...

  std::optional<Segments> segments;  // the segment rotor

  // A user's own model with our contacts (own/own_config.h): filled are `pairs`, `memory`, and with
  // the first pair `contact` and model.first().contact.
  bool own = false;
  // The contacts of either, those of a generated model in the order of model.auxiliary.
  std::vector<ContactPair> pairs;
  // Further <pair>s of a user's own model, of any geoms, that are corrected for sliding
  // (contact/cone.h).
  std::vector<int> corrected_pairs;
  int memory = 0, memory_size = 0;  // in mjData.userdata, of all that the plugin remembers

  bool damping_added = false;  // to a modal chain, by a user (generated_rotor.h)

  // MuJoCo's own sensors that feel the contact (load_cells.h), and whether mjcb_sensor is called
  // after them.
  bool cells = false, cells_in_callback = false;

  // In mjData.userdata: what Model::loop remembers, after the pass done last (with native steps in
  // the slot that the step to come begins with).
  int loop_data = 0;
  int verlet_data = -1;        // in mjData.userdata, of `rigid` on the modal chain; -1: none
  int actuator[2] = {-1, -1};  // -1 without actuators
  // Sensors of a generated model as a whole.
  int active = -1, control_force = -1, current = -1;
  std::optional<ShadowConfig> shadow;

  bool has_contact() const { return !pairs.empty(); }
  // Any contact with a law of this kind.
  bool has_rigid() const;
  bool has_soft() const;

  // `rigid` on the modal chain: the native step is MuJoCo's (contact/verlet.h).
  bool takes_native_steps() const {
    return verlet_data >= 0 && contact == scene::ContactModel::kRigid;
  }

  // Of the scene's numbers in mjModel (model_parameters.h).
  double scene_current_limit = 0.0;   // A, of magnets
  Eigen::Vector2d gravity{0.0, 0.0};  // m/s^2
  std::vector<int> rotor_bodies;      // of the modal chain, that carry no mass

  // What the above was made from, to recognise the model.
  std::string fingerprint;
  double id = 0.0;  // unique in the process, > 0
};

// Custom text or a named element that does not fit. what() names it.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The text of <custom><text name="rotorub_scene">, or null: not our model.
const char* scene_text(const mjModel* m);
const char* custom_text(const mjModel* m, std::string_view name);  // null: none of that name
int find_pair(const mjModel* m, int geom_a, int geom_b);           // -1: none

}  // namespace rotorub::plugin
