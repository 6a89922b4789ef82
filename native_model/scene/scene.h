// The scene: everything a user can say about a rotor, its auxiliary bearing and a run, as plain
// structs in SI units. A part that the scene leaves out is an empty optional (or vector) and costs
// nothing in either model.
//
// Axes: z along the shaft, right-handed; x, y the bending planes; spin about +z.
// Units: m, kg, s, N, rad. Speeds of rotation and frequencies in rad/s.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "native_model/contact/most_contacts.h"
#include "native_model/scene/auxiliary_bearing.h"
#include "native_model/scene/drive.h"
#include "native_model/scene/loads.h"
#include "native_model/scene/magnetic_bearing.h"
#include "native_model/scene/mujoco.h"
#include "native_model/scene/rotor.h"
#include "native_model/scene/run.h"

namespace rotorub::scene {

class Record;

// The lasting rub that a run starts on (prepare/rub_start.h).
enum class StartingRub { kNone, kSynchronous, kWhip, kRolling };

// Missing lists mean 0. Modal coordinates at t = 0. steady: on the steady free orbit
// (linear/steady_orbit.h); the lists then are added to it, or to the rub.
struct Initial {
  bool steady = false;
  StartingRub rub = StartingRub::kNone;
  std::vector<double> x, y, vx, vy;            // m, m/s
  double spin_angle = 0.0;                     // rad
  std::vector<double> torsion, torsion_speed;  // rad, rad/s
};

// Everything that a scene states.
struct Scene {
  std::string name;  // file name without folder and ending
  std::string text;  // TOML with overrides applied; what the MJCF carries and the hash is of
  Run run;
  Rotor rotor;
  std::optional<Drive> drive;
  std::vector<Force> forces;
  // [magnetic_bearing], or each [[magnetic_bearing]]; at most kMaxMagneticBearings.
  std::vector<MagneticBearing> magnetic_bearings;
  std::optional<SharedControl> magnetic_control;
  // One at least: [contact], [stator], [actuator] and [controller] at the top of a file, which may
  // all be absent, or those of its [[contact]] in their order; at most kMaxContacts.
  std::vector<AuxiliaryBearing> auxiliary = std::vector<AuxiliaryBearing>(1);
  AuxiliaryBearing& first() { return auxiliary.front(); }
  const AuxiliaryBearing& first() const { return auxiliary.front(); }
  // Of a bearing that is not named its number, from 1.
  std::string name_of(std::size_t bearing) const {
    const std::string& own = auxiliary[bearing].name;
    return own.empty() ? std::to_string(bearing + 1) : own;
  }
  // A contact at least is compliant.
  bool gives() const {
    return std::any_of(auxiliary.begin(), auxiliary.end(), [](const AuxiliaryBearing& at) {
      return at.contact && at.contact->compliance;
    });
  }
  // Which one of the file's list the first is: 0 but for with_bearing_alone.
  std::size_t first_index = 0;
  std::optional<Gravity> gravity;
  std::optional<Base> base;
  Initial initial;
  Mujoco mujoco;
  // Of the file that it was read from; absent: it came in a model (MJCF) or was made by hand.
  std::optional<std::string> folder;
  // Where its keys stand in the file (record.h), for what is found wrong later; null: made by hand.
  std::shared_ptr<const Record> record;
  // What its user ought to know although it is accepted, a sentence each: words with a new name.
  std::vector<std::string> notes;
};

// The scene with one of its auxiliary bearings; messages name that one's keys.
Scene with_bearing_alone(const Scene& scene, std::size_t bearing);

}  // namespace rotorub::scene
