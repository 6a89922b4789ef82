// Other solvers behind the engine interface: the same equations, somebody else's contact solver.
//
// The contact of a disc in a ring (its normal from the present positions, its gap) is ours: no peer
// has it. What is the peer's own stands in Peer::what.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/peers/stepper.h"

namespace rotorub::peers {

struct Peer {
  std::string name;     // "siconos"
  std::string what;     // whose solver, how used
  std::string missing;  // why it is not here; empty: it is
  std::shared_ptr<const Engine> engine;  // null where it is missing
};

const std::vector<Peer>& all_peers();

// Scenes a peer cannot hold throw std::runtime_error with the part that is in the way.
PlanarSystem planar_system(const scene::Scene& scene);

// kImpulsive: an impact is over within a step. kSoft: it is an episode of contact, many steps long.
enum class PeerContact { kImpulsive, kSoft };
using MakeStepper = std::function<std::unique_ptr<Stepper>(const PlanarSystem&, double step)>;
std::unique_ptr<Engine> peer_engine(const std::string& name, PeerContact contact, MakeStepper make);

}  // namespace rotorub::peers
