// A figure that an optimisation uses: a number of the scene's run or of its modes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rotorub::optimise {

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

}  // namespace rotorub::optimise
