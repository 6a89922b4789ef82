// The third error of a comparison, beside those of contact model and step: that of the bending
// modes kept, which both sides share. The native model runs with `event` over a rising ladder of
// modes, and each figure tends to something.
#pragma once

#include <atomic>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/base/in_parallel.h"
#include "compare/figures/figure.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// What a figure tends to: a pure function of its values.
//
// Values x_0, x_1, ..., x_k over rising counts n_0 < ... < n_k, as shares of the first one's
// reference (deviation(): points for shares of time), d_i = x_i - x_{i-1}. The modes left out by n
// go as 1/n (the mobility of a beam's station that carries a mass), so that beyond the last rung
//   left = d_k n_{k-1} / (n_k - n_{k-1})
// is to be expected. With e the larger of tolerance and spread of twins:
//   converged       the last two changes are within e, each and together: chance and tolerance
//                   explain them
//   trend           otherwise, where the changes shrink, and what is left is less than half the
//                   value
//   no limit seen   otherwise
enum class Convergence { kConverged, kTrend, kNoLimit };
const char* to_string(Convergence convergence);  // "converged", "trend", "no limit seen"

struct FigureLimit {
  const Figure* figure = nullptr;
  std::vector<double> values;  // SI, one a rung
  Convergence convergence = Convergence::kNoLimit;
  double last_change = 0.0;  // share: d_k
  // Shares, where a limit is seen. `left`: trend only, else 0.
  std::optional<double> left;
  // What the first rung, the scene's, is off by: x_0 - (x_k + left).
  std::optional<double> error;
};

// modes: ascending; values: as many, at least kFewestRungs. spread: share, >= 0, of twins.
inline constexpr std::size_t kFewestRungs = 4;
FigureLimit figure_limit(const Figure& figure, const std::vector<int>& modes,
                         const std::vector<double>& values, double tolerance, double spread);

// n, and three rungs above it, a third of n (at least 2) apart: up to twice as many. The cost of a
// rung grows with about the cube of its modes: a ladder takes some 20 runs of the scene's own.
std::vector<int> mode_ladder(int modes);

struct ModelErrorParameters {
  double tolerance = 0.01;     // share: on the judged figures
  std::vector<double> spread;  // of twins, as figures(); empty: 0
  double step = 0.0;           // s, that forces are averaged over; 0: the scene's
  Jobs jobs = 0;
  std::function<void(double)> progress;  // share done; may be empty
  const std::atomic<bool>* interrupt = nullptr;
};

struct ModelError {
  std::vector<int> modes;            // of the rungs, ascending, the scene's first
  std::vector<FigureLimit> figures;  // the judged ones; empty where there is a reason
  std::string reason;                // why nothing is known; empty: it is
};

// The rungs run on several processors; the result does not depend on how many there are.
ModelError model_error(const scene::Scene& scene, const ModelErrorParameters& parameters);

// "modes kept: 12, 16, 20, 24" and a line a figure, for the terminal; `lead` before each line.
std::string model_error_table(const ModelError& error, const std::string& lead);

// Model error as JSON: {"modes": [...], "<figure>": share or null, ..., "figures": {"<figure>":
// {"values", "convergence", "last_change", "left", "error"}}, "reason" where there is nothing}.
nlohmann::json model_error_json(const ModelError& error);

}  // namespace rotorub
