// Critical speed maps: undamped critical speeds over the stiffness of what holds the rotor, as API
// 684 asks for them. Soft bearings: a nearly rigid rotor bounces and rocks; stiff ones: the shaft
// bends between nodes at them. And over the stiffness of what carries the ring of an auxiliary
// bearing, against which the rotor whirls in a synchronous rub: with c the values of the rotor's
// coordinates at the contact, m and k of the ring,
//
//   (K + k c c^T) u = Omega^2 (M - G + m c c^T) u,   the ring alone: Omega^2 = k / m.
#pragma once

#include <cstddef>
#include <vector>

#include "native_model/scene/forward.h"

namespace rotorub {

struct StiffnessMap {
  // What is softer or stiffer, all else as it is: the springs of all bearings of the shaft in
  // proportion; those of all magnetic bearings (k_i P - k_s); a ring's spring; its mount's.
  enum class Of { kBearings, kMagnets, kRing, kMount };
  Of of = Of::kBearings;
  std::size_t contact = 0;        // the ring's, among the scene's auxiliary bearings
  std::vector<double> stiffness;  // N/m, ascending, of the first that has any, in x
  double own = 0.0;               // N/m, what the scene gives it
  // rad/s, ascending, at each stiffness (campbell.h: critical_speeds), of the rotor; over a ring's
  // or a mount's of both, the rotor's centre held to the ring's. None where they cannot be found,
  // or the magnets do not bear the rotor.
  std::vector<std::vector<double>> critical;
  std::vector<std::vector<double>> ring;  // the same of the ring alone; empty: not over its own
};

// Each from a thousandth to a thousand times the scene's own stiffness. None: of bearings without a
// spring, or whose springs follow the speed; of a ring that is fixed, or that no spring of its own
// (or of a passive controller) carries in both planes, but balls or dry friction do.
std::vector<StiffnessMap> stiffness_maps(const scene::Scene& scene);

}  // namespace rotorub
