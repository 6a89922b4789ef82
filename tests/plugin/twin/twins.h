// Twins of documents, and what is said where there is none.
#pragma once

#include <string>

#include "plugin/twin/native_twin.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {

inline plugin::NativeTwin twin_of(const mjModel* m) {
  const DataPointer d = start(m);
  return plugin::make_native_twin(m, plugin::make_config(m), d.get());
}
inline plugin::NativeTwin twin_of(const std::string& document) {
  return twin_of(load(document).get());
}

// Empty: there is one.
inline std::string twin_refusal(const std::string& document) {
  try {
    twin_of(document);
  } catch (const plugin::ConfigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace rotorub::test
