#include "native_model/rotor/campbell.h"

#include <cmath>
#include <complex>
#include <cstddef>

#include "native_model/rotor/whirl_eigenvalues.h"

namespace rotorub {
WhirlSpectrum whirl_spectrum(const WhirlSystem& system, double speed) {
  std::vector<std::complex<double>> values = whirl_eigenvalues(system, speed);
  if (speed == 0.0 && !system.isotropic) {
    // Orbits at rest are planar: their sense is that of the orbits at a small spin. Frequencies
    // keep their order, so that the senses carry over one by one.
    constexpr double kSmallSpin = 1e-3;
    const std::vector<std::complex<double>> spun =
        whirl_eigenvalues(system, kSmallSpin * std::abs(values.front()));
    for (std::size_t j = 0; j < values.size(); ++j) {
      if (values[j].imag() * spun[j].imag() < 0.0) values[j] = std::conj(values[j]);
    }
  }
  WhirlSpectrum spectrum{speed, {}};
  for (const std::complex<double>& s : values) {
    const double size = std::abs(s);
    spectrum.modes.push_back({s.imag(), size > 0.0 ? (0.0 - s.real()) / size : 0.0});
  }
  return spectrum;
}

}  // namespace rotorub
