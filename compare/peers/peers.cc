#include "compare/peers/peers.h"

#include <dlfcn.h>

#include "compare/base/module_file.h"

namespace rotorub::peers {
namespace {

std::vector<Peer> loaded() {
  const std::filesystem::path file = module_file("librotorub_peers.so");
  std::string missing = "built without it; build the target rotorub_peers";
  if (!file.empty()) {
    void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const symbol = module ? dlsym(module, kPeersSymbol) : nullptr;
    if (symbol) return reinterpret_cast<AllPeers>(symbol)();
    const char* const why = dlerror();
    missing = why ? why : "no reason given";
  }
  std::vector<Peer> none;
  for (const char* name : {"siconos", "ode", "penalty", "penalty-per-axis"})
    none.push_back({name, "", missing, {}});
  return none;
}

}  // namespace

const std::vector<Peer>& all_peers() {
  static const std::vector<Peer> all = loaded();
  return all;
}

}  // namespace rotorub::peers
