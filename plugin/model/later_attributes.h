// Attributes that MuJoCo's releases after 2.2 added to the elements that the plugin takes over. The
// plugin refuses an attribute by name if it does not take it into account, because it would
// otherwise be ignored silently. The list was made from the headers of 2.2.2, 2.3.7, 3.1.6, 3.3.7,
// 3.8.1 and 3.12; "from" is the release that MuJoCo's change log names:
//
//   element                         attribute             from    what the plugin does
//   <pair>                          solreffriction        2.3.6   used by MuJoCo's cone alone
//                                   adhesion              3.11    refused, except by `cone`
//   <geom> of rotor and ring        surfacevel            3.11    refused, except by `cone`
//                                   adhesion              3.11    left alone: it acts in contacts
//                                                                 without a <pair> only
//                                   plugin (SDF)          3.0     the type is refused (own_names.h)
//   <user> sensor of the plugin     nsample, delay,       3.5     refused
//                                   interval
//   in the modal chain and the ring of a generated model:
//   <body>                          gravcomp              2.3.1   refused
//   <joint>                         actuatorfrcrange      2.3.7   refused
//                                   stiffness polynomial  3.7     refused
//                                   damping polynomial    3.7     supported (generated_rotor.h)
//   <fixed> tendon                  armature              3.3.1   refused
//                                   actuatorfrcrange      3.3.1   refused
//                                   stiffness polynomial  3.7     refused
//   any actuator on them            armature              3.7     refused
//                                   damping               3.7     supported (generated_rotor.h)
//   the bearing's actuators, if     nsample, delay        3.5     refused
//   the scene has a controller or   actearly              3.0     refused
//   magnets                         group, disabled by    3.0.1   refused, in every pass
//                                   <option>
//
// In a user's own model the last two parts do not apply: MuJoCo handles these attributes itself,
// and their forces, masses and limits reach the contact as all others do.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Checks that the surfaces of a contact neither move nor adhere. Throws ConfigError.
void check_surface(const mjModel* m, const ContactPair& pair);
// Checks that a pair whose friction is corrected to Coulomb's law does not adhere. Its geoms may
// have a surface velocity. Throws ConfigError.
void check_corrected_pair(const mjModel* m, int pair);

// Checks a user sensor that the plugin fills. Throws ConfigError.
void check_sensor_attributes(const mjModel* m, int sensor);

// Checks a generated model. Throws ConfigError.
void check_generated_attributes(const mjModel* m, const Config& config);

// The first refusal by check_surface, check_corrected_pair or check_generated_attributes; null if
// there is none. It is called in every pass, because attributes may be edited in mjModel, and
// models that differ in these attributes alone share a Config. The text is valid until the thread's
// next refusal.
const char* refused_attributes(const Config& config, const mjModel* m);

// True if <option actuatorgroupdisable> disables one of the bearing's actuators in a generated
// model, whose force the plugin computes.
bool bearing_is_disabled(const mjModel* m, const Config& config);

}  // namespace rotorub::plugin
