// Runs side by side in the lanes of a vector register.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "native_model/stepping/ensemble.h"

namespace rotorub::test {

// Each has the bits of its run alone, and they are different runs.
inline void expect_lanes_are_runs(const std::vector<Model>& models, double step, int steps) {
  const std::vector<EnsembleRun> runs = Ensemble(models, step).run(steps);
  for (std::size_t k = 0; k < models.size(); ++k) {
    const EnsembleRun alone = Ensemble({models[k]}, step).run(steps).front();
    ASSERT_EQ(runs[k].status, Status::kOk) << k;
    EXPECT_EQ(runs[k].q, alone.q) << k;
    EXPECT_EQ(runs[k].v, alone.v) << k;
  }
  EXPECT_NE(runs[0].q, runs[1].q);
}

}  // namespace rotorub::test
