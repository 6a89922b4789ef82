// A run in the format of the page's player: tracks of everything that is drawn.
#pragma once

#include <map>
#include <string>

#include "compare/report/pack/track.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "renders/machine.h"

namespace rotorub {

// The counted impacts of a contact in the order of time.
std::vector<Impact> counted_impacts(const Trajectory& run, std::size_t contact);

// Largest error of the values that a reader recovers at each row of a run:
//   places   1 um, or 1 / 200 of the clearance if that is less, for rotor, ring, and the bent shaft
//            anywhere
//   gap      30 nm (less with a small clearance, see gap_tolerance) or 1 % of the gap, whichever is
//            more, so that a bounce of 3 um is visible; where the gap hardly changes, 1 % of its
//            range
//   forces   1 % of the force itself, or of the mean over the rows with a force, whichever is more;
//            also for currents, motor torque, torsion and the gap rate
//   angles   2 mrad
//   speeds   1 % of the range of the run's spin or ring speed
inline constexpr double kPlaceTolerance = 1e-6;  // m
inline constexpr double kShare = 0.01;

using PackedRun = std::map<std::string, Track>;

// Tracks by name, each only if scene and run have it:
//   bend_1, bend_2, ... (modal coordinates x_k, y_k, if the scene defines the shaft's shape), spin
//   (rad), spin_speed (rad/s), torsion (rad, at the first contact), motor_torque (N m).
//   For each contact, with the prefix contact2_ and so on for the further ones: rotor (x, y, m),
//   ring (x, y), gap (m) and gap_rate (m/s; with the rigid law both have knots at every impact),
//   ring_spin (rad), ring_speed (rad/s), normal, friction (N, of lasting contact, as in the
//   series), mode (a ContactMode), control (x, y, N, on the ring), current (of axes 1 and 2, A),
//   impacts (normal and friction impulse, N s; held, one knot per counted impact).
// machine: the scene's; its modes determine how far each coordinate moves the shaft.
PackedRun pack_run(const scene::Scene& scene, const renders::Machine& machine,
                   const Trajectory& trajectory);

// m: kPlaceTolerance, or 1 / 200 of the smallest clearance if that is less.
double place_tolerance(const scene::Scene& scene);
// m: 30 nm, or 6e-5 of the clearance (m) if that is less.
double gap_tolerance(double clearance);
// The tolerance of forces in each row (see above).
std::vector<double> force_tolerance(const std::vector<std::vector<double>>& components);
// Tolerance of a quantity that varies around a mean, such as a speed: a share of its range.
double range_tolerance(const std::vector<double>& value);

nlohmann::json packed_run_json(const PackedRun& run);

}  // namespace rotorub
