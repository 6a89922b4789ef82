// Starts for the search of periodic motions, from a state of a settled motion. The start of a
// period may be any instant. The best ones lie in the middle of the longest flight of all contacts,
// because a contact that is closed at the start must be so in every iterate. In an autonomous
// system the period is the time after which the motion returns.
#pragma once

#include <string>

#include "native_model/periodic/periodic_motion.h"

namespace rotorub::periodic {

struct FoundGuess {
  Status status = Status::kOk;
  std::string message;  // for a status other than kOk
  Guess guess;
};

// From a state of a settled motion, at the time of that state, which must be at least
// Forcing::settled. periods: n of the loads, or turns of the spin, or whirls, in one period of the
// motion. longest: s, > 0, for which an autonomous motion is watched for its return.
FoundGuess guess_from_state(const Model& model, const State& state, double longest, int periods = 1,
                            const EventParameters& parameters = {});

// The same for a motion that repeats in the frame that turns with the loads.
FoundGuess guess_in_turning_frame(const Model& model, const State& state, double longest,
                                  const EventParameters& parameters = {});

// The same motion from the best instant of its period.
FoundGuess at_best_instant(const Model& model, const Guess& guess,
                           const EventParameters& parameters = {});

}  // namespace rotorub::periodic
