// What a study asks to be optimised: its table [optimise].
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/optimise/figure_path.h"
#include "compare/sweep/study_file.h"

namespace rotorub::optimise {

// NLopt's COBYLA, BOBYQA, Nelder-Mead and Sbplx; kDirect: DIRECT-L over the whole range with half
// of the evaluations, then COBYLA from the best that it found. None of them draws numbers.
enum class Algorithm { kCobyla, kBobyqa, kNelderMead, kSubplex, kDirect };

// The figure stays at or above `min`, and at or below `max`; one of the two.
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
  int evaluations = 200;    // at most, >= 1
  double tolerance = 1e-4;  // the end: the keys move by less, as shares of their ranges; > 0

  // Whether any of its figures is of the source.
  bool needs(Source source) const;
};

// A study and its goal. Keys vary between `from` and `to`, begin at `start`, or midway.
struct Task {
  sweep::Study study;
  Goal goal;
};

// Throws scene::SceneError with everything that is wrong.
Task read_task(const std::filesystem::path& file);

}  // namespace rotorub::optimise
