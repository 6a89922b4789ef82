// What a contact model's figures are off by, by whose fault: contact model, step, bending modes
// kept.
#pragma once

#include <optional>

#include "compare/study/scene_comparison.h"

namespace rotorub {

// The judged figure that a fault puts off most.
struct LargestError {
  const Figure* figure = nullptr;  // null: of none can it be determined
  double share = 0.0;              // of the native value, signed (points: as they are)
  int untold = 0;                  // judged figures of which it cannot be determined
};

struct ThreeErrors {
  LargestError contact;  // what remains as the step goes to 0 (split.h)
  LargestError step;     // what vanishes with it, MuJoCo's less the native one's
  std::optional<LargestError>
      modes;  // of the modes kept (model_error.h), the same on both sides; none: not asked for
};

// `side`: of the comparison's, >= 1.
ThreeErrors three_errors(const SceneComparison& comparison, std::size_t side);

}  // namespace rotorub
