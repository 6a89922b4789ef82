// The keyphasor: a mark on the shaft that passes a probe once per turn. The positions of the rotor
// at these instants are the Poincare section of its motion.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace rotorub {

// A pass of the mark: the spin angle (without torsion) is a whole multiple of 2 pi.
struct KeyphasorPass {
  double t = 0.0;           // s
  double x = 0.0, y = 0.0;  // m, the rotor's centre at the first contact, as rotor_x and rotor_y
  double spin_speed = 0.0;  // rad/s; negative: the mark passes in the opposite direction
};

class Keyphasor {  // collects the passes of a run
 public:
  // angle: rad. A mark exactly at the starting angle does not count as passed.
  void begin(double angle) {
    last_ = angle;
    low_ = high_ = 0.0;
    passes_.clear();
  }
  // Covers the angles from the last call to this one, in either direction. place(mark) must return
  // the KeyphasorPass of each mark on the way (rad), in the order of passing; a mark at the end has
  // passed. A step of more than kMostTurns turns adds none.
  template <class Place>
  void follow(double angle, Place place) {
    if (angle > low_ && angle < high_) {
      last_ = angle;
      return;
    }
    const double sense = angle < last_ ? -1.0 : 1.0;
    const double begin = std::floor(sense * last_ / kTurn);
    const double turns = std::floor(sense * angle / kTurn) - begin;
    last_ = angle;
    const double mark = kTurn * std::floor(angle / kTurn);
    low_ = mark + kNear;
    high_ = mark + kTurn - kNear;
    if (!(turns <= kMostTurns)) return;
    for (int k = 1; k <= static_cast<int>(turns); ++k)
      passes_.push_back(place(sense * (begin + k) * kTurn));
  }
  std::vector<KeyphasorPass> take() { return std::exchange(passes_, {}); }

 private:
  static constexpr double kTurn = 2.0 * std::numbers::pi;
  static constexpr double kMostTurns = 4.0;
  static constexpr double kNear = 1e-6;  // rad, from a mark; round-off of the angle is smaller

  double last_ = 0.0;              // rad
  double low_ = 0.0, high_ = 0.0;  // rad; no mark passes while the angle stays between them
  std::vector<KeyphasorPass> passes_;
};

// Fraction of a step, in [0, 1], at which an angle reaches `mark`. angle(share) must be monotonic
// in the step, and rate(share) is its derivative with respect to share. Newton's iteration between
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
