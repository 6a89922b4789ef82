// One MuJoCo side of a comparison against the native one, judged.
#pragma once

#include <vector>

#include "compare/study/scene_comparison.h"
#include "compare/study/twins.h"

namespace rotorub {

// Of each figure among the native run and its twins.
struct Repeatability {
  std::vector<double> floor, spread;  // largest |deviation|; greatest less least
  std::vector<double> replay_floor;   // see replay_floor(); 0 but in replay
};
Repeatability repeatability(const Side& native, const Twins& twins);

// That of the twin that parts first; of those that never part the one that comes furthest. `none`:
// without twins.
Divergence first_to_part(const Twins& twins, Divergence none);

// All but the reasons. `threshold`: m, beyond which two runs have parted.
SideDifference side_difference(const Side& native, const Side& other, const Repeatability& twins,
                               const CompareOptions& options, double threshold);

}  // namespace rotorub
