// The errors with which a scene is refused.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub::test {

// The diagnostics that `action` throws; empty if it throws none.
template <class Action>
std::vector<scene::Diagnostic> refusals(Action action) {
  try {
    action();
  } catch (const scene::SceneError& error) {
    return error.diagnostics();
  }
  return {};
}

// The only error of `prepare`, with an empty reason if the scene is accepted.
inline scene::Diagnostic refusal(const scene::Scene& scene) {
  const std::vector<scene::Diagnostic> all = refusals([&] { prepare(scene); });
  EXPECT_LE(all.size(), 1u);
  return all.empty() ? scene::Diagnostic{} : all.front();
}

}  // namespace rotorub::test
