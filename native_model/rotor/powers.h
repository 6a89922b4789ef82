// Whole powers by multiplication: the same bits everywhere, which a library's pow does not promise.
#pragma once

namespace rotorub {

constexpr double squared(double x) { return x * x; }
constexpr double fourth(double x) { return squared(squared(x)); }

}  // namespace rotorub
