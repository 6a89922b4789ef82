// The attractor that a run has settled to, classified by its last part.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "compare/metrics/relative_motion.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// The last fifth of the run (kSettledShare) is classified as the first of these that applies;
// `contact` means rows with a normal force. With several contacts, a row is in contact if any of
// them is, and the whirl and the slip are those at the contact that is closed in the most rows.
enum class Attractor {
  kNoContact,  // no row in contact and no counted impact, or the contact is over (has_ended)
  kBouncing,   // contact in fewer than 99 % of the rows, in any order
  // Travels around the ring by less than 1 % of a turn, or by less than half of its path back and
  // forth: rests or rocks on the ring.
  kResting,
  kSynchronousRub,  // whirls with the spin, within 2 % of the mean spin speed: full annular rub
  kForwardRub,      // whirls with the spin at another frequency
  kBackwardWhip,    // whirls against the spin and slips: dry whip
  kRolling,         // the same with a slip below 1 % of the surface speed: rolls in the ring
  kUnknown          // fewer than 20 rows, or rows too far apart to determine the whirl
};
const char* to_string(Attractor attractor);    // one or two words
const char* explanation(Attractor attractor);  // the definition, in a sentence

struct Settled {
  Attractor attractor = Attractor::kUnknown;
  double from = 0.0;  // s, start of the last part
  // NaN if there are too few rows.
  double contact_share = std::numeric_limits<double>::quiet_NaN();    // in [0, 1]
  double whirl_frequency = std::numeric_limits<double>::quiet_NaN();  // rad/s, signed
  double spin_speed = std::numeric_limits<double>::quiet_NaN();       // rad/s, mean
  std::size_t impacts = 0;                                            // counted impacts
  // For bouncing: the number of turns of the spin after which the motion repeats itself
  // (section_period), 0 if it does not or there are too few turns; and the counted impacts in these
  // turns, 0 if their number varies.
  int turns = 0, bounces = 0;
};
// Its to_string; for periodic bouncing with the period: "bouncing once every turn".
std::string described(const Settled& settled);

inline constexpr double kSettledShare = 0.2;
inline constexpr double kPermanentContact = 0.99;
inline constexpr double kRestingTurn = 0.01;
inline constexpr double kRockingShare = 0.5;
inline constexpr double kSynchronousTolerance = 0.02;
inline constexpr double kRollingTolerance = 0.01;

// The rows for the classification, in [from, end].
struct LastPart {
  double from = 0.0;  // s
  std::vector<RelativePoint> points;
  std::vector<double> normal_force;                              // N, summed over the contacts
  std::vector<double> slip;                                      // m/s
  double spin_speed = std::numeric_limits<double>::quiet_NaN();  // rad/s, mean
  std::size_t impacts = 0;                                       // counted impacts
  // s, ascending; of the impacts, or of the first rows after them.
  std::vector<double> impact_times;
};

// Whether the contact is over: no contact during half of the last part and for twice as long as the
// longest flight before.
bool has_ended(const LastPart& part);

Settled settled(const LastPart& part);
Settled settled(const Trajectory& trajectory);

}  // namespace rotorub
