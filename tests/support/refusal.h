// What a scene is refused with.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub::test {

// The diagnostics that `action` throws; none: it accepts.
template <class Action>
std::vector<scene::Diagnostic> refusals(Action action) {
  try {
    action();
  } catch (const scene::SceneError& error) {
    return error.diagnostics();
  }
  return {};
}

// The only refusal of `prepare`. Its reason is empty where the scene is accepted.
inline scene::Diagnostic refusal(const scene::Scene& scene) {
  const std::vector<scene::Diagnostic> all = refusals([&] { prepare(scene); });
  EXPECT_LE(all.size(), 1u);
  return all.empty() ? scene::Diagnostic{} : all.front();
}

}  // namespace rotorub::test
