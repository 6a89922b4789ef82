// When does the relative centre reach the circle within a step? The dense output of a free flight
// makes d(theta) a polynomial and F(theta) = |d|^2 - delta_0^2 another; its first root in (0, 1] is
// the contact: nothing is overlooked, grazing included.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace rotorub {

// Displacement over a step, Delta d(theta) = sum c_i theta^i, i from 1 (c_0 = 0).
inline constexpr int kPathDegree = 7;
using Path = std::array<Eigen::Vector2d, kPathDegree + 1>;

// From the nested form theta (F_0 + (1 - theta)(F_1 + theta (F_2 + ...))), see Dop853.
Path path_from_nested(const std::array<Eigen::Vector2d, kPathDegree>& f);

// How the flight begins. On the circle F has a root at 0 that is known exactly and divided out:
// once after an impact (gap 0), twice where contact ends by a jump of the loads (gap and gap rate
// 0), three times after a lift-off (gap acceleration 0 too).
enum class Departure { kInside = 0, kRebound = 1, kParting = 2, kLiftOff = 3 };

// First theta in (0, 1] with F >= 0, to round-off; empty: none. `d`: centre at the start.
std::optional<double> first_contact(const Path& path, const Eigen::Vector2d& d, double clearance,
                                    Departure departure);

}  // namespace rotorub
