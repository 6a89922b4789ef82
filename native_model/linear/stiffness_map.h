// Critical speed maps as in API 684: undamped critical speeds over the stiffness of the rotor's
// supports. On soft bearings a nearly rigid rotor bounces and rocks; on stiff ones the shaft bends
// between nodes at the bearings. A second kind of map varies the stiffness of the support of an
// auxiliary bearing's ring, against which the rotor whirls in a synchronous rub. With c the values
// of the rotor's coordinates at the contact, and m and k of the ring,
//
//   (K + k c c^T) u = Omega^2 (M - G + m c c^T) u,   the ring alone: Omega^2 = k / m.
#pragma once

#include <cstddef>
#include <vector>

#include "native_model/scene/forward.h"

namespace rotorub {

struct StiffnessMap {
  // The stiffness that is varied while all else is unchanged: the springs of all bearings of the
  // shaft, in proportion; the net stiffness of all magnetic bearings (k_i P - k_s); a ring's
  // spring; or the spring of its mount.
  enum class Of { kBearings, kMagnets, kRing, kMount };
  Of of = Of::kBearings;
  std::size_t contact = 0;        // of the ring, index among the scene's auxiliary bearings
  std::vector<double> stiffness;  // N/m, ascending, of the first bearing that has any, in x
  double own = 0.0;               // N/m, value in the scene
  // Critical speeds of the rotor at each stiffness, rad/s, ascending (campbell.h: critical_speeds).
  // In maps over a ring's or mount's stiffness, the rotor's centre is tied to the ring's. Empty if
  // they cannot be found or the magnets do not support the rotor.
  std::vector<std::vector<double>> critical;
  // The same for the ring alone; empty in maps over bearings and magnets.
  std::vector<std::vector<double>> ring;
};

// Maps from a thousandth to a thousand times the scene's own stiffness. There is no map over
// bearings without a spring or with springs that depend on the speed. Nor is there one for a ring
// that is fixed, has ball bearings or dry friction, or is not supported in both planes by a spring
// of its own (or of a passive controller).
std::vector<StiffnessMap> stiffness_maps(const scene::Scene& scene);

}  // namespace rotorub
