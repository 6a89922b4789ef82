// When a sampled controller takes its command: at k T, held until (k + 1) T.
#pragma once

#include <cmath>

namespace rotorub {

// floor(t / T), the sample that holds at time t (s). Steps of a fixed length do not meet k T to the
// last bit: a time that is short of it by round-off counts as there.
inline double sample_index(double t, double sample_time) {
  return std::floor(t / sample_time * (1.0 + 1e-12));
}

}  // namespace rotorub
