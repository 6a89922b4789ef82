// The plugin's data about one mjModel: the native model of the scene in its custom text, and the
// addresses of the scene's parts in MuJoCo's arrays. A Config is constant and shared between
// threads.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/mujoco.h"
#include "plugin/model/segments.h"

namespace rotorub::plugin {

// A sensor that shows a force in units of a reference force, N, which the sensor's `user` data
// name. -1: there is no such sensor.
struct ScaledSensor {
  int address = -1;    // in mjData.sensordata
  int reference = -1;  // in mjModel.sensor_user
};

// Addresses of the sensors of one contact in mjData.sensordata; -1: the model has no such sensor.
struct SensorAddresses {
  int active = -1, gap = -1, gap_rate = -1, slip = -1;
  int normal_force = -1, friction_force = -1;
  int gap_scaled = -1;  // gap divided by the clearance
  ScaledSensor normal_force_scaled, friction_force_scaled;
  // True if the model asks for the sensors at another stage than the one in which MuJoCo knows
  // them. They are then filled in mjcb_control.
  bool gap_in_control = false, rates_in_control = false;
};

inline bool are_geoms(int a, int b, int geom1, int geom2) {  // in either order
  return (a == geom1 && b == geom2) || (a == geom2 && b == geom1);
}

// The contact of a rotor in its ring, in a generated model or in a user's own.
struct ContactPair {
  scene::ContactModel contact_model = scene::ContactModel::kRigid;
  ContactParameters contact{};  // geometry and laws
  int rotor_geom = -1, ring_geom = -1;
  int pair = -1;     // index of their <pair>; -1: none
  int userdata = 0;  // index of its entries in mjData.userdata (user_data.h)
  SensorAddresses sensors;
  double friction_reference = 0.0;  // 1/s, B_t of contact model cone; 0: MuJoCo's own reference

  // For generated models only. Contacts of the modal chain are solved in its own coordinates,
  // unless a user's constraints also act on its bodies (generated_rotor.h).
  bool on_chain = false;  // true: ChainSpace (contact/contact_space.h); false: BodySpace
  // True for the further contacts on the chain, those beyond the first. There the modes move the
  // rotor by values other than 1 and 0, which no body of MuJoCo does. The plugin therefore applies
  // the whole force of such a contact, keeps it from MuJoCo's solver, and also places its geoms.
  bool further = false;
  std::size_t bearing = 0;  // index in model.auxiliary
  // True if the contact plane is the world's x-y plane instead of the plane of the ring's geom.
  bool in_world = false;
  double prescribed_spin = 0.0;  // rad/s, spin speed if the spin is not a degree of freedom; else 0
  // The parameters in the scene, and the geoms "rotor" and "ring" that draw them; -1 if a geom was
  // removed.
  ContactParameters given;
  int rotor_shape = -1, ring_shape = -1;

  // For a user's own model only.
  double reach = 1e300;  // m; if they are further apart along the axis, they do not touch
  // True if the contact has friction and one body moves along the other's axis
  // (contact/relative_motion.h).
  bool axial = false;
  // Sizes of the two geoms, m, friction[0..1] of the pair and friction[0] of the geoms.
  std::array<mjtNum, 10> read{};
};

// The native model that runs alongside (shadow.h). -1: there is no such sensor or ghost body.
struct ShadowConfig {
  // With its own controller this is the model of the whole scene. Without one its actuator is
  // ideal, because the force on the ring comes from MuJoCo.
  Model model;
  double mark = 0.0;  // hash of the model's numbers, > 0; it changes when mjModel is edited
  int userdata = -1;  // index of its entries in mjData.userdata
  int gap = -1, normal_force = -1, friction_force = -1;  // in mjData.sensordata
  int rotor = -1, stator = -1;                           // x and y, also in mjData.sensordata
  int mujoco_rotor = -1;                                 // of MuJoCo's own rotor, x and y
  int ghost_rotor = -1, ghost_ring = -1;                 // addresses in mjData.mocap_pos
};

// Warnings about the model (own/load_warnings.h), shared by its configs.
struct LoadWarnings {
  std::vector<std::string> texts;
  std::atomic<bool> told{false};
};

struct Config {
  Model model;

  // Coordinate i of the native layout is qpos[qpos_address[i]], qvel[dof_address[i]]. With a
  // segment rotor only the coordinates from the ring on have addresses; the others are -1.
  std::vector<int> qpos_address, dof_address;
  bool same_order = false;  // true if both are 0, 1, 2, ...

  std::optional<Segments> segments;  // only with a segment rotor

  // True for a user's own model with the plugin's contacts (own/own_config.h). Then `pairs`,
  // `corrected_pairs`, `memory` and `memory_size` are filled.
  bool own = false;
  // The contacts. In a generated model they have the order of model.auxiliary.
  std::vector<ContactPair> pairs;
  // Further <pair>s of a user's own model, between any geoms, that are corrected for sliding
  // (contact/cone.h).
  std::vector<int> corrected_pairs;
  // First entry of the plugin's block in mjData.userdata, and its size (only for own models).
  int memory = 0, memory_size = 0;

  bool damping_added = false;  // true if a user added damping to a modal chain (generated_rotor.h)

  // True if some of MuJoCo's own sensors measure the contact's force (load_cells.h), and if
  // mjcb_sensor is called after them.
  bool cells = false, cells_in_callback = false;

  // Index in mjData.userdata of the memory of the sampled controller (AuxiliaryBearing::loop) after
  // the last pass. With native steps it is in the slot with which the next step begins.
  int loop_data = 0;
  int verlet_data = -1;        // index of VerletEntries (`rigid` on the modal chain); -1: none
  int actuator[2] = {-1, -1};  // -1: the model has none
  // Addresses of the sensors of a generated model as a whole.
  int active = -1, control_force = -1, current = -1;
  std::optional<ShadowConfig> shadow;
  std::shared_ptr<LoadWarnings> warnings;  // null: none

  bool has_contact() const { return !pairs.empty(); }
  // The contact model of the first contact, and so of all contacts in a generated model; `rigid` if
  // there is none.
  scene::ContactModel contact_model() const {
    return pairs.empty() ? scene::ContactModel::kRigid : pairs.front().contact_model;
  }
  // True if any contact has a law of this kind.
  bool has_rigid() const;
  bool has_soft() const;

  // True for `rigid` on the modal chain, where the native step replaces MuJoCo's
  // (contact/verlet.h).
  bool takes_native_steps() const {
    return verlet_data >= 0 && contact_model() == scene::ContactModel::kRigid;
  }

  // Values for comparison with the numbers in mjModel (model_parameters.h).
  double scene_current_limit = 0.0;   // A, of magnets, as the scene has it
  Eigen::Vector2d gravity{0.0, 0.0};  // m/s^2, x and y
  std::vector<int> rotor_bodies;      // bodies of the modal chain; they carry no mass

  // The data from which this Config was made, to recognise the model.
  std::string fingerprint;
  double id = 0.0;  // unique in the process, > 0
};

// Custom text or a named element does not fit. what() names it.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The text of <custom><text name="rotorub_scene">; null if the model has no scene.
const char* scene_text(const mjModel* m);
const char* custom_text(const mjModel* m, std::string_view name);  // null: not found
int find_pair(const mjModel* m, int geom_a, int geom_b);           // -1: not found
int count_pairs(const mjModel* m, int geom_a, int geom_b);

}  // namespace rotorub::plugin
