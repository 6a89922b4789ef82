// Runs tune for commands: its default ladder of steps and its reader of scenes.
#pragma once

#include <functional>
#include <string>

#include "compare/commands/command.h"
#include "compare/tune/tune.h"

namespace rotorub {

// steps: LIST as for --steps; if empty, 1-2-5 from 1 ms to 1 us and the scene's own step. scene:
// read from `file` with the overrides of the options; it must have a contact. progress: (fraction
// done, what is running).
tune::TuneResult tuned(const std::string& file, const scene::Scene& scene,
                       const CommonOptions& options, double tolerance, int twins,
                       const std::string& steps,
                       const std::function<void(double, const std::string&)>& progress);

// "rigid, 20 µs: 21.19 µs a step", or a sentence that no setting can be trusted.
std::string setting_sentence(const tune::TuneResult& result);

}  // namespace rotorub
