// How late a tracking law may act before its contact chatters.
#pragma once

#include "native_model/control/controller.h"

namespace rotorub {

// s: the largest command_lead() (radial_tracking.h) under these gains. On a ring of mass M the loop
// has the gain (d s + k)/(M s^2); where it is 1,
//
//   w_c^2 = (D^2 + sqrt(D^4 + 4 K^2)) / 2,   D = d/M, K = k/M,
//
// what comes late by T costs the phase w_c T, and with 1 rad of it gone the contact chatters
// (measured on the reference rig, where w_c is 5,600 rad/s: 175 us do, 200 us do not). Infinity
// without gains.
double largest_lead(const Controller::Gains& gains, double ring_mass);

// Throws scene::SceneError at controller.sample_time, with the one that is needed, where a sampled
// law is later.
void refuse_lateness(const scene::Scene& scene, const Plant& plant, const Controller& law);

}  // namespace rotorub
