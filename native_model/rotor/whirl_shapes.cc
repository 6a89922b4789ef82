#include "native_model/rotor/whirl_shapes.h"

#include <cmath>
#include <complex>
#include <cstddef>

#include "native_model/rotor/rotor_modes.h"
#include "native_model/rotor/whirl_eigenvalues.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// r_+' and r_-' of a whirl, which have its shape, in the system's coordinates: its own turn first.
struct Turns {
  Eigen::VectorXcd own, other;
};

Turns turns_of(const WhirlSystem& system, const Whirl& whirl) {
  const Eigen::Index n = system.size();
  if (system.isotropic) return {whirl.rates, Eigen::VectorXcd::Zero(n)};
  // Of the complex pair the one with Im s > 0: x' = Re(x^ e^{st}), y' alike.
  const Complex i(0.0, 1.0);
  const Eigen::VectorXcd plus = 0.5 * (whirl.rates.head(n) + i * whirl.rates.tail(n));
  const Eigen::VectorXcd minus = 0.5 * (whirl.rates.head(n) - i * whirl.rates.tail(n));
  return whirl.s.imag() > 0.0 ? Turns{plus, minus} : Turns{minus, plus};
}

// Larger half-axes, with the sign of the own turn's part in phase with `phase`.
Eigen::VectorXd signed_axes(const Eigen::VectorXcd& own, const Eigen::VectorXcd& other,
                            Complex phase) {
  Eigen::VectorXd axes(own.size());
  for (Eigen::Index k = 0; k < own.size(); ++k) {
    const double size = std::abs(own[k]);
    const double in_phase = size > 0.0 ? (own[k] * std::conj(phase)).real() / size : 0.0;
    axes[k] = in_phase * (size + std::abs(other[k]));
  }
  return axes;
}

Eigen::MatrixXd deflections(const BendingBasis& basis, const Eigen::VectorXd& z,
                            const Eigen::MatrixXd& phi) {
  Eigen::MatrixXd u(z.size(), phi.cols());
  for (Eigen::Index k = 0; k < z.size(); ++k) u.row(k) = basis.deflection(z[k]) * phi;
  return u;
}

}  // namespace

std::vector<WhirlShape> whirl_shapes(const scene::Scene& scene, const WhirlSystem& system,
                                     double speed, const ModeShapes& along) {
  const RotorModes modes = rotor_modes(scene);
  Eigen::VectorXd stations(static_cast<Eigen::Index>(along.stations.size()));
  for (std::size_t k = 0; k < along.stations.size(); ++k) {
    stations[static_cast<Eigen::Index>(k)] = along.stations[k].z;
  }
  const Eigen::MatrixXd lines = deflections(modes.ritz.basis, along.z, modes.mean.shape);
  const Eigen::MatrixXd values = deflections(modes.ritz.basis, stations, modes.mean.shape);

  const std::vector<Whirl> all = whirls(system, speed);
  const WhirlSpectrum spectrum = whirl_spectrum(system, speed);
  std::vector<WhirlShape> shapes;
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (spectrum.modes[j].frequency == 0.0) continue;
    const Turns turns = turns_of(system, all[j]);
    const Eigen::VectorXcd own = lines * turns.own, other = lines * turns.other;
    Eigen::Index peak = 0;
    const double largest = (own.cwiseAbs() + other.cwiseAbs()).maxCoeff(&peak);
    const double size = std::abs(own[peak]);
    const Complex phase = size > 0.0 ? own[peak] / size : Complex(1.0);
    shapes.push_back({spectrum.modes[j], signed_axes(own, other, phase) / largest,
                      signed_axes(values * turns.own, values * turns.other, phase) / largest,
                      std::abs(size - std::abs(other[peak])) / largest});
  }
  return shapes;
}

}  // namespace rotorub
