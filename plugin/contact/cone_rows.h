// The rows of corrected cones in MuJoCo's solver, and their solution by Coulomb's law without it
// (cone.h).
#pragma once

#include <mujoco/mujoco.h>

#include <span>
#include <vector>

namespace rotorub::plugin {

// One contact's rows in MuJoCo's solver.
struct ConeRows {
  const mjContact* contact;
  int first = 0, count = 0;
  double shift = 0.0;  // m/s^2, by which the normal reference is lowered
};

// True if the contact has the edges of a pyramid instead of a normal row and friction rows.
bool is_pyramid(const mjModel* m, const mjContact& c);
int row_count(const mjModel* m, const mjContact& c);
int row_count(std::span<const ConeRows> cones);

// Returns y_N (direction 0) or z_i (direction i) of the contact from y of its rows. A pyramid has
// two edges for each tangent, with y_N +- z_i.
double along(const mjModel* m, const ConeRows& rows, const mjtNum* y, int direction);

// Sorts the contacts into groups that have no kinematic tree in common.
std::vector<std::span<ConeRows>> groups_of(const mjModel* m, std::span<ConeRows> cones);

// Finds the shifts of a group by itself, from the free acceleration. Returns false if they are not
// final: they are a first guess if other rows, a slip across a pyramid or other than sliding
// friction act, and unchanged if the group is too large or has no solution. `alone`: there are no
// other rows.
bool solve_group(const mjModel* m, mjData* d, std::span<ConeRows> group, bool alone);

}  // namespace rotorub::plugin
