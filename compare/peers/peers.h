// Other solvers behind the engine interface: the same equations with another project's contact
// solver. They are in tests/bench/peers, in a module that the program loads if it exists; the
// package does not contain it.
//
// The contact of a disc in a ring (its normal from the current positions, its gap) is implemented
// here, because no peer has it. Peer::what names the parts that are the peer's own.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare/engine/engine.h"

namespace rotorub::peers {

struct PeerVariant {
  std::string setting;  // distinguishes it from the peer's others; empty if there is only one
  std::shared_ptr<const Engine> engine;
};

struct Peer {
  std::string name;                   // "siconos"
  std::string what;                   // whose solver it is and how it is used
  std::string missing;                // why it is unavailable; empty if it is available
  std::vector<PeerVariant> variants;  // empty if it is unavailable
};

// The module exports a function of this type. Without the module, all_peers() lists every peer with
// the reason in `missing`.
using AllPeers = const std::vector<Peer>& (*)();
inline constexpr const char* kPeersSymbol = "rotorub_peers";
const std::vector<Peer>& all_peers();

}  // namespace rotorub::peers
