// The names in <custom> of a user's own model, and the contact that each belongs to.
//
//   rotorub_rotor_geom       the first contact
//   rotorub_rotor_geom_2     a further contact, with "_2" in all its names; any ending is allowed
//   left_rotorub_rotor_geom  a contact of a model that was attached with the prefix "left_"
//                            (mjSpec, dm_control)
//
// The user sensors are named alike: gap, gap_2, left_gap. The keys of instances of an engine plugin
// (instances.h) count as given under these names.
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

// True if a name in <custom> contains rotorub_, or there is an instance.
bool has_own_names(const mjModel* m);

// The contacts whose geoms are named or that have an instance, in the order of the file. Names that
// belong to none of them are errors: the first function throws ConfigError, the second adds them to
// the refusals.
std::vector<PairName> own_pair_names(const mjModel* m);
std::vector<PairName> own_pair_names(const mjModel* m, Refusals& refusals);

// For a model with a scene's text: throws ConfigError for names that are not allowed beside it.
void refuse_own_names(const mjModel* m);

// The <pair>s that are to be corrected for sliding, in the order of the file. Throws ConfigError.
std::vector<int> corrected_pairs(const mjModel* m);

// The text or the numbers given under a name; null or empty if there are none. Throws ConfigError
// if an instance has something other than numbers.
const char* own_text(const mjModel* m, const std::string& name);
struct OwnNumber {
  std::array<mjtNum, 4> values{};
  int size = 0;  // how many were given, even if they do not all fit
};
std::optional<OwnNumber> own_number(const mjModel* m, const std::string& name);
// The same for a name with one number. Also throws ConfigError if several are given.
std::optional<double> own_value(const mjModel* m, const std::string& name);

// The element in which a name is or would be given: <custom><numeric name="rotorub_clearance">.
std::string own_element(const mjModel* m, const std::string& name);

// The contact model in the text of that name; `otherwise` if there is none. Throws ConfigError.
scene::ContactModel contact_model(const mjModel* m, const std::string& text_name,
                                  scene::ContactModel otherwise);

// The geom that the text names: by its name with the prefix and suffix of the contact, or by its
// name as written. Throws ConfigError.
int own_geom(const mjModel* m, const PairName& pair, const char* text);

// The index in mjData.userdata at which the plugin's block begins: rotorub_userdata, one value in
// the whole model; 0 if it is not given. Throws ConfigError.
int own_memory(const mjModel* m);

}  // namespace rotorub::plugin
