#include "native_model/contact/rebound.h"

#include <algorithm>
#include <cmath>

namespace rotorub {

double restitution_beside_loads(double restitution, double approach, double load,
                                double compression_time, double expansion_time) {
  const double compressed = load * compression_time, expanded = load * expansion_time;
  if (!(compressed > 0.0)) return restitution;
  const double back = std::max(0.0, restitution * (approach + compressed) - expanded);
  const double again = std::sqrt(back * (back + 2.0 * expanded));
  if (again <= 0.5 * (1.0 + restitution) * approach) return restitution;
  return restitution * approach / (approach + compressed);
}

}  // namespace rotorub
