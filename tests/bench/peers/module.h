// Peers whose solver is a library: each in a module of its own (lib/librotorub_peer_<name>.so), so
// that the program neither needs the library nor pays for loading it (Siconos brings forty, and a
// BLAS that starts threads).
#pragma once

#include <string>

#include "compare/peers/peers.h"

namespace rotorub::peers {

// The peer from its module; where that is not there or cannot be loaded, `missing` says why and
// names the package to install.
Peer module_peer(const std::string& name, const std::string& what, const std::string& package);

}  // namespace rotorub::peers
