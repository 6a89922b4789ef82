// A whole run of a peer. Its steps are timed in chunks without our recorder.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "compare/engine/engine.h"
#include "tests/bench/peers/stepper.h"

namespace rotorub::peers {

// kImpulsive: an impact is over within one step. kSoft: an impact is an episode of contact of many
// steps.
enum class PeerContact { kImpulsive, kSoft };
using MakeStepper = std::function<std::unique_ptr<Stepper>(const PlanarSystem&, double step)>;

std::unique_ptr<Engine> peer_engine(const std::string& name, PeerContact contact, MakeStepper make);

}  // namespace rotorub::peers
