// The native stepper at MuJoCo's step, beside the reference and MuJoCo: what it is off by is the
// step's doing, what MuJoCo is off beyond it the contact model's.
//
// It is the plugin's shadow (plugin/shadow.h): the stepping of `midpoint`, from the same start, one
// step a MuJoCo step. Where a controller commands the actuator, it is driven by the commands that
// MuJoCo's were given in the run that decides; the plugin's own shadow closes its own loop there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/study/comparison_runs.h"

namespace rotorub {

// `native`: the column that it stands beside. `commands`: null without a controller.
ShadowColumn shadow_column(Runner& runner, const Side& native,
                           std::shared_ptr<const CommandRecord> commands,
                           const CompareOptions& options);

}  // namespace rotorub
