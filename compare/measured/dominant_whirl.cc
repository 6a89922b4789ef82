#include "compare/measured/dominant_whirl.h"

#include <algorithm>
#include <cmath>

#include "compare/metrics/spectrum.h"

namespace rotorub {

std::optional<DominantWhirl> dominant_whirl(const std::vector<std::complex<double>>& z, double h) {
  if (z.size() < 8) return std::nullopt;
  const FullSpectrum s = full_spectrum(z, h);
  const auto peak =
      static_cast<std::size_t>(std::max_element(s.amplitude.begin(), s.amplitude.end()) - s.amplitude.begin());
  const double apart = 1.0 / (static_cast<double>(z.size()) * h);
  if (!(s.amplitude[peak] > 0.0) || std::abs(s.frequency[peak]) < (kLeastTurns - 0.5) * apart) return std::nullopt;
  DominantWhirl found{s.frequency[peak], s.amplitude[peak]};
  if (peak > 0 && peak + 1 < s.amplitude.size() && s.amplitude[peak - 1] > 0.0 && s.amplitude[peak + 1] > 0.0) {
    const double a = std::log(s.amplitude[peak - 1]), b = std::log(s.amplitude[peak]),
                 c = std::log(s.amplitude[peak + 1]);
    const double bend = a - 2.0 * b + c, by = bend < 0.0 ? 0.5 * (a - c) / bend : 0.0;
    found.frequency += by * apart;
    found.amplitude = std::exp(b - 0.25 * (a - c) * by);
  }
  return found;
}

}  // namespace rotorub
