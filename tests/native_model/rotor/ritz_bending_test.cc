#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "native_model/rotor/ritz_bending.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/rotor/shaft_basis.h"
#include "native_model/scene/diagnostic.h"
#include "tests/native_model/rotor/rotors.h"
#include "tests/support/native_run.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using test::kBeam;
using test::kShaft;
using test::pinned_shaft;
using test::scene_of;

constexpr double kMesh = 1e-10;  // relative: what the mesh is made for, with the pins' own error

// The shaft in equal elements, each with so many functions.
std::vector<ShaftElement> equal_elements(const scene::RotorGeometry& g, int count, int functions) {
  std::vector<ShaftElement> mesh;
  const ShaftElement whole = shaft_mesh(g, {}, [](const ShaftElement&) { return 0.0; }).front();
  for (int i = 0; i < count; ++i) {
    ShaftElement element = whole;
    element.from = g.length * i / count;
    element.to = g.length * (i + 1) / count;
    element.functions = functions;
    mesh.push_back(element);
  }
  return mesh;
}

double frequency_error(int elements, int functions, int mode) {
  const scene::RotorGeometry g = pinned_shaft(1);
  const RitzBending ritz = ritz_bending(g, equal_elements(g, elements, functions));
  const PlanarModes modes = planar_modes(ritz.mass, ritz.stiffness_x);
  return modes.frequency[mode - 1] / kShaft.forward(mode, 0.0) - 1.0;
}

// A Hermite cubic element has a linear curvature: its frequencies err by (k h)^4 / 1440.
TEST(RitzBending, HermiteCubicsConvergeWithFourthOrder) {
  for (int mode : {1, 3}) {
    double last = frequency_error(8, 2, mode);
    for (int elements : {16, 32}) {
      const double error = frequency_error(elements, 2, mode);
      EXPECT_GT(error, 0.0);
      EXPECT_NEAR(std::log2(last / error), 4.0, 0.15) << elements << " elements, mode " << mode;
      last = error;
    }
  }
}

TEST(RotorModes, RayleighShaftAtRest) {
  constexpr int kModes = 20;
  oracle::RayleighShaft tube = kShaft;
  tube.inner_diameter = 0.04;
  for (const oracle::RayleighShaft& shaft : {kShaft, tube}) {
    const RotorModes modes = rotor_modes(scene_of(pinned_shaft(kModes, shaft)));
    for (int n = 1; n <= kModes; ++n) {
      EXPECT_NEAR(modes.x.frequency[n - 1] / shaft.forward(n, 0.0), 1.0, kMesh * n) << n;
    }
  }
}

TEST(RotorModes, FriswellRotorAtRest) {
  const RotorModes modes = rotor_modes(scene_of(oracle::friswell_rotor()));
  for (std::size_t n = 0; n < oracle::kFriswellAtRest.size(); ++n) {
    // To the digits printed.
    EXPECT_NEAR(modes.x.frequency[static_cast<Eigen::Index>(n)], oracle::kFriswellAtRest[n], 5e-4);
  }
}

// The mesh does not affect the result: cuts without effect, however short, and more modes than
// requested give the same low frequencies.
TEST(RotorModes, DoNotDependOnTheMesh) {
  scene::Scene plain = test::reference_rig();
  const RotorModes expected = rotor_modes(plain);

  scene::Scene cut = plain;
  cut.rotor.geometry->sections = {{.from = 0.0, .to = 0.1, .diameter = 0.018},
                                  {.from = 0.1, .to = 0.1 + 1e-7, .diameter = 0.018},
                                  {.from = 0.1 + 1e-7, .to = 0.6, .diameter = 0.018}};
  scene::Scene rich = plain;
  rich.rotor.geometry->modes = 12;
  for (const scene::Scene& other : {cut, rich}) {
    const RotorModes modes = rotor_modes(other);
    for (int n = 0; n < 3; ++n) {
      EXPECT_NEAR(modes.x.frequency[n] / expected.x.frequency[n], 1.0, kMesh) << n;
    }
  }
}

