#include "native_model/control/command_record.h"

#include <algorithm>
#include <cassert>

namespace rotorub {

void CommandRecord::add(double t, const Eigen::Vector2d& value) {
  assert(begins_.empty() || t > begins_.back());
  if (value == command(static_cast<std::ptrdiff_t>(begins_.size()) - 1)) return;
  begins_.push_back(t);
  commands_.push_back(value);
}

std::ptrdiff_t CommandRecord::piece(double t) const {
  return std::upper_bound(begins_.begin(), begins_.end(), t) - begins_.begin() - 1;
}

const Eigen::Vector2d& CommandRecord::command(std::ptrdiff_t piece) const {
  static const Eigen::Vector2d kNothing{0.0, 0.0};
  return piece < 0 ? kNothing : commands_[static_cast<std::size_t>(piece)];
}

const Eigen::Vector2d& CommandRecord::at(double t) const { return command(piece(t)); }

Eigen::Vector2d CommandRecord::mean(double begin, double end) const {
  assert(begin < end);
  const std::ptrdiff_t first = piece(begin);
  const auto next = static_cast<std::size_t>(first + 1);
  if (next == begins_.size() || begins_[next] >= end) return command(first);
  Eigen::Vector2d sum = (begins_[next] - begin) * command(first);
  for (std::size_t k = next; k < begins_.size() && begins_[k] < end; ++k) {
    const double until = k + 1 < begins_.size() ? std::min(end, begins_[k + 1]) : end;
    sum += (until - begins_[k]) * commands_[k];
  }
  return sum / (end - begin);
}

}  // namespace rotorub
