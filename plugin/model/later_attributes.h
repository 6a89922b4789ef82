// Attributes that MuJoCo's releases after 2.2 have added to the elements that the plugin takes
// over. An attribute that the plugin does not take into account is refused by name, because it
// would otherwise be ignored without a word. The list was made from the headers of 2.2.2, 2.3.7,
// 3.1.6, 3.3.7, 3.8.1 and 3.12; "from" is the release that MuJoCo's change log names:
//
//   element                         attribute             from    what the plugin does
//   <pair>                          solreffriction        2.3.6   used by MuJoCo's cone alone
//                                   adhesion              3.11    refused, except by `cone`
//   <geom> of rotor and ring        surfacevel            3.11    refused, except by `cone`
//                                   adhesion              3.11    left alone: it acts in contacts
//                                                                 without a <pair> only
//                                   plugin (SDF)          3.0     the type is refused (own_names.h)
//   <user> sensor of ours           nsample, delay,       3.5     refused
//                                   interval
//   of the modal chain and the ring of a generated model:
//   <body>                          gravcomp              2.3.1   refused
//   <joint>                         actuatorfrcrange      2.3.7   refused
//                                   stiffness polynomial  3.7     refused
//                                   damping polynomial    3.7     taken (generated_rotor.h)
//   <fixed> tendon                  armature              3.3.1   refused
//                                   actuatorfrcrange      3.3.1   refused
//                                   stiffness polynomial  3.7     refused
//   any actuator on them            armature              3.7     refused
//                                   damping               3.7     taken (generated_rotor.h)
//   the bearing's actuators, where  nsample, delay        3.5     refused
//   the scene has a controller or   actearly              3.0     refused
//   magnets                         group, disabled by    3.0.1   refused, in every pass
//                                   <option>
//
// In a model of the user's own the last two parts are MuJoCo's own affair: its forces, masses and
// limits reach the contact as all others do.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Of one contact: the refusal of a surface that moves or adheres; empty where there is none.
std::string refused_surface(const mjModel* m, const ContactPair& pair);

// Of a user sensor that the plugin fills. Throws ConfigError.
void check_sensor_attributes(const mjModel* m, int sensor);

// Of a generated model. Throws ConfigError.
void check_generated_attributes(const mjModel* m, const Config& config);

// The first refusal of either; null where there is none. Asked for in every pass, because
// attributes may be edited in mjModel, and a model that differs from another in them alone has its
// Config. It stays until the thread's next refusal.
const char* refused_attributes(const Config& config, const mjModel* m);

// Whether <option actuatorgroupdisable> switches off one of the bearing's actuators of a generated
// model, whose force the plugin computes.
bool bearing_is_disabled(const mjModel* m, const Config& config);

}  // namespace rotorub::plugin
