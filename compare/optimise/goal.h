// The table [optimise] of a study, which defines the goal of an optimisation.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/sweep/study_file.h"

namespace rotorub::optimise {

// A figure that an optimisation uses: a number of the scene's run or of its modes.
enum class Source { kRun, kModes };

// Paths such as "peak_force" and "settled.spin_speed" name a figure of the run or a key of its
// summary. Paths such as "modes.speeds.0.response.orbit" lead into the output of `rotorub modes
// --json`. A `*` stands for every element of a list; of several numbers the worst one counts.
struct FigurePath {
  std::string text;
  Source source = Source::kRun;
  std::vector<std::string> parts;  // after "modes."
};

// Throws std::invalid_argument with the accepted forms.
FigurePath parse_figure(const std::string& text);

// The smallest or largest of the numbers at the path; empty if there is none or if one is null.
std::optional<double> figure_value(const FigurePath& path, const nlohmann::json& all, bool largest);

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
