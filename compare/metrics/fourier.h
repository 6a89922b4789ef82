// Eigen's Fourier transforms with FFTW, whose plans do not depend on timing measurements here; in a
// page (report/live) with Eigen's own implementation. Also the window for the spectra of stretches.
#pragma once

#ifndef __EMSCRIPTEN__
#define EIGEN_FFTW_DEFAULT
#endif
#include <Eigen/Core>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace rotorub {

// Hann window: w_n = (1 - cos(2 pi n / size)) / 2, n = 0 ... size - 1.
inline Eigen::ArrayXd hann_window(Eigen::Index size) {
  const Eigen::ArrayXd n = Eigen::ArrayXd::LinSpaced(size, 0.0, static_cast<double>(size - 1));
  return 0.5 - 0.5 * (2.0 * std::numbers::pi / static_cast<double>(size) * n).cos();
}

// The values less their mean, times the window. The mean has the window's weights, so that the sum
// is 0: a whirl that does not make whole turns would otherwise show a peak at 0 Hz.
inline Eigen::ArrayXcd windowed(const Eigen::Ref<const Eigen::ArrayXcd>& values,
                                const Eigen::ArrayXd& window) {
  return window * (values - (window * values).sum() / window.sum());
}

}  // namespace rotorub
