// How often a rotor goes all the way around its ring, and for how long: what a drop is judged by.
#pragma once

#include <Eigen/Core>

namespace rotorub {

// A pass is a turn of the rotor's centre about the ring's by 2 pi in one sense, from the place
// where it last turned back; rocking to and fro is none. Counted in quarters of the turn, so that a
// state may be up to half a turn after the one before it.
class FullPasses {
 public:
  // The rotor's centre from the ring's (m) at t (s), ascending. What was before the first call is
  // not counted.
  void follow(const Eigen::Vector2d& centre, double t) {
    const int quarter =
        centre.y() >= 0.0 ? (centre.x() >= 0.0 ? 0 : 1) : (centre.x() < 0.0 ? 2 : 3);
    int moved = last_quarter_ < 0 ? 0 : (quarter - last_quarter_ + 4) % 4;
    const double cross = last_.x() * centre.y() - last_.y() * centre.x();
    if (moved == 3 || (moved == 2 && cross < 0.0)) moved -= 4;
    if (last_quarter_ < 0) low_ = high_ = {0, t};
    turned_ += moved;
    last_quarter_ = quarter;
    last_ = centre;
    // A turning place is where it came to from the other side, and not where a pass has ended.
    if (moved < 0 && turned_ <= low_.turned) low_ = {turned_, t};
    if (moved > 0 && turned_ >= high_.turned) high_ = {turned_, t};
    if (turned_ - low_.turned >= 4) count(forward_, low_, low_.turned + 4, t);
    if (high_.turned - turned_ >= 4) count(backward_, high_, high_.turned - 4, t);
  }
  int forward() const { return forward_; }    // passes along +z, of a spin > 0 with it
  int backward() const { return backward_; }  // the others
  double time() const { return time_; }       // s, that all of them took

 private:
  struct Extreme {
    int turned = 0;  // quarters
    double t = 0.0;  // s, when it was there last
  };
  // The next pass begins at `place`, where this one ended, which may be a quarter ago.
  void count(int& passes, Extreme& begin, int place, double end) {
    ++passes;
    time_ += end - begin.t;
    low_ = high_ = {turned_, end};
    begin.turned = place;
  }

  int last_quarter_ = -1, turned_ = 0, forward_ = 0, backward_ = 0;
  Eigen::Vector2d last_{0.0, 0.0};
  Extreme low_, high_;
  double time_ = 0.0;
};

}  // namespace rotorub
