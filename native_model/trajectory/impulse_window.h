// The largest normal impulse within a window of time: what the contact gives at once, however an engine spreads it.
// An impact is one number under the rigid law and some twenty steps of force under a soft one; its force averaged over
// a step is a number of the step alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace rotorub {

// Steps of a scene: a soft contact that is as stiff as its step allows bounces in 16 (mjcf/soft_contact.h).
inline constexpr double kWindowSteps = 20.0;

class ImpulseWindow {
 public:
  // width: s; 0: nothing is watched.
  explicit ImpulseWindow(double width = 0.0) : bin_(width / kParts) {}
  double width() const { return kParts * bin_; }

  // t: s, ascending; impulse: N s.
  void add(double t, double impulse) {
    if (bin_ <= 0.0) return;
    const double bin = std::floor(t / bin_);
    if (bin != now_) move_to(bin);
    bins_[0] += impulse;
    double sum = 0.0;
    for (const double part : bins_) sum += part;
    largest_ = std::max(largest_, sum);
  }
  double largest() const { return largest_; }  // N s

 private:
  static constexpr int kParts = 4;  // of a window: it is told to a quarter of its width, all of a blow is in it

  void move_to(double bin) {
    const double moved = bin - now_;
    now_ = bin;
    if (!(moved >= 0.0 && moved <= kParts)) return bins_.fill(0.0);
    for (int k = 0; k < static_cast<int>(moved); ++k) {
      std::move_backward(bins_.begin(), bins_.end() - 1, bins_.end());
      bins_[0] = 0.0;
    }
  }

  double bin_, now_ = 0.0, largest_ = 0.0;
  std::array<double, kParts + 1> bins_{};
};

}  // namespace rotorub
