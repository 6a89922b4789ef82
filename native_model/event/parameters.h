// The settings of the event-driven integrator, with the reasons for their values.
#pragma once

namespace rotorub {

struct EventParameters {
  // Local error of a step, relative to the largest displacement, speed, ... met so far. At 1e-12
  // the error of a whole run is near what round-off leaves of it; a smaller one costs steps for
  // nothing.
  double tolerance = 1e-12;
  // m/s: an impact that closes slower takes no rebound, which ends an accumulation (Zeno). The
  // flights left out last less than 2e-9 m/s over the acceleration, and move 1e-18 m^2/s^2 over it.
  double zeno_velocity_threshold = 1e-9;
  // s: what closes so slowly and opens another contact, as a rotor that rocks between two rings,
  // leaves both closed where the other's flight would be shorter than this: an accumulation of
  // impacts that no restitution ends.
  double shortest_flight = 1e-12;
  // Share of the accelerations that meet at the contact under which their sum counts as 0. On an
  // orbit as wide as the clearance that sum is 0, and `tolerance` leaves a few times itself of it.
  double no_force = 1e-10;
  // Share of the scale of a margin (force, slip) under which it is round-off and not crossed: a
  // phase may begin on its margin.
  double margin_round_off = 1e-13;
  // s, width of the bins over which the normal force is averaged for its peak and mean square, as a
  // fixed step would do; 0: neither is found.
  double force_bin = 0.0;
  // Events at one instant, to round-off, before the run is given up. Real chains (impact, stick,
  // slide) have a handful.
  int stall_limit = 1000;
  // Steps to go from which a run whose steps are short for their stability alone is given up:
  // StiffnessWatch. A quarter of a minute of a small system; one that is merely long goes on.
  double most_stiff_steps = 5e6;
  // Steps to go from which a run is given up whatever shortens its steps, an hour or more: next to
  // round-off nothing tells what does.
  double most_steps = 1e9;
};

}  // namespace rotorub
