#include "native_model/oracles/annular_rub.h"

#include <cmath>

namespace rotorub::oracle {
namespace {

using Complex = std::complex<double>;

Complex dynamic_stiffness(const Support& s, double frequency) {
  return {s.stiffness - s.mass * frequency * frequency, s.damping * frequency};
}

}  // namespace

std::optional<AnnularRub> annular_rub(const Support& rotor, double clearance, double mu,
                                      double load, double frequency) {
  const Complex d = dynamic_stiffness(rotor, frequency) * clearance;
  const double a = d.real(), b = d.imag(), p = a + mu * b;
  const double discriminant = p * p - (1.0 + mu * mu) * (a * a + b * b - load * load);
  if (discriminant < 0.0) return {};
  const double force = (-p + std::sqrt(discriminant)) / (1.0 + mu * mu);
  if (force < 0.0 || std::abs(b - mu * a) > load * std::sqrt(1.0 + mu * mu)) return {};
  // U e^{-i psi_0} = A + lambda + i (B + mu lambda).
  const double phase = -std::arg(Complex(a + force, b + mu * force));
  return AnnularRub{force, std::polar(clearance, phase), 0.0};
}

std::optional<AnnularRub> annular_rub(const Support& rotor, const Support& ring, double clearance,
                                      double mu, double load, double frequency) {
  const Complex dr = dynamic_stiffness(rotor, frequency), ds = dynamic_stiffness(ring, frequency);
  const Complex friction{1.0, mu}, h = friction * (1.0 / dr + 1.0 / ds);
  const double a = std::norm(h), b = clearance * h.real();
  const double c = clearance * clearance - load * load / std::norm(dr);
  const double discriminant = b * b - a * c;
  if (discriminant < 0.0) return {};
  const double force = (-b + std::sqrt(discriminant)) / a;
  if (force < 0.0) return {};
  // Relative centre delta_0 e^{i psi_0} = U / D_r - lambda h e^{i psi_0}.
  const Complex direction = std::polar(1.0, std::arg(load / dr) - std::arg(clearance + force * h));
  return AnnularRub{force, (load - force * friction * direction) / dr,
                    force * friction * direction / ds};
}

}  // namespace rotorub::oracle
