// Other solvers behind the engine interface: the same equations, somebody else's contact solver.
// They live in tests/bench/peers, in a module that the program loads where it is there; the package
// leaves it out.
//
// The contact of a disc in a ring (its normal from the present positions, its gap) is ours: no peer
// has it. What is the peer's own stands in Peer::what.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/engine/engine.h"

namespace rotorub::peers {

struct PeerVariant {
  std::string setting;  // what tells it from the peer's others; empty: there is one
  std::shared_ptr<const Engine> engine;
};

struct Peer {
  std::string name;                   // "siconos"
  std::string what;                   // whose solver, how used
  std::string missing;                // why it is not here; empty: it is
  std::vector<PeerVariant> variants;  // none where it is missing
};

// What the module exports; and all peers: without the module each says what is missing.
using AllPeers = const std::vector<Peer>& (*)();
inline constexpr const char* kPeersSymbol = "rotorub_peers";
const std::vector<Peer>& all_peers();

}  // namespace rotorub::peers
