// The settings of the event-driven integrator, with the reasons for their values.
#pragma once

namespace rotorub {

struct EventParameters {
  // Local error of a step, relative to the largest displacement, speed, ... so far. With 1e-12 the
  // error of a whole run is near its round-off; a smaller tolerance only costs steps.
  double tolerance = 1e-12;
  // m/s; an impact with a smaller approach speed has no rebound, which ends an accumulation (Zeno).
  // At 1e-9 the omitted flights last less than 2e-9 m/s divided by the acceleration, and move less
  // than 1e-18 m^2/s^2 divided by it.
  double zeno_velocity_threshold = 1e-9;
  // s; if a contact that closes this slowly opens another one, as a rotor that rocks between two
  // rings does, both stay closed if the flight of the other would be shorter than this. This ends
  // accumulations that no restitution ends.
  double shortest_flight = 1e-12;
  // The sum of the accelerations at a contact counts as 0 below this share of its terms. On an
  // orbit as wide as the clearance the sum is 0, but `tolerance` leaves a few times its own size.
  double no_force = 1e-10;
  // A margin (force, slip) below 0 by less than this share of its scale is round-off and not
  // crossed, because a phase may begin on its margin.
  double margin_round_off = 1e-13;
  // s, width of the bins over which the normal force is averaged for its peak and mean square, as
  // in a fixed-step run; 0: neither is computed.
  double force_bin = 0.0;
  // Number of events at one instant, up to round-off, after which the run stops. Real chains
  // (impact, stick, slide) have only a few.
  int stall_limit = 1000;
  // A run whose steps are short only for stability stops if more than this number of steps remain
  // (StiffnessWatch). For a small system they take a quarter of a minute. Runs that are merely long
  // continue.
  double most_stiff_steps = 5e6;
  // A run stops if more than this number of steps remain, whatever shortens them; they take an hour
  // or more. Near round-off the cause cannot be found.
  double most_steps = 1e9;
  // A run also stops if, after a fifth of this number of impacts, more than this number remain at
  // their pace: nothing ends the bouncing of a contact with a restitution of 1.
  double most_impacts = 5e6;
};

}  // namespace rotorub
