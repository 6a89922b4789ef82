// A progress bar on standard error: on a terminal only, and only for what takes over two seconds.
#pragma once

#include <chrono>
#include <string>

namespace rotorub {

class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // share: done of the whole, in [0, 1]. Cheap to call often.
  void show(double share, const std::string& what);
  // Wipes the bar away, so that other text can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool enabled_;
  bool drawn_ = false;
  Clock::time_point start_, last_;
};

}  // namespace rotorub
