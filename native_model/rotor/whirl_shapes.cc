#include "native_model/rotor/whirl_shapes.h"

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <cstddef>

#include "native_model/rotor/refusal.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/rotor/whirl_eigenvalues.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// r_+ and r_- of a whirl, in the system's coordinates: its own turn first.
struct Turns {
  Eigen::VectorXcd own, other;
};

// The v with P v = 0, by inverse iteration beside the eigenvalue. A coordinate counts by its frequency, so that
// stiff ones cost no digits.
Eigen::VectorXcd null_vector(const Eigen::MatrixXcd& P, const Eigen::VectorXd& stiffness) {
  constexpr int kIterations = 3;
  const Eigen::VectorXd w =
      stiffness.unaryExpr([](double k) { return k > 0.0 ? 1.0 / std::sqrt(k) : 1.0; });
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(w.cast<Complex>().asDiagonal() * P *
                                                 w.cast<Complex>().asDiagonal());
  // No mode is orthogonal to it by symmetry.
  Eigen::VectorXcd v = Eigen::VectorXd::LinSpaced(w.size(), 1.0, 1.7).cast<Complex>();
  for (int k = 0; k < kIterations; ++k) v = lu.solve(v).normalized();
  if (!v.allFinite()) throw RotorNotSolvable("no whirl shape can be found");
  return w.cast<Complex>().asDiagonal() * v;
}

// Off the eigenvalue by less than shows, and by enough that P can be solved.
Complex beside(Complex s) { return s * (1.0 + 1e-10); }

Turns turns_of(const WhirlSystem& system, double speed, Complex s) {
  const Eigen::Index n = system.size();
  if (system.isotropic) {
    const Complex at = beside(s);
    const WhirlMatrices m = isotropic_matrices(system, speed);
    Eigen::MatrixXcd P = at * m.damping + m.stiffness;
    P.diagonal().array() += at * at;
    return {null_vector(P, system.stiffness_x.diagonal()), Eigen::VectorXcd::Zero(n)};
  }
  // Of the complex pair the one with Im s > 0: x = Re(x^ e^{st}), y alike.
  const Complex at = beside(s.imag() > 0.0 ? s : std::conj(s));
  const PlanesMatrices m = planes_matrices(system, speed);
  Eigen::MatrixXcd P = at * m.damping + m.stiffness;
  P.diagonal().array() += at * at;
  Eigen::VectorXd stiffness(2 * n);
  stiffness << system.stiffness_x.diagonal(), system.stiffness_y.diagonal();
  const Eigen::VectorXcd v = null_vector(P, stiffness);
  const Complex i(0.0, 1.0);
  const Eigen::VectorXcd plus = 0.5 * (v.head(n) + i * v.tail(n));
  const Eigen::VectorXcd minus = 0.5 * (v.head(n) - i * v.tail(n));
  return s.imag() > 0.0 ? Turns{plus, minus} : Turns{minus, plus};
}

// Larger half-axes, with the sign of the own turn's part in phase with `phase`.
Eigen::VectorXd signed_axes(const Eigen::VectorXcd& own, const Eigen::VectorXcd& other, Complex phase) {
  Eigen::VectorXd axes(own.size());
  for (Eigen::Index k = 0; k < own.size(); ++k) {
    const double size = std::abs(own[k]);
    const double in_phase = size > 0.0 ? (own[k] * std::conj(phase)).real() / size : 0.0;
    axes[k] = in_phase * (size + std::abs(other[k]));
  }
  return axes;
}

Eigen::MatrixXd deflections(const BendingBasis& basis, const Eigen::VectorXd& z, const Eigen::MatrixXd& phi) {
  Eigen::MatrixXd u(z.size(), phi.cols());
  for (Eigen::Index k = 0; k < z.size(); ++k) u.row(k) = basis.deflection(z[k]) * phi;
  return u;
}

}  // namespace

std::vector<WhirlShape> whirl_shapes(const scene::Scene& scene, const WhirlSystem& system, double speed,
                                     const ModeShapes& along) {
  const RotorModes modes = rotor_modes(scene);
  Eigen::VectorXd stations(static_cast<Eigen::Index>(along.stations.size()));
  for (std::size_t k = 0; k < along.stations.size(); ++k) {
    stations[static_cast<Eigen::Index>(k)] = along.stations[k].z;
  }
  const Eigen::MatrixXd lines = deflections(modes.ritz.basis, along.z, modes.mean.shape);
  const Eigen::MatrixXd values = deflections(modes.ritz.basis, stations, modes.mean.shape);

  const std::vector<Complex> s = whirl_eigenvalues(system, speed);
  const WhirlSpectrum spectrum = whirl_spectrum(system, speed);
  std::vector<WhirlShape> shapes;
  for (std::size_t j = 0; j < s.size(); ++j) {
    if (spectrum.modes[j].frequency == 0.0) continue;
    const Turns turns = turns_of(system, speed, s[j]);
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
