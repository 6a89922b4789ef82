// The keyphasor: a mark on the shaft that passes a probe once a turn. Where the rotor is whenever
// it passes is the Poincare section of its motion.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace rotorub {

// A passing: the spin angle (without torsion) is a whole multiple of 2 pi.
struct KeyphasorPass {
  double t = 0.0;           // s
  double x = 0.0, y = 0.0;  // m, the rotor's centre at the first contact, as rotor_x and rotor_y
  double spin_speed = 0.0;  // rad/s; negative: the mark comes from the other side
};

class Keyphasor {  // collects the passings of a run
 public:
  // angle: rad. A mark at which the rotor starts has not passed.
  void begin(double angle) {
    last_ = angle;
    passes_.clear();
  }
  // From the angle of the last call to this one, either way: place(mark) gives the KeyphasorPass of
  // each mark on the way, rad, in the order in which they pass; one at the end has passed. A step
  // of more turns than kMostTurns tells none.
  template <class Place>
  void follow(double angle, Place place) {
    const double sense = angle < last_ ? -1.0 : 1.0;
    const double begin = std::floor(sense * last_ / kTurn);
    const double turns = std::floor(sense * angle / kTurn) - begin;
    last_ = angle;
    if (!(turns <= kMostTurns)) return;
    for (int k = 1; k <= static_cast<int>(turns); ++k)
      passes_.push_back(place(sense * (begin + k) * kTurn));
  }
  std::vector<KeyphasorPass> take() { return std::exchange(passes_, {}); }

 private:
  static constexpr double kTurn = 2.0 * std::numbers::pi;
  static constexpr double kMostTurns = 4.0;

  double last_ = 0.0;  // rad
  std::vector<KeyphasorPass> passes_;
};

// The share of a step, in [0, 1], at which an angle reaches `mark`: angle(share) and rate(share),
// its derivative by the share, of one that does not turn back within it. Newton's iteration between
// bounds.
template <class Angle, class Rate>
double share_at(double mark, Angle angle, Rate rate) {
  double low = 0.0, high = 1.0, share = 0.5;
  const bool rises = angle(1.0) > angle(0.0);
  for (int i = 0; i < 60 && low < high; ++i) {
    const double off = angle(share) - mark;
    if (off == 0.0) break;
    ((off > 0.0) == rises ? high : low) = share;
    double next = share - off / rate(share);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == share) break;
    share = next;
  }
  return share;
}

}  // namespace rotorub
