// The scene: everything that a user can state about a rotor, its auxiliary bearings and a run, as
// plain structs in SI units. A part that the scene omits is an empty optional (or vector) and costs
// nothing in either model.
//
// Axes: z along the shaft, right-handed; x and y span the bending planes; the spin is about +z.
// Units: m, kg, s, N, rad. Rotational speeds and frequencies in rad/s.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "native_model/contact/contact_list.h"
#include "native_model/scene/auxiliary_bearing.h"
#include "native_model/scene/drive.h"
#include "native_model/scene/loads.h"
#include "native_model/scene/magnetic_bearing.h"
#include "native_model/scene/mujoco.h"
#include "native_model/scene/rotor.h"
#include "native_model/scene/run.h"

namespace rotorub::scene {

class Record;

// The sustained rub on which a run starts (prepare/rub_start.h).
enum class StartingRub { kNone, kSynchronous, kWhip, kRolling };

// Modal coordinates at t = 0; missing lists mean 0. steady: the run starts on the steady free orbit
// (linear/steady_orbit.h). The lists are added to this orbit, or to the rub, but a scene file may
// then give only those of torsion; `torsion` replaces the static twist.
struct Initial {
  bool steady = false;
  StartingRub rub = StartingRub::kNone;
  std::vector<double> x, y, vx, vy;            // m, m/s
  double spin_angle = 0.0;                     // rad
  std::vector<double> torsion, torsion_speed;  // rad, rad/s
};

// All that a scene file says: machine, loads, start and run.
struct Scene {
  std::string name;  // file name without folder and extension
  std::string text;  // TOML with overrides applied; carried by the MJCF and hashed
  Run run;
  Rotor rotor;
  std::optional<Drive> drive;
  std::vector<Force> forces;
  // [magnetic_bearing] or each [[magnetic_bearing]], at most kMaxMagneticBearings.
  std::vector<MagneticBearing> magnetic_bearings;
  std::optional<SharedControl> magnetic_control;
  // At least one: either [contact], [stator], [actuator] and [controller] at the top of a file, all
  // optional, or one for each [[contact]], in order; at most kMaxContacts.
  std::vector<AuxiliaryBearing> auxiliary = std::vector<AuxiliaryBearing>(1);
  AuxiliaryBearing& first() { return auxiliary.front(); }
  const AuxiliaryBearing& first() const { return auxiliary.front(); }
  // With several auxiliary bearings each has a contact.
  bool has_contact() const { return auxiliary.front().contact.has_value(); }
  // The name of a bearing; its number, from 1, if it has none.
  std::string name_of(std::size_t bearing) const {
    const std::string& own = auxiliary[bearing].name;
    return own.empty() ? std::to_string(bearing + 1) : own;
  }
  // True if at least one contact is compliant.
  bool is_compliant() const {
    return std::any_of(auxiliary.begin(), auxiliary.end(), [](const AuxiliaryBearing& at) {
      return at.contact && at.contact->compliance;
    });
  }
  // Index of the first bearing in the file's list; not 0 only after with_bearing_alone.
  std::size_t first_index = 0;
  std::optional<Gravity> gravity;
  std::optional<Base> base;
  Initial initial;
  Mujoco mujoco;
  // Folder of the scene's file. Absent if the scene came in a model (MJCF) or was made by hand.
  std::optional<std::string> folder;
  // Positions of the keys in the file (record.h), for faults found later. Null if made by hand.
  std::shared_ptr<const Record> record;
  // Remarks for the user about accepted input, such as renamed words; one sentence each.
  std::vector<std::string> notes;
};

// The scene with only one of its auxiliary bearings. Messages still name that bearing's keys.
Scene with_bearing_alone(const Scene& scene, std::size_t bearing);

// m, the smallest clearance of the scene's contacts; empty without a contact. It is the length for
// figures that cover every contact, so that they do not depend on the order of the list.
std::optional<double> smallest_clearance(const Scene& scene);

}  // namespace rotorub::scene
