#include "native_model/linear/mode_shapes.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include "native_model/linear/campbell.h"
#include "native_model/rotor/modal_reduction.h"
#include "native_model/rotor/refusal.h"
#include "native_model/rotor/rotor_modes.h"

namespace rotorub {
namespace {

// lines: the modes as scaled in the model. The Ritz columns have the same shape and, once scaled to
// the same size, give the value at any station.
PlaneShapes plane_shapes(const PlaneModes& plane, const Eigen::MatrixXd& lines,
                         const Eigen::VectorXd& z, const BendingBasis& basis,
                         const Eigen::MatrixXd& columns, const std::vector<Station>& stations) {
  const Eigen::Index n = lines.cols();
  PlaneShapes result{plane.stiffness.cwiseQuotient(plane.mass).cwiseSqrt(), lines,
                     Eigen::MatrixXd(static_cast<Eigen::Index>(stations.size()), n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    Eigen::Index peak = 0;
    lines.col(j).cwiseAbs().maxCoeff(&peak);
    const double factor = lines(peak, j) / basis.deflection(z[peak]).dot(columns.col(j));
    for (std::size_t i = 0; i < stations.size(); ++i) {
      result.at_stations(static_cast<Eigen::Index>(i), j) =
          factor * basis.deflection(stations[i].z).dot(columns.col(j));
    }
  }
  return result;
}

using Complex = std::complex<double>;

// r_+' and r_-' of a whirl, which have its shape, in the system's coordinates; `own` has the sense
// of the whirl.
struct Turns {
  Eigen::VectorXcd own, other;
};

Turns turns_of(const WhirlSystem& system, const Whirl& whirl) {
  const Eigen::Index n = system.size();
  if (system.isotropic) return {whirl.rates, Eigen::VectorXcd::Zero(n)};
  // The member of the complex pair with Im s > 0: x' = Re(x^ e^{st}), and y' likewise.
  const Complex i(0.0, 1.0);
  const Eigen::VectorXcd plus = 0.5 * (whirl.rates.head(n) + i * whirl.rates.tail(n));
  const Eigen::VectorXcd minus = 0.5 * (whirl.rates.head(n) - i * whirl.rates.tail(n));
  return whirl.s.imag() > 0.0 ? Turns{plus, minus} : Turns{minus, plus};
}

// Major semi-axes, with the sign of the component of `own` in phase with `phase`.
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

std::optional<ModeShapes> mode_shapes(const scene::Scene& scene) {
  if (!scene.rotor.geometry) return std::nullopt;
  return with_place(scene, [&] {
    const RotorModes modes = rotor_modes(scene);
    const ModalRotor rotor = reduce_bending(scene, modes);
    const ModeLines& lines = *rotor.lines;
    const BendingBasis& basis = modes.ritz.basis;
    ModeShapes result{lines.z, stations_of(scene), {}, {}, modes.ritz.isotropic};
    std::stable_sort(result.stations.begin(), result.stations.end(),
                     [](const Station& a, const Station& b) { return a.z < b.z; });
    result.x = plane_shapes(rotor.x, lines.x, lines.z, basis, modes.x.shape, result.stations);
    result.y = plane_shapes(rotor.y, lines.y, lines.z, basis, modes.y.shape, result.stations);
    return result;
  });
}

std::vector<WhirlMode> torsion_frequencies(const ModalRotor& rotor) {
  const TorsionModes& torsion = rotor.torsion;
  std::vector<WhirlMode> modes;
  for (Eigen::Index k = 0; k < torsion.inertia.size(); ++k) {
    const double frequency = std::sqrt(torsion.stiffness[k] / torsion.inertia[k]);
    modes.push_back({frequency, torsion.damping[k] / (2.0 * frequency * torsion.inertia[k])});
  }
  return modes;
}

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
