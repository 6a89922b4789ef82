// What a run has settled to: a name for its last part, by stated definitions.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "compare/metrics/relative_motion.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Looked at over the last fifth of the run (kSettledShare), with `contact` the share of its rows
// with a normal force:
enum class Attractor {
  kNoContact,       // no row in contact and no counted impact, or none any more (has_ended)
  kBouncing,        // contact in fewer than 99 % of the rows, in whatever order it comes and goes
  kResting,         // else, about the ring by less than 1 % of a turn, or by less than half of
                    // its way forth and back: rests or rocks on it
  kSynchronousRub,  // else, whirl with the spin, within 2 % of the mean spin speed: full annular
                    // rub
  kForwardRub,      // else, whirl with the spin at another frequency
  kBackwardWhip,    // else, whirl against the spin that slips: dry-friction whip
  kRolling,         // the same with a slip under 1 % of the surface speed: rolls in the ring
  kUnknown          // too few rows (under 20), or too far apart to tell a whirl
};
const char* to_string(Attractor attractor);    // one or two words
const char* explanation(Attractor attractor);  // the definition, in a sentence

struct Settled {
  Attractor attractor = Attractor::kUnknown;
  double from = 0.0;  // s, where the last part begins
  // Not a number where there are too few rows to tell.
  double contact_share = std::numeric_limits<double>::quiet_NaN();    // in [0, 1]
  double whirl_frequency = std::numeric_limits<double>::quiet_NaN();  // rad/s, signed
  double spin_speed = std::numeric_limits<double>::quiet_NaN();       // rad/s, mean
  std::size_t impacts = 0;                                            // counted ones
  // Of bouncing: after how many turns of the spin it comes back to itself (section_period), 0: none
  // or too few turns to tell; and its counted impacts in so many turns, 0: not as many each time.
  int turns = 0, bounces = 0;
};
// to_string of it; of bouncing that comes back to itself also how: "bouncing once every turn".
std::string described(const Settled& settled);

inline constexpr double kSettledShare = 0.2;
inline constexpr double kPermanentContact = 0.99;
inline constexpr double kRestingTurn = 0.01;
inline constexpr double kRockingShare = 0.5;
inline constexpr double kSynchronousTolerance = 0.02;
inline constexpr double kRollingTolerance = 0.01;

// The rows that it is distinguished from, of [from, end].
struct LastPart {
  double from = 0.0;  // s
  std::vector<RelativePoint> points;
  std::vector<double> normal_force, slip;                        // N, m/s
  double spin_speed = std::numeric_limits<double>::quiet_NaN();  // rad/s, mean
  std::size_t impacts = 0;                                       // counted ones
  std::vector<double> impact_times;  // s, ascending, of these, or of the rows that saw them first
};

// Whether the contact is over: for half of the last part nothing has touched, and twice as long as
// the longest flight before.
bool has_ended(const LastPart& part);

Settled settled(const LastPart& part);
Settled settled(const Trajectory& trajectory);

}  // namespace rotorub
