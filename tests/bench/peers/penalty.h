// The contact law of rotor codes: a spring and a damper where the disc is in the ring, friction
// smoothed about zero slip. RK4 or the implicit midpoint rule, with a fixed step; the code is ours.
//
//   depth p = |d| - delta_0 > 0:   N = max(0, k p + c p'),   T = -mu N tanh(slip / v_0)
//
// A law with one k has a limit of its own that is not the rigid contact. Here k follows the step,
// by sqrt(k/m) h: 0.1 is about 30 steps a bounce, 1.5 is 2, near what RK4 carries; the implicit
// rule carries any. c gives the restitution, by the formula of mjcf/soft_contact.h.
//
// kPerAxis: friction as ross/faults/rubbing.py of ROSS has it. Damping is on the whole velocity;
// the friction of each axis is mu |F| of that axis, negative on x and positive on y for a positive
// V = v_x cos psi - v_y sin psi + r Omega: not along the tangent, but where |cos psi| = |sin psi|
// in one of the four quadrants.
#pragma once

#include <memory>

#include "tests/bench/peers/stepper.h"

namespace rotorub::peers {

enum class PenaltyFriction { kTangential, kPerAxis };
enum class PenaltyScheme { kRungeKutta, kImplicitMidpoint };  // the latter: tangential friction

struct PenaltyParameters {
  double step_fraction = 0.1;     // sqrt(k/m) step, m the reduced mass of rotor and ring
  double smoothing_speed = 1e-3;  // m/s, v_0
  PenaltyFriction friction = PenaltyFriction::kTangential;
  PenaltyScheme scheme = PenaltyScheme::kRungeKutta;
};

std::unique_ptr<Stepper> penalty_stepper(const PlanarSystem& system, double step,
                                         const PenaltyParameters& parameters = {});

// Force on the rotor: k N/m, c N s/m.
struct PenaltyForce {
  Pair force{0.0, 0.0};   // N
  double normal = 0.0;    // N, towards the centre
  double friction = 0.0;  // N, along e_t
};
PenaltyForce penalty_force(const PlanarSystem& system, const StepRecord& state, double k, double c,
                           const PenaltyParameters& parameters);

}  // namespace rotorub::peers
