// The shafts with known whirl: Rayleigh's figures put back into the beam's equation by finite
// differences, Friswell's discs against the volume integrals.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support/oracles/shafts.h"

namespace rotorub::oracle {
namespace {

using Complex = std::complex<double>;
constexpr RayleighShaft kHollow{1.2, 0.06, 0.03, 2.1e11, 7850.0};

// r(z, t) = sin(n pi z / L) e^{i w t} in
//   rho A r_tt - rho I r_zztt + 2 i Omega rho I r_zzt + E I r_zzzz = 0      (I_p = 2 I),
// derivatives in z by central differences; relative to the largest term.
double beam_residual(const RayleighShaft& s, int n, double speed, double w) {
  const double z = 0.37 * s.length / n, h = s.length / n * 5e-3;
  const auto shape = [&](double at) { return std::sin(n * std::numbers::pi * at / s.length); };
  const double r = shape(z);
  const double zz =
      (-shape(z - 2 * h) + 16 * shape(z - h) - 30 * r + 16 * shape(z + h) - shape(z + 2 * h)) /
      (12 * h * h);
  const double zzzz = (-shape(z - 3 * h) + 12 * shape(z - 2 * h) - 39 * shape(z - h) + 56 * r -
                       39 * shape(z + h) + 12 * shape(z + 2 * h) - shape(z + 3 * h)) /
                      (6 * std::pow(h, 4));
  const Complex iw(0.0, w), i(0.0, 1.0);
  const double line = s.rho * s.area(), turn = s.rho * s.inertia();
  const Complex terms[] = {line * iw * iw * r, -turn * iw * iw * zz,
                           2.0 * i * speed * turn * iw * zz, s.E * s.inertia() * zzzz};
  Complex sum = 0.0;
  double largest = 0.0;
  for (const Complex& term : terms) {
    sum += term;
    largest = std::max(largest, std::abs(term));
  }
  return std::abs(sum) / largest;
}

TEST(RayleighShaft, SolvesTheSpinningBeamsEquation) {
  const double kDifferences = 1e-6;  // of the finite differences at a 200th of a half wave
  for (const int n : {1, 2, 5}) {
    for (const double speed : {0.0, 500.0, 2e4}) {
      EXPECT_LT(beam_residual(kHollow, n, speed, kHollow.forward(n, speed)), kDifferences);
      EXPECT_LT(beam_residual(kHollow, n, speed, kHollow.backward(n, speed)), kDifferences);
    }
    // The check can fail: backward and forward are distinguished.
    EXPECT_GT(beam_residual(kHollow, n, 2e4, -kHollow.backward(n, 2e4)), 10 * kDifferences);
  }
}

TEST(RayleighShaft, ForwardRisesAndBackwardFalls) {
  EXPECT_GT(kHollow.forward(1, 500.0), kHollow.forward(1, 0.0));
  EXPECT_LT(std::abs(kHollow.backward(1, 500.0)), kHollow.forward(1, 0.0));
  EXPECT_LT(kHollow.backward(1, 500.0), 0.0);
  EXPECT_DOUBLE_EQ(kHollow.backward(1, 0.0), -kHollow.forward(1, 0.0));
}

TEST(RayleighShaft, CriticalSpeedIsSynchronous) {
  for (const int n : {1, 2, 3}) {
    const double critical = kHollow.critical_speed(n);
    ASSERT_GT(critical, 0.0);
    EXPECT_NEAR(kHollow.forward(n, critical), critical, 1e-12 * critical);
  }
  // Slender waves no more: forward whirl outruns the shaft for ever.
  const RayleighShaft stout{0.3, 0.2, 0.0, 2.1e11, 7850.0};
  EXPECT_EQ(stout.critical_speed(2), 0.0);
  for (const double speed : {1e3, 1e5, 1e7}) EXPECT_GT(stout.forward(2, speed), speed);
}

TEST(RayleighShaft, ModalMassIsTheIntegral) {
  const int parts = 2000;
  double sum = 0.0;
  const double wave = 2 * std::numbers::pi / kHollow.length;
  for (int k = 0; k < parts; ++k) {
    const double z = (k + 0.5) * kHollow.length / parts;
    sum += kHollow.rho * (kHollow.area() * std::pow(std::sin(wave * z), 2) +
                          kHollow.inertia() * std::pow(wave * std::cos(wave * z), 2));
  }
  EXPECT_NEAR(kHollow.modal_mass(2), sum * kHollow.length / parts, 1e-9 * kHollow.modal_mass(2));
}

TEST(FriswellRotor, DiscsAreTheVolumeIntegrals) {
  const scene::RotorGeometry rotor = friswell_rotor();
  const double outer[] = {0.14, 0.175};
  for (std::size_t i = 0; i < 2; ++i) {
    // Rings from the bore to the rim: mass, r^2 dm, and (r^2 / 2 + t^2 / 12) dm.
    double mass = 0.0, polar = 0.0, transverse = 0.0;
    const int parts = 20000;
    const double width = (outer[i] - 0.025) / parts, thickness = 0.07;
    for (int k = 0; k < parts; ++k) {
      const double r = 0.025 + (k + 0.5) * width;
      const double dm = rotor.rho * 2.0 * std::numbers::pi * r * width * thickness;
      mass += dm;
      polar += r * r * dm;
      transverse += (0.5 * r * r + thickness * thickness / 12.0) * dm;
    }
    EXPECT_NEAR(rotor.discs[i].mass, mass, 1e-7 * mass);
    EXPECT_NEAR(rotor.discs[i].Jp, polar, 1e-7 * polar);
    EXPECT_NEAR(rotor.discs[i].Jt, transverse, 1e-7 * transverse);
  }
}

}  // namespace
}  // namespace rotorub::oracle
