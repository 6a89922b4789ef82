// Cones: against many short cylinders, and the closed form of their torsion.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "native_model/rotor/modal_rotor.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

constexpr double kLength = 1.0, kE = 2.1e11, kRho = 7850.0, kTip = 0.02;  // m, Pa, kg/m^3, m

scene::Scene shaft(const std::string& sections, const std::string& more = {},
                   const std::string& theory = "euler-bernoulli") {
  return scene::parse_scene("[rotor]\ntheory = \"" + theory +
                                "\"\nlength = 1.0\nE = 2.1e11\nnu = 0.3\nrho = 7850\nmodes = 4\n" +
                                sections +
                                "[[rotor.bearing]]\nz = 0.0\nstiffness = 1e8\n"
                                "[[rotor.bearing]]\nz = 1.0\nstiffness = 3e7\n" +
                                more,
                            "taper.toml");
}

std::string section(double from, double to, double first, double last, double bore = 0.0,
                    double last_bore = 0.0) {
  const auto line = [](const char* name, double value) {
    return std::string(name) + " = " + scene::number_text(value, 17) + "\n";
  };
  return "[[rotor.section]]\n" + line("from", from) + line("to", to) + line("diameter", first) +
         line("end_diameter", last) + line("inner_diameter", bore) +
         line("end_inner_diameter", last_bore);
}

Eigen::VectorXd frequencies(const scene::Scene& scene, int count) {
  return rotor_modes(scene).x.frequency.head(count);
}

// Midpoint cylinders: their error falls with the square of their number; extrapolated twice.
struct TheoryCase {
  const char* theory;
  double bore;       // m, at the end of the cone
  int pieces;        // of the coarsest shaft
  double tolerance;  // relative
};
class TaperOfTheory : public testing::TestWithParam<TheoryCase> {};

TEST_P(TaperOfTheory, IsTheLimitOfShortCylinders) {
  const std::string cone = section(0.0, 0.7, 0.06, 0.03, 0.01, GetParam().bore) +
                           section(0.7, 1.0, 0.03, 0.03, 0.0, 0.02);
  const Eigen::VectorXd exact = frequencies(shaft(cone, {}, GetParam().theory), 4);
  const auto steps = [](int count) {
    std::string text;
    for (int k = 0; k < count; ++k) {
      const double at = (k + 0.5) / count;
      const double o = 0.06 - 0.03 * at, i = 0.01 + (GetParam().bore - 0.01) * at;
      text += section(0.7 * k / count, 0.7 * (k + 1) / count, o, o, i, i);
      if (k + 1 < count) continue;
      for (int j = 0; j < count; ++j) {
        const double bore = 0.02 * (j + 0.5) / count;
        text += section(0.7 + 0.3 * j / count, 0.7 + 0.3 * (j + 1) / count, 0.03, 0.03, bore, bore);
      }
    }
    return frequencies(shaft(text, {}, GetParam().theory), 4);
  };
  const Eigen::VectorXd a = steps(GetParam().pieces), b = steps(2 * GetParam().pieces),
                        c = steps(4 * GetParam().pieces);
  const Eigen::VectorXd ab = (4.0 * b - a) / 3.0, bc = (4.0 * c - b) / 3.0,
                        limit = (16.0 * bc - ab) / 15.0;
  for (int k = 0; k < 4; ++k) {
    EXPECT_GT(std::abs(a[k] / exact[k] - 1.0), 1e-5) << k;
    EXPECT_NEAR(limit[k] / exact[k], 1.0, GetParam().tolerance) << k;  // a: up to 4e-3, c: 3e-4
  }
}

INSTANTIATE_TEST_SUITE_P(Both, TaperOfTheory,
                         testing::Values(TheoryCase{"euler-bernoulli", 0.025, 8, 1e-5},
                                         TheoryCase{"timoshenko", 0.012, 4, 3e-5}));

// Free torsion of a cone from d to 2 d: with psi = r theta' r... the polar moment goes with the
// fourth power of x = 1 + z / L, (x^4 theta')' + k^2 x^4 theta = 0, whose solutions are x^-3/2
// J_{3/2}(k x) and Y_{3/2}, in sines and cosines: theta = (A f + B g), f = (sin s - s cos s) / s^3,
// g = (cos s + s sin s) / s^3, s = k x.
TEST(Taper, TorsionOfACone) {
  const scene::Scene scene =
      shaft(section(0.0, 1.0, kTip, 2.0 * kTip),
            "[rotor.torsion]\nmodes = 2\n[drive]\nkind = \"free\"\nstation = 0.0\n");
  // theta' = 0 at x = 1 and 2: of f' ~ (3 s cos s + (s^2 - 3) sin s) / s^4, g' ~ (3 s sin s - (s^2
  // - 3) cos s) / s^4.
  const auto f = [](double s) { return 3.0 * s * std::cos(s) + (s * s - 3.0) * std::sin(s); };
  const auto g = [](double s) { return 3.0 * s * std::sin(s) - (s * s - 3.0) * std::cos(s); };
  const auto determinant = [&](double k) { return f(k) * g(2.0 * k) - f(2.0 * k) * g(k); };
  const double wave = std::sqrt(kE / 2.6 / kRho) / kLength;
  const TorsionModes modes = torsion_modes(scene);
  for (int n = 0; n < 2; ++n) {
    double low = (n + 0.7) * std::numbers::pi, high = (n + 1.5) * std::numbers::pi;
    ASSERT_LT(determinant(low) * determinant(high), 0.0);
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (determinant(low) * determinant(middle) <= 0.0 ? high : low) = middle;
    }
    EXPECT_NEAR(std::sqrt(modes.stiffness[n] / modes.inertia[n]) / (low * wave), 1.0, 1e-9) << n;
  }
  // rho pi / 32 int d^4 dz = rho pi / 32 d^4 L (2^5 - 1) / 5.
  EXPECT_NEAR(spin_inertia(scene), kRho * std::numbers::pi / 32.0 * std::pow(kTip, 4) * 31.0 / 5.0,
              1e-16);
}

}  // namespace
}  // namespace rotorub