// A shaft in three pieces against Hermite cubics refined until they agree with themselves: the same
// physics by another space.
TEST(RotorModes, SteppedShaftWithOverhang) {
  scene::RotorGeometry g = pinned_shaft(4);
  g.sections = {{.from = 0.0, .to = 0.25, .diameter = 0.03},
                {.from = 0.25, .to = 0.5, .diameter = 0.06, .inner_diameter = 0.02},
                {.from = 0.5, .to = 1.0, .diameter = 0.04}};
  g.bearings = {{.z = 0.25, .stiffness = {1e8, 1e8}}, {.z = 0.75, .stiffness = {5e7, 5e7}}};
  g.discs = {{.z = 1.0, .mass = 5.0, .Jt = 0.02, .Jp = 0.04}};
  const RotorModes modes = rotor_modes(scene_of(g));

  std::vector<ShaftElement> fine;
  for (const ShaftElement& part : bending_mesh(g, {}, 0.0)) {
    constexpr int kParts = 24;
    for (int i = 0; i < kParts; ++i) {
      ShaftElement element = part;
      element.from = part.from + part.length() * i / kParts;
      element.to = part.from + part.length() * (i + 1) / kParts;
      element.functions = 2;
      fine.push_back(element);
    }
  }
  const RitzBending cubic = ritz_bending(g, fine);
  const PlanarModes reference = planar_modes(cubic.mass, cubic.stiffness_x);
  for (int n = 0; n < 4; ++n) {
    const double difference = reference.frequency[n] / modes.x.frequency[n] - 1.0;
    EXPECT_GT(difference, -kMesh) << "the coarser space cannot be lower";
    EXPECT_LT(difference, kBeam) << n;
  }
}

TEST(RotorModes, MaxFrequencyKeepsEveryModeBelow) {
  scene::RotorGeometry g = pinned_shaft(1);
  g.modes.reset();
  for (int n : {1, 4, 9}) {
    g.max_frequency = kShaft.forward(n, 0.0) * (1.0 + 1e-6);
    EXPECT_EQ(rotor_modes(scene_of(g)).kept, n);
    g.max_frequency = kShaft.forward(n + 1, 0.0) * (1.0 - 1e-6);
    EXPECT_EQ(rotor_modes(scene_of(g)).kept, n);
  }
}

TEST(RotorModes, MaxFrequencyBelowTheFirstModeIsRefused) {
  scene::RotorGeometry g = pinned_shaft(1);
  g.modes.reset();
  g.max_frequency = 0.99 * kShaft.forward(1, 0.0);
  EXPECT_EQ(test::refusals([&] { rotor_modes(scene_of(g)); }).at(0).key, "rotor.max_frequency");
}

TEST(RotorModes, RigidMotionIsRefused) {
  for (int left : {0, 1}) {
    scene::RotorGeometry g = pinned_shaft(2);
    g.bearings.resize(static_cast<std::size_t>(left));
    EXPECT_THROW(rotor_modes(scene_of(g)), scene::SceneError) << left << " bearings";
  }
  // Two bearings at one place, and a plane that one of them leaves free.
  scene::RotorGeometry together = pinned_shaft(2);
  together.bearings[1].z = 0.0;
  EXPECT_THROW(rotor_modes(scene_of(together)), scene::SceneError);
  scene::RotorGeometry half = pinned_shaft(2);
  half.bearings[1].stiffness.y() = 0.0;
  EXPECT_THROW(rotor_modes(scene_of(half)), scene::SceneError);
}

TEST(RotorModes, AnAbsurdNumberOfModesIsRefused) {
  EXPECT_THROW(rotor_modes(scene_of(pinned_shaft(5000))), scene::SceneError);
}

constexpr double kRoundOff = 1e-14;  // a few units in the last place of values up to 2

TEST(GaussLegendre, IsExactUpToDegreeTwoNMinusOne) {
  for (int n = 1; n <= 20; ++n) {
    const GaussRule rule = gauss_legendre(n);
    for (int power = 0; power < 2 * n; ++power) {
      const double sum = (rule.weight.array() * rule.node.array().pow(power)).sum();
      EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, kRoundOff) << n << " " << power;
    }
  }
}

