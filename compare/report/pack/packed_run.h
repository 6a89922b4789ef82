// A run as the page's player has it: the tracks of all that is drawn.
#pragma once

#include <map>
#include <string>

#include "compare/report/pack/track.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/machine.h"

namespace rotorub {

// Those of a contact that count, in order of time.
std::vector<Impact> counted_impacts(const Trajectory& run, std::size_t contact);

// What a reader gets back of a run, at each of its rows, is off by no more than:
//   places   1 um, and 1 / 200 of the clearance where that is less, of rotor, ring, and the bent
//            shaft anywhere
//   gap      30 nm (less where the clearance is: see gap_tolerance) or 1 % of it, whichever is
//            more: a bounce of 3 um is seen
//   forces   1 % of the force itself, or of the mean over the rows where there is one, whichever is
//            more; so are currents, motor torque and torsion
//   angles   2 mrad
//   speeds   1 % of the range that the run's spin, or ring, goes through
inline constexpr double kPlaceTolerance = 1e-6;  // m
inline constexpr double kShare = 0.01;

using PackedRun = std::map<std::string, Track>;

// By name, each only where scene and run have it:
//   bend_1, bend_2, ... (modal coordinates x_k, y_k, where the scene gives the shaft's shape), spin
//   (rad), spin_speed (rad/s), torsion (rad, at the first contact), motor_torque (N m); and of each
//   contact, those of the further ones with contact2_ and so on before the name: rotor (x, y, m),
//   ring (x, y), gap (m; in the rigid law with a knot at every impact), ring_spin (rad), ring_speed
//   (rad/s), normal, friction (N, of lasting contact, as the series), mode (a Mode), control (x, y,
//   N, on the ring), current (of axes 1 and 2, A), impacts (normal, friction impulse, N s; held,
//   one knot an impact that counts).
// `machine`: the scene's, whose modes say how far each moves the shaft.
PackedRun pack_run(const scene::Scene& scene, const renders::Machine& machine,
                   const Trajectory& trajectory);

// m: kPlaceTolerance, and 1 / 200 of the least clearance where that is less.
double place_tolerance(const scene::Scene& scene);
// m: 30 nm, and 6e-5 of the clearance (m) where that is less.
double gap_tolerance(double clearance);
// The tolerance of forces: of each row (see above).
std::vector<double> force_tolerance(const std::vector<std::vector<double>>& components);
// Of what varies about a mean, a speed: a share of how far it goes, the same in each row.
double range_tolerance(const std::vector<double>& value);

nlohmann::json packed_run_json(const PackedRun& run);

}  // namespace rotorub
