// The modes of a shaft that was solved before are those of a fresh solution.
#include "native_model/rotor/rotor_modes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/native_run.h"

namespace rotorub {
namespace {

// More shafts than are remembered: afterwards any other is solved anew.
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

// Asked for again, and after another shaft that differs in one number: to the bit, as from the
// start. What the modes do not depend on changes nothing.
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
