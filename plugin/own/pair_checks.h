// Checks of the <pair> of a contact: MuJoCo's solver must do its share of the contact law and no
// more. It must not solve the contact of `rigid`, nor add friction to `coulomb`.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "plugin/model/config.h"
#include "plugin/model/message.h"
#include "plugin/own/own_names.h"

namespace rotorub::plugin {

// Returns "<contact><pair geom1=... geom2=...>".
std::string pair_element(const mjModel* m, const ContactPair& pair);

// Adds a refusal if the pair's gap or condim lets MuJoCo's solver do more or less than its share.
void check_solved_part(const mjModel* m, const ContactPair& pair, Refusals& refusals);

// Adds all that is wrong with the pair of a contact of a user's own model to the refusals. If the
// <pair> is missing, the message contains the line to add.
void check_pair(const mjModel* m, const PairName& name, const ContactPair& p, Refusals& refusals);

}  // namespace rotorub::plugin
