// One MuJoCo side of a comparison against the native one, judged.
#pragma once

#include <vector>

#include "compare/study/scene_comparison.h"
#include "compare/study/twins.h"

namespace rotorub {

// Of each figure among a run and its twins.
struct Repeatability {
  std::vector<FigureSample> samples;  // as figures()
  std::vector<double> floor;          // largest |deviation| of a twin
  std::vector<double> replay_floor;   // see replay_floor(); 0 but in replay
};
Repeatability repeatability(const Metrics& run, const Twins& twins);

// That of the twin that parts first; of those that never part the one that comes furthest. `none`:
// without twins.
Divergence first_to_part(const Twins& twins, Divergence none);

// All but the reasons. `threshold`: m, beyond which two runs have parted.
SideDifference side_difference(const Side& native, const Side& other, const Repeatability& natives,
                               const Repeatability& others, const CompareOptions& options,
                               double threshold);

}  // namespace rotorub
