// The text of the starter scene for given sizes.
#pragma once

#include <string>

#include "compare/starter/starter.h"

namespace rotorub {

// In SI.
struct StarterSizes {
  double end = 0.0, step = 0.0, on = 0.0;  // s; on: start of the load
  double first_bearing = 0.0, last_bearing = 0.0, contact_station = 0.0, disc_station = 0.0,
         exciter_station = 0.0;
  double second_contact = 0.0;  // for two auxiliary bearings
  double bearing_stiffness = 0.0;
  // Magnetic bearings: N/m, N/A, A/m, A/(m s), A s/m.
  double negative_stiffness = 0.0, force_per_current = 0.0, proportional = 0.0, integral = 0.0,
         derivative = 0.0;
  double disc_Jt = 0.0, disc_Jp = 0.0;
  double eccentricity = 0.0;  // m; in modal form kg m
  bool is_graded = false;     // whether the eccentricity follows from kBalanceGrade
  double radius = 0.0, sleeve_mass = 0.0, sleeve_Jt = 0.0, sleeve_Jp = 0.0;
  double modal_mass = 0.0, modal_stiffness = 0.0, modal_damping = 0.0;
  double ring_mass = 0.0, ring_stiffness = 0.0, ring_damping = 0.0;
  double motor_inertia = 0.0, motor_gain = 0.0;
  double load = 0.0;         // kg m, static moment of the blade; for the rig N, of the exciter
  double load_orbit = 0.0;   // in clearances, of the free rotor under the load
  double force_limit = 0.0;  // N, on each axis of the actuator; 0: no limit
};

// Balance quality of fans and pumps in ISO 21940-11: eccentricity times spin speed, m/s.
inline constexpr double kBalanceQuality = 6.3e-3;
inline constexpr const char* kBalanceGrade = "G 6.3";

std::string starter_text(const Starter& starter, const StarterSizes& sizes);

}  // namespace rotorub
