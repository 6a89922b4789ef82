#include "tests/bench/peers/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "compare/base/module_file.h"
#include "tests/bench/peers/peer_engine.h"

namespace rotorub::peers {
namespace {

const ModuleInterface* load(const std::string& name, const std::string& package,
                            std::string& missing) {
  const std::filesystem::path file = module_file("librotorub_peer_" + name + ".so");
  if (file.empty()) {
    missing = fmt::format("built without it; install {} and build again", package);
    return nullptr;
  }
  // Read when the libraries are loaded: one thread each, as everybody else here has.
  setenv("OMP_NUM_THREADS", "1", 1);
  setenv("OPENBLAS_NUM_THREADS", "1", 1);
  void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* symbol = module ? dlsym(module, kModuleSymbol) : nullptr;
  if (!symbol) {
    const char* why = dlerror();
    missing = fmt::format("{}; {} is needed", why ? why : "no reason given", package);
    return nullptr;
  }
  return static_cast<const ModuleInterface*>(symbol);
}

}  // namespace

Peer module_peer(const std::string& name, const std::string& what, const std::string& package) {
  Peer peer{name, what, "", {}};
  const ModuleInterface* module = load(name, package, peer.missing);
  if (!module) return peer;
  peer.what = fmt::format("{} ({})", what, module->version);
  const MakeStepper make = [module, name](const PlanarSystem& system, double step) {
    std::unique_ptr<Stepper> stepper(module->make(system, step));
    if (!stepper) {
      throw std::runtime_error(name + " cannot hold this system: a body of it has one mass only");
    }
    return stepper;
  };
  peer.variants = {{"", peer_engine(name, PeerContact::kImpulsive, make)}};
  return peer;
}

}  // namespace rotorub::peers
