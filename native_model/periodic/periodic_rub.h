// A periodic motion as a rub: its kind and its figures at each contact. And a start for runs that
// may settle to a backward whip.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "native_model/periodic/period_figures.h"
#include "native_model/periodic/settled_motion.h"

namespace rotorub::periodic {

// One periodic motion with the starts that lead to it.
struct PeriodicRub {
  // "no contact", "synchronous rub" (it goes around with the spin or with a rotating force, also
  // backward), "backward whip", "forward whirl", "rolling", "sticking", "stick-slip", "rub on one
  // side" (the contact does not go around the ring) or "bouncing", of the contact with the largest
  // mean force.
  std::string kind;
  std::vector<std::string> starts;
  SettledMotion settled;
  double spin = 0.0;                    // rad/s, at the start of the period
  std::size_t contact = 0;              // with the largest mean force
  std::vector<ContactFigures> figures;  // one per auxiliary bearing
  std::vector<KeyphasorPass> passes;    // of the rotor's mark in one period
  double largest_multiplier() const;    // its absolute value
};

// The rub of a motion, with kind, contact and figures; without starts.
PeriodicRub periodic_rub(const Model& model, SettledMotion settled);

// A backward whirl of the first bending mode, faster than the free whirl, together with the ring of
// the first contact, so that they press on each other. Empty if the machine has no such state.
std::optional<State> backward_whirl(const Model& model);

}  // namespace rotorub::periodic
