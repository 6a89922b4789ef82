// The third error of a comparison, besides contact model and step: the error from the
// bending modes left out, which both sides share. The native model runs with `event` for increasing
// numbers of modes, and the limit of each figure is estimated.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/base/in_parallel.h"
#include "compare/figures/figure.h"
#include "compare/result/result.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// The convergence of a figure, as a pure function of its values.
//
// Let x_0, x_1, ..., x_k be the values for rising numbers of modes n_0 < ... < n_k, relative to the
// first one's reference (deviation(): points for shares of time), and d_i = x_i - x_{i-1}. The
// effect of the modes left out decreases as 1/n (the mobility of a beam's station that carries a
// mass), so the change to be expected beyond the last rung is
//   left = d_k n_{k-1} / (n_k - n_{k-1}).
// With e the larger of the tolerance and the twins' spread:
//   converged       the last two changes are within e, each and together, so that chance and
//                   tolerance explain them
//   trend           otherwise, if the changes shrink, and `left` is less than half the value
//   no limit seen   otherwise
enum class Convergence { kConverged, kTrend, kNoLimit };
const char* to_string(Convergence convergence);  // "converged", "trend", "no limit seen"

struct FigureLimit {
  const Figure* figure = nullptr;
  std::vector<double> values;  // SI, one per rung
  Convergence convergence = Convergence::kNoLimit;
  double last_change = 0.0;  // d_k, a share
  // Shares; empty if no limit is seen. left: 0 except for a trend.
  std::optional<double> left;
  // Error of the first rung, which is the scene: x_0 - (x_k + left).
  std::optional<double> error;
};

// modes: ascending. values: one per number of modes, at least kFewestRungs. spread: of twins, a
// share >= 0.
inline constexpr std::size_t kFewestRungs = 4;
FigureLimit figure_limit(const Figure& figure, const std::vector<int>& modes,
                         const std::vector<double>& values, double tolerance, double spread);

// n and three larger numbers, spaced by a third of n (at least 2), up to twice n. The cost of a run
// grows with about the cube of its modes, so a ladder costs some 20 runs of the scene.
std::vector<int> mode_ladder(int modes);

struct ModelErrorParameters {
  double tolerance = 0.01;     // share, for the judged figures
  std::vector<double> spread;  // of twins, in the order of figures(); empty: 0
  double step = 0.0;           // s, over which forces are averaged; 0: the scene's
  Jobs jobs = 0;
  std::function<void(double)> progress;  // fraction done; may be empty
  const std::atomic<bool>* interrupt = nullptr;
};

struct ModelError {
  std::vector<int> modes;            // per rung, ascending, beginning with the scene's
  std::vector<FigureLimit> figures;  // the judged ones; empty if there is a reason
  std::string reason;                // why nothing is known; empty otherwise
};

// The rungs run on several processors; the result does not depend on their number.
ModelError model_error(const scene::Scene& scene, const ModelErrorParameters& parameters);

// One line per figure for the terminal, and in JSON at "model_error": {"modes": [...], "<figure>":
// share or null, ..., "figures": {"<figure>": {"values", "convergence", "last_change", "left",
// "error"}}, "reason" if nothing is known}.
result::Section model_error_section(const ModelError& error);

}  // namespace rotorub
