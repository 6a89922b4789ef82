// Integer powers by multiplication. They give the same bits on every platform, which pow() does not
// guarantee.
#pragma once

namespace rotorub {

constexpr double squared(double x) { return x * x; }
constexpr double fourth(double x) { return squared(squared(x)); }

}  // namespace rotorub
