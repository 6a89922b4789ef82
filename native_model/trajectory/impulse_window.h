// The largest normal impulse within a window of time: what the contact gives at once, however an
// engine spreads it. An impact is one number under the rigid law and some twenty steps of force
// under a soft one; its force averaged over a step is a number of the step alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace rotorub {

// Steps of a scene: a soft contact that is as stiff as its step allows bounces in 16
// (mjcf/soft_contact.h).
inline constexpr double kWindowSteps = 20.0;

class ImpulseWindow {
 public:
  // width: s; 0: nothing is watched.
  explicit ImpulseWindow(double width = 0.0) : bin_(width / static_cast<double>(kParts)) {}
  double width() const { return static_cast<double>(kParts) * bin_; }

  // t: s, ascending; impulse: N s.
  void add(double t, double impulse) {
    if (bin_ <= 0.0) return;
    const double bin = std::floor(t / bin_);
    if (bin != now_) move_to(bin);
    bins_[newest_] += impulse;
    sum_ += impulse;
    largest_ = std::max(largest_, sum_);
  }
  double largest() const { return largest_; }  // N s

 private:
  static constexpr std::size_t kParts = 20;  // of a window, and one more: all of a blow is in it

  void move_to(double bin) {
    const double moved = bin - now_;
    now_ = bin;
    if (!(moved >= 0.0 && moved <= static_cast<double>(kParts))) {
      bins_.fill(0.0);
      sum_ = 0.0;
      return;
    }
    for (int k = 0; k < static_cast<int>(moved); ++k) {
      newest_ = newest_ == kParts ? 0 : newest_ + 1;
      bins_[newest_] = 0.0;
    }
    sum_ = std::accumulate(bins_.begin(), bins_.end(), 0.0);
  }

  double bin_, now_ = 0.0, sum_ = 0.0, largest_ = 0.0;
  std::size_t newest_ = 0;
  std::array<double, kParts + 1> bins_{};
};

}  // namespace rotorub
