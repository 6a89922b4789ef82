// A figure of a scene that an optimisation goes by: a number of its run, or of its modes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rotorub::optimise {

enum class Source { kRun, kModes };

// "peak_force", "settled.spin_speed": of the run, a figure or a key of its summary.
// "modes.speeds.0.response.orbit": of what `rotorub modes --json` prints. A `*` stands for every
// element of a list: of several numbers the worst one counts.
struct FigurePath {
  std::string text;
  Source source = Source::kRun;
  std::vector<std::string> parts;  // behind "modes."
};

// Throws std::invalid_argument with what is accepted.
FigurePath parse_figure(const std::string& text);

// The least or the largest of the numbers that the path leads to; nothing: there is none, or one
// that is null.
std::optional<double> figure_value(const FigurePath& path, const nlohmann::json& all, bool largest);

}  // namespace rotorub::optimise
