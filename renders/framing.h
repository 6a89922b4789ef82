// From what a caller asks of a film to what every frame needs: checked, and the defaults filled in.
#pragma once

#include <array>
#include <span>

#include "renders/frame.h"
#include "renders/playback.h"

namespace rotorub::renders {

// Throws std::invalid_argument naming the option, its value and what is accepted.
void check_options(const RenderOptions& options);

// Window, clock and number of frames for the runs that are shown; the magnifications are left at 1.
// Throws std::invalid_argument where the window does not lie within each run.
Framing make_framing(std::span<const Playback* const> runs, const RenderOptions& options);
inline Framing make_framing(const Playback& run, const RenderOptions& options) {
  const std::array<const Playback*, 1> runs = {&run};
  return make_framing(runs, options);
}

// Time of the hardest impact that is shown, or the middle of what is shown, s.
double hardest_impact(const Playback& playback, const Framing& framing);

// "native paper, rigid contact"
std::string engine_label(const Trajectory& trajectory);

}  // namespace rotorub::renders
