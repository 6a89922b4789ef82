// The module: what the program asks for (compare/peers/peers.h).
//
// Left out: Siconos' event-driven strategy (EventDriven, LsodarOSI, NewtonImpactNSL), which could
// run bench_billiard and bench_drop, as they have no friction. Simbody, whose rigid contacts
// (ConditionalConstraint.h) are a point or a sphere on a plane, sphere on sphere and edge on edge,
// but not a disc inside a ring. DART, which was not run: it steps by semi-implicit Euler and solves
// a boxed linear complementarity problem by ODE's own solver, so it should have the order of ode.
//
// A published comparison on another machine has these largest errors at 10 us on bench_ring:
// Siconos 1.0e-6 m (here 1.2e-6), ODE with ERP 0.2 6.3e-6 m (here 3.1e-6); MuJoCo's own cone does
// not converge in either. In the billiard ODE is off by 2.8e-4 m in both.
#include <fmt/format.h>

#include "compare/peers/peers.h"
#include "tests/bench/peers/module.h"
#include "tests/bench/peers/peer_engine.h"
#include "tests/bench/peers/penalty.h"

namespace rotorub::peers {
namespace {

// sqrt(k/m) h that are tried. The stiffer law has the smaller penetration and the fewer steps a
// bounce: which of them is best depends on the scene.
constexpr double kExplicitFractions[] = {0.1, 0.5, 1.0, 1.5};
constexpr double kImplicitFractions[] = {1.5, 5.0};

PeerVariant variant(const std::string& name, const std::string& setting,
                    const PenaltyParameters& parameters) {
  const MakeStepper make = [parameters](const PlanarSystem& system, double step) {
    return penalty_stepper(system, step, parameters);
  };
  return {setting, peer_engine(name, PeerContact::kSoft, make)};
}

Peer penalty(const std::string& name, PenaltyFriction friction, const std::string& what) {
  Peer peer{name, what, "", {}};
  PenaltyParameters parameters;
  parameters.friction = friction;
  const auto add = [&](const char* scheme, double fraction) {
    parameters.step_fraction = fraction;
    peer.variants.push_back(
        variant(name, fmt::format("{}, sqrt(k/m)h {:g}", scheme, fraction), parameters));
  };
  for (const double fraction : kExplicitFractions) add("RK4", fraction);
  if (friction == PenaltyFriction::kPerAxis) return peer;
  parameters.scheme = PenaltyScheme::kImplicitMidpoint;
  for (const double fraction : kImplicitFractions) add("implicit", fraction);
  return peer;
}

}  // namespace
}  // namespace rotorub::peers

extern "C" const std::vector<rotorub::peers::Peer>& rotorub_peers() {
  using namespace rotorub::peers;
  static const std::vector<Peer> all{
      module_peer("siconos",
                  "Moreau-Jean time stepping, FrictionContact in 2D, NewtonImpactFrictionNSL; the "
                  "relation of disc and ring is ours",
                  "libsiconos-kernel-dev"),
      module_peer("ode", "dWorldStep with one contact joint a step; its place and normal are ours",
                  "libode-dev"),
      penalty(
          "penalty", PenaltyFriction::kTangential,
          "spring, damper and smoothed friction, k by the step; RK4, or implicit midpoint rule"),
      penalty("penalty-per-axis", PenaltyFriction::kPerAxis,
              "the same with friction per axis, as ROSS's rubbing has it; RK4")};
  return all;
}
