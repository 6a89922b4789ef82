// The table [optimise] of a study, which defines the goal of an optimisation.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/optimise/figure_path.h"
#include "compare/sweep/study_file.h"

namespace rotorub::optimise {

// NLopt's COBYLA, BOBYQA, Nelder-Mead and Sbplx. kDirect: DIRECT-L over the whole range with half
// of the evaluations, then COBYLA from its best point. All are deterministic.
enum class Algorithm { kCobyla, kBobyqa, kNelderMead, kSubplex, kDirect };

// The figure must stay <= limit if is_max, otherwise >= limit.
struct Constraint {
  FigurePath figure;
  double limit = 0.0;  // SI
  bool is_max = true;
};

struct Goal {
  FigurePath figure;
  bool maximise = false;
  std::vector<Constraint> constraints;
  Algorithm algorithm = Algorithm::kCobyla;
  int evaluations = 200;    // upper limit, >= 1
  double tolerance = 1e-4;  // stops when the keys change by less, relative to their ranges; > 0

  // Whether the goal or a constraint uses a figure of this source.
  bool needs(Source source) const;
};

// A study and its goal. Keys vary between `from` and `to` and begin at `start`, by default midway.
struct Task {
  sweep::Study study;
  Goal goal;
};

// Throws scene::SceneError with all errors.
Task read_task(const std::filesystem::path& file);

}  // namespace rotorub::optimise
