#include "compare/peers/peers.h"

#include "compare/peers/module.h"
#include "compare/peers/peer_engine.h"
#include "compare/peers/penalty.h"

namespace rotorub::peers {
namespace {

Peer penalty(const std::string& name, PenaltyFriction friction, const std::string& what) {
  PenaltyParameters parameters;
  parameters.friction = friction;
  const MakeStepper make = [parameters](const PlanarSystem& system, double step) {
    return penalty_stepper(system, step, parameters);
  };
  return {name, what, "", peer_engine(name, PeerContact::kSoft, make)};
}

}  // namespace

const std::vector<Peer>& all_peers() {
  static const std::vector<Peer> all{
      module_peer("siconos",
                  "Moreau-Jean time stepping, FrictionContact in 2D, NewtonImpactFrictionNSL; the "
                  "relation of disc and ring is ours",
                  "libsiconos-kernel-dev"),
      module_peer("ode", "dWorldStep with one contact joint a step; its place and normal are ours",
                  "libode-dev"),
      penalty("penalty", PenaltyFriction::kTangential,
              "spring, damper and smoothed friction, as stiff as the step carries; RK4"),
      penalty("penalty-per-axis", PenaltyFriction::kPerAxis,
              "the same with friction per axis, as ROSS's rubbing has it")};
  return all;
}

}  // namespace rotorub::peers
