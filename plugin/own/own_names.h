// The names in <custom> of a user's own model, and which contact each is of.
//
//   rotorub_rotor_geom      the first contact
//   rotorub_rotor_geom_2    a further one, "_2" in all its names; any ending will do
//   left_rotorub_rotor_geom one of a model that was attached with the prefix "left_" (mjSpec,
//                           dm_control)
// MuJoCo's sensors are named alike: gap, gap_2, left_gap. What instances of an engine plugin say
// (instances.h) counts as said under these names.
#pragma once

#include <mujoco/mujoco.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "native_model/scene/mujoco.h"
#include "plugin/model/message.h"

namespace rotorub::plugin {

inline constexpr std::array kOwnTexts{mjcf_names::kContactText, mjcf_names::kOwnRotorGeom,
                                      mjcf_names::kOwnRingGeom};
inline constexpr std::array kOwnNumbers{
    mjcf_names::kOwnClearance,   mjcf_names::kOwnRadius,     mjcf_names::kOwnFriction,
    mjcf_names::kOwnRestitution, mjcf_names::kOwnTangential, mjcf_names::kOwnFrictionReference,
    mjcf_names::kOwnWidth,       mjcf_names::kOwnUserData};

struct PairName {
  std::string prefix, suffix;
  std::string of(const std::string& name) const { return prefix + name + suffix; }
  bool operator==(const PairName&) const = default;
};

// A name in <custom> has the mark rotorub_ in it, or there is an instance.
bool has_own_names(const mjModel* m);

// The contacts whose geoms are named, in the order of the file. Throws ConfigError for names that
// are of none of them, or adds them to the refusals.
std::vector<PairName> own_pair_names(const mjModel* m);
std::vector<PairName> own_pair_names(const mjModel* m, Refusals& refusals);

// Of a model with a scene's text: those that it may not have beside it. Throws ConfigError.
void refuse_own_names(const mjModel* m);

// The <pair>s that are named to be corrected for sliding, in the order of the file. Throws
// ConfigError.
std::vector<int> corrected_pairs(const mjModel* m);

// What is said under a name: null and empty where nothing is. Throws ConfigError where an instance
// says no numbers.
const char* own_text(const mjModel* m, const std::string& name);
struct OwnNumber {
  std::array<mjtNum, 4> values{};
  int size = 0;  // how many were given, even if more than there is room for
};
std::optional<OwnNumber> own_number(const mjModel* m, const std::string& name);
// Throws ConfigError where several numbers were given for one.
void check_one_value(const mjModel* m, const std::string& name, const OwnNumber& number);

// Where that is said, or would be: <custom><numeric name="rotorub_clearance">.
std::string own_element(const mjModel* m, const std::string& name);

// The contact model that the text of that name says. Throws ConfigError.
scene::ContactModel contact_model(const mjModel* m, const std::string& text_name,
                                  scene::ContactModel otherwise);

// The geom that the text says: by the name that it got when it was attached, or as it stands.
// Throws ConfigError.
int own_geom(const mjModel* m, const PairName& pair, const char* text);

// Where our block in mjData.userdata begins: rotorub_userdata, one value in the whole model; else
// 0. Throws ConfigError.
int own_memory(const mjModel* m);

}  // namespace rotorub::plugin
