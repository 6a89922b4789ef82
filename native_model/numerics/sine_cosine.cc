#include "native_model/numerics/sine_cosine.h"

#include <cmath>

namespace rotorub::sine_cosine_parts {

template <class T>
void of_far_angles(const T& angle, T& sine, T& cosine) {
  for (int lane = 0; lane < lanes::kWidth<T>; ++lane) {
    const double a = lanes::get(angle, lane);
    if (std::abs(a) <= kFarthest) continue;
    lanes::set(sine, lane, std::sin(a));
    lanes::set(cosine, lane, std::cos(a));
  }
}

template void of_far_angles(const double&, double&, double&);
template void of_far_angles(const lanes::Lane<2>&, lanes::Lane<2>&, lanes::Lane<2>&);
template void of_far_angles(const lanes::Lane<4>&, lanes::Lane<4>&, lanes::Lane<4>&);
template void of_far_angles(const lanes::Lane<8>&, lanes::Lane<8>&, lanes::Lane<8>&);

}  // namespace rotorub::sine_cosine_parts
