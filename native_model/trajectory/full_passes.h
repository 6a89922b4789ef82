// Number and duration of full passes of the rotor around its ring, by which a rotor drop is judged.
#pragma once

#include <Eigen/Core>

namespace rotorub {

// A full pass is a turn of the rotor's centre about the ring's by 2 pi in one direction, measured
// from where the motion last reversed; rocking to and fro is not a pass. Passes are counted in
// quarter turns, so that successive states may be up to half a turn apart.
class FullPasses {
 public:
  // centre: the rotor's centre relative to the ring's, m; t: s, ascending. Motion before the first
  // call is not counted.
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
    // An extreme is updated only by motion towards it, and not where a pass has ended.
    if (moved < 0 && turned_ <= low_.turned) low_ = {turned_, t};
    if (moved > 0 && turned_ >= high_.turned) high_ = {turned_, t};
    if (turned_ - low_.turned >= 4) count(forward_, low_, low_.turned + 4, t);
    if (high_.turned - turned_ >= 4) count(backward_, high_, high_.turned - 4, t);
  }
  int forward() const { return forward_; }    // passes about +z, the direction of a positive spin
  int backward() const { return backward_; }  // passes about -z
  double time() const { return time_; }       // s, total duration of all passes

 private:
  struct Extreme {
    int turned = 0;  // quarters
    double t = 0.0;  // s, when it was last there
  };
  // The next pass begins at `place`, where this one ended, which may be up to a quarter turn back.
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
