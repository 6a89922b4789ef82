// Finds the Config of a model in the callbacks, from any thread, without a lock once it is known.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Null for a model without our text. Compares the model's address and the mark that `d` carries, so
// an address that a new model inherits is distinguished by its new, unmarked mjData. Valid until
// this thread asks again. On bad text or elements: mju_error.
const Config* find_config(const mjModel* m, const mjData* d);

// The same, comparing the model's whole text and names as well: called once a step, so that a
// model that was changed in place is noticed.
const Config* find_config_checked(const mjModel* m, const mjData* d);

// What an mjModel is recognised by: a model with the same bytes is mapped in the same way. Sizes,
// custom text and numbers, names, types and addresses, and what decides who solves a pair.
std::string fingerprint(const mjModel* m);
bool has_fingerprint(const mjModel* m, const std::string& kept);

}  // namespace rotorub::plugin
