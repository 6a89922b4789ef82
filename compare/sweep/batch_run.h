// Some points of a study at once: those that can go into ensembles do, the others run by
// themselves.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "compare/sweep/point_result.h"
#include "compare/sweep/study_file.h"

namespace rotorub::sweep {

using SceneOfPoint =
    std::function<scene::Scene(std::int64_t point)>;  // thread safe; throws scene::SceneError

class BatchRun {
 public:
  BatchRun(const Study& study, SceneOfPoint scene_at, const std::atomic<bool>& interrupt);

  // Thread safe. Results in no order; after an interrupt some are missing.
  std::vector<PointResult> run(const std::vector<std::int64_t>& points) const;

 private:
  const Study& study_;
  SceneOfPoint scene_at_;
  const std::atomic<bool>& interrupt_;
};

// Points that are run together: enough to fill ensembles, or one.
std::int64_t batch_size(const Study& study);

// All points of a native study from 0 to count - 1, on all processors, in their order; `interrupt`:
// those that are missing then have no status.
std::vector<PointResult> run_points(const Study& study, std::int64_t count,
                                    const SceneOfPoint& scene_at,
                                    const std::atomic<bool>& interrupt);

}  // namespace rotorub::sweep
