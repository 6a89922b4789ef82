// MuJoCo's contact models as comparisons show them.
#pragma once

#include <algorithm>
#include <string_view>

namespace rotorub {

// MuJoCo's cone with its default solref, whatever the scene sets.
inline constexpr const char* kConeDefault = "cone-default";

struct ContactKind {
  const char* label;            // of its run; the scene's word, but for kConeDefault
  const char* heading;          // of its column on the terminal; empty: it has none
  const char* question;         // a description for newcomers
  bool default_solref = false;  // it is then no part of the sentence that answers the question
};

// In the order for newcomers: MuJoCo alone, MuJoCo corrected, the plugin's laws. This order keeps
// readers from taking the plugin's result for plain MuJoCo's.
inline constexpr ContactKind kContactKinds[] = {
    {"cone", "cone", "MuJoCo alone"},
    {kConeDefault, "", "MuJoCo alone, default solref", true},
    {"cone-coulomb", "cone-c", "with the corrected cone"},
    {"coulomb", "coulomb", "MuJoCo's normal force, Coulomb friction"},
    {"rigid", "rigid", "with the rigid law"}};

// The kind of a run's label; null for native runs.
constexpr const ContactKind* contact_kind(std::string_view label) {
  const auto* found = std::ranges::find(kContactKinds, label, &ContactKind::label);
  return found == std::end(kContactKinds) ? nullptr : found;
}

}  // namespace rotorub
