// Lasting contacts of CoupledVerlet in a step in which a load or a command jumps: the step is that
// of the loads before and that of the loads after, each for its share (verlet_jumps.h).

#include <algorithm>
#include <utility>

#include "native_model/stepping/coupled_verlet.h"

namespace rotorub {
namespace {

constexpr double kLeastPart = 1e-9;  // of a step: below, round-off alone keeps the jump in it

}  // namespace

// The whole step as if what holds from begin to end had held all along.
void CoupledVerlet::take_part(std::span<const Eigen::Vector2d> u, double begin, double end) {
  apply_commands(u, q_.data());
  const double kick = std::exchange(kick_, 1.0);
  loads_.weigh(begin, end);
  weighed_free_velocity(begin, end, q_.data());
  kick_ = kick;
  for (std::size_t i = 0; was_first_ && i < free_.size(); ++i) {
    free_[i] = 0.5 * (start_[i] + free_[i]);
  }
  place();
  last();
}

// Once the step is taken with its mean loads, which stay where the contacts only go on as they
// were: their step ends on the circles.
void CoupledVerlet::split(double begin, double end, std::span<const Eigen::Vector2d> u) {
  const std::size_t n = contacts_.size();
  const auto lasts = [](const Contact& c) { return c.lasts; };
  if (std::none_of(was_.begin(), was_.end(), lasts)) return;
  double share = (next_switch(*m_, begin, end) - begin) / (end - begin);
  for (std::size_t i = 0; i < n; ++i) {
    if (commands_[i].share > 0.0) share = std::min(share, commands_[i].share);
  }
  if (share < kLeastPart || share > 1.0 - kLeastPart) return;
  const double middle = begin + share * (end - begin), rest = 1.0 - share;
  // Of commands that jump at another instant the mean.
  std::array<Eigen::Vector2d, kMaxContacts> before, after;
  for (std::size_t i = 0; i < n; ++i) {
    const bool jumps = commands_[i].share > 0.0 && commands_[i].share - share < kLeastPart;
    before[i] = jumps ? commands_[i].before : u[i];
    after[i] = jumps ? commands_[i].after : u[i];
  }
  mean_ = contacts_;
  mean_after_ = after_;
  contacts_ = was_;
  take_part(std::span(before).first(n), begin, middle);
  part_ = contacts_;
  part_after_ = after_;
  for (std::size_t i = 0; i < n; ++i) contacts_[i].lasts = was_[i].lasts;
  take_part(std::span(after).first(n), middle, end);

  bool alike = true;
  for (std::size_t i = 0; i < n; ++i) {
    if (!was_[i].lasts) continue;
    for (const Contact* c : {&mean_[i], &part_[i], &contacts_[i]}) {
      alike = alike && c->lasts && c->slip_sign == was_[i].slip_sign;
    }
  }
  if (alike) {
    contacts_ = mean_;
    after_ = mean_after_;
  } else {
    for (std::size_t j = 0; j < after_.size(); ++j) {
      after_[j] = share * part_after_[j] + rest * after_[j];
    }
    for (std::size_t i = 0; i < n; ++i) {
      Contact& c = contacts_[i];
      c.normal = share * part_[i].normal + rest * c.normal;
      c.friction = share * part_[i].friction + rest * c.friction;
    }
  }
  for (std::size_t i = 0; i < n; ++i) note_lasting(i, was_[i].slip_sign);
  // What works are reckoned from.
  apply_commands(u, q_.data());
  loads_.weigh(begin, end);
}

}  // namespace rotorub
