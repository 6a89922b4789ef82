// From what a caller asks of a film to what every frame needs: checked, and the defaults filled in.
#pragma once

#include "renders/frame.h"
#include "renders/playback.h"

namespace rotorub::renders {

// Throws std::invalid_argument naming the option, its value and what is accepted.
void check_options(const RenderOptions& options);

// Window, slow motion and number of frames; the magnifications are left at 1. Throws
// std::invalid_argument where the window does not lie within the run.
Framing make_framing(const Playback& playback, const RenderOptions& options);

// "native paper, rigid contact"
std::string engine_label(const Trajectory& trajectory);

}  // namespace rotorub::renders
