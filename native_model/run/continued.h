// A scene that goes on where a run ended: for a parameter that is swept up and down while the rotor
// keeps the motion that it has, and for neighbouring runs that are brought together again.
#pragma once

#include <string>

#include "native_model/scene/forward.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Why what a run of the scene leaves is more than [initial] holds, without a full stop: memories of
// controllers, magnetic bearings, drives and dry friction, loads that take one course in time.
// Empty: it can go on.
std::string not_continued(const scene::Scene& scene);

// `next` with the rotor, the rings and the spin's angle where `run`, of `before`, ended, its time
// from 0 again: loads have been on for as long, and what turns by the clock goes on from its phase.
// A spin that is free keeps its speed, unless `next` has another one than `before`. For scenes that
// not_continued() lets pass, with as many modes and loads as each other.
scene::Scene continued(const scene::Scene& next, const scene::Scene& before, const Trajectory& run);

}  // namespace rotorub
