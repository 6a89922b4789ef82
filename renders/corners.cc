#include "renders/corners.h"

#include <algorithm>

namespace rotorub::renders {

Sheet::Point Corners::next(double wide, double high) {
  std::size_t chosen = 0;
  for (std::size_t corner = used_.size(); corner-- > 0;) {
    if (used_[corner] >= 0.0 && is_free({place(corner, wide, high), {wide, high}})) chosen = corner;
  }
  const Sheet::Point at = place(chosen, wide, high);
  used_[chosen] += high;
  taken_.push_back({at, {wide, high}});
  return at;
}

Sheet::Point Corners::place(std::size_t corner, double wide, double high) const {
  return {corner == 1 ? width_ - wide : 0.0,
          corner == 2 ? height_ - used_[corner] - high : used_[corner]};
}

bool Corners::is_free(const Box& box) const {
  const Sheet::Point middle(0.5 * width_, 0.5 * height_);
  const Sheet::Point nearest = middle.cwiseMax(box.at).cwiseMin(box.at + box.size);
  return (nearest - middle).norm() >= reach_ && std::ranges::none_of(taken_, [&](const Box& other) {
           return ((box.at - other.at).array() < other.size.array()).all() &&
                  ((other.at - box.at).array() < box.size.array()).all();
         });
}

}  // namespace rotorub::renders
