// A scene that continues from the end of a run, for sweeping a parameter up and down while the
// rotor keeps its motion, and for bringing neighbouring runs back together.
#pragma once

#include <string>

#include "native_model/scene/forward.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Reason, without a full stop, why [initial] cannot hold everything that a run of the scene leaves:
// the memory of controllers, magnetic bearings, drives and dry friction, or loads that follow one
// course in time. Empty if the run can be continued.
std::string not_continued(const scene::Scene& scene);

// `next` with rotor, rings and spin angle as `run`, a run of `before`, left them, and with time
// starting from 0 again: loads keep the time they have been on, and rotating forces keep their
// phase. A free spin keeps its speed unless rotor.speed of `next` differs from that of `before`.
// Both scenes must pass not_continued() and have the same number of modes and loads.
scene::Scene continued(const scene::Scene& next, const scene::Scene& before, const Trajectory& run);

}  // namespace rotorub
