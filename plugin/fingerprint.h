// What an mjModel is recognised by: a model with the same bytes is mapped in the same way. The
// numbers that may change while it runs are not among them (model_parameters.h).
#pragma once

#include <mujoco/mujoco.h>

#include <cstdint>
#include <string>

namespace rotorub::plugin {

// Sizes, custom text and numbers, names, types and addresses, and what decides who solves a pair.
std::string fingerprint(const mjModel* m);
bool has_fingerprint(const mjModel* m, const std::string& kept);

// To find a model among many: of the fingerprint, and of what model_parameters.h reads beside it.
struct ModelHash {
  std::uint64_t kind, numbers;
};
ModelHash model_hash(const mjModel* m);

}  // namespace rotorub::plugin