// Each row of integrals against quadrature of the row before.
TEST(IntegratedLegendre, IntegralsAgreeWithQuadrature) {
  constexpr int kCount = 14;
  const GaussRule rule = gauss_legendre(kCount);
  for (double xi : {-1.0, -0.7, 0.0, 0.4, 1.0}) {
    const LegendreValues v = integrated_legendre(kCount, xi);
    Eigen::VectorXd first = Eigen::VectorXd::Zero(kCount), second = first;
    for (int i = 0; i < rule.node.size(); ++i) {
      const double at = -1.0 + 0.5 * (xi + 1.0) * (rule.node[i] + 1.0);
      const LegendreValues inner = integrated_legendre(kCount, at);
      first += 0.5 * (xi + 1.0) * rule.weight[i] * inner.value;
      second += 0.5 * (xi + 1.0) * rule.weight[i] * inner.first;
    }
    EXPECT_LT((v.first - first).cwiseAbs().maxCoeff(), kRoundOff);
    EXPECT_LT((v.second - second).cwiseAbs().maxCoeff(), kRoundOff);
  }
}

// ---------------------------------------------------------------- known modes
// The modes of a shaft that was solved before equal those of a new solution.

// More shafts than the cache holds, so that any other is solved again.
void forget_modes() {
  for (int k = 0; k < 12; ++k) {
    rotor_modes(test::shipped("blade_loss", {"rotor.rho=" + std::to_string(7000 + k)}));
  }
}

void expect_equal(const PlanarModes& a, const PlanarModes& b) {
  EXPECT_EQ(a.frequency, b.frequency);
  EXPECT_EQ(a.shape, b.shape);
}
void expect_equal(const RotorModes& a, const RotorModes& b) {
  expect_equal(a.x, b.x);
  expect_equal(a.y, b.y);
  expect_equal(a.mean, b.mean);
  EXPECT_EQ(a.ritz.mass, b.ritz.mass);
  EXPECT_EQ(a.ritz.gyroscopic, b.ritz.gyroscopic);
  EXPECT_EQ(a.ritz.gravity, b.ritz.gravity);
  EXPECT_EQ(a.kept, b.kept);
  ASSERT_EQ(a.own.has_value(), b.own.has_value());
  if (a.own) expect_equal(a.own->mean, b.own->mean);
}

struct Change {
  std::string scene, set;
};
class KnownModes : public testing::TestWithParam<Change> {};

// A repeated request, also after another shaft that differs in one number, gives the same bits.
// Values that do not affect the modes do not affect the cache.
TEST_P(KnownModes, AreThoseOfAFreshSolution) {
  const auto& [name, set] = GetParam();
  const scene::Scene first = test::shipped(name), changed = test::shipped(name, {set});
  forget_modes();
  const RotorModes fresh = rotor_modes(first);
  expect_equal(rotor_modes(first), fresh);
  const RotorModes after = rotor_modes(changed);
  forget_modes();
  expect_equal(rotor_modes(changed), after);
  const bool same = after.x.frequency.size() == fresh.x.frequency.size() &&
                    after.x.frequency == fresh.x.frequency &&
                    after.ritz.gyroscopic == fresh.ritz.gyroscopic && after.kept == fresh.kept;
  EXPECT_EQ(same, set.find("damping") != std::string::npos);
}
INSTANTIATE_TEST_SUITE_P(
    Of, KnownModes,
    testing::Values(Change{"paper_passive", "rotor.E=200e9"},
                    Change{"paper_passive", "rotor.rho=7700"},
                    Change{"paper_passive", "rotor.modes=9"},
                    Change{"paper_passive", "rotor.section[0].diameter=0.021"},
                    Change{"paper_passive", "rotor.section[0].inner_diameter=0.002"},
                    Change{"paper_passive", "rotor.disc[0].mass=4.1"},
                    Change{"paper_passive", "rotor.disc[0].Jt=0.02"},
                    Change{"paper_passive", "rotor.disc[0].Jp=3.5e-3"},
                    Change{"paper_passive", "rotor.bearing[0].stiffness=3e7"},
                    Change{"paper_passive", "rotor.bearing[0].damping=11"},
                    Change{"paper_passive", "rotor.damping_ratio=0.011"},
                    Change{"amb_machine", "magnetic_bearing[0].control.proportional=21000"}));

}  // namespace
}  // namespace rotorub
