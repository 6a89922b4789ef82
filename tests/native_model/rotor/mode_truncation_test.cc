// The modes that are not kept: the least number that satisfies the tolerance, against trying every
// number; and the effective mass of impacts.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <utility>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/prepare/prepare.h"
#include "native_model/rotor/mode_truncation.h"
#include "native_model/scene/diagnostic.h"
#include "tests/native_model/rotor/rotors.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

// The rig with a sleeve of `sleeve` kg at the contact, and a force at 0.42 m.
scene::Scene rig(double sleeve) {
  scene::Scene s = test::reference_rig();
  if (sleeve > 0.0) {
    s.rotor.geometry->discs.push_back(
        {.z = 0.24, .mass = sleeve, .Jt = 2e-4 * sleeve, .Jp = 3e-4 * sleeve});
  }
  s.forces.emplace_back();
  s.forces.back().station = 0.42;
  return s;
}

scene::Scene automatic(scene::Scene s, double tolerance) {
  s.rotor.geometry->modes.reset();
  s.rotor.geometry->auto_modes = true;
  s.rotor.geometry->modes_tolerance = tolerance;
  return s;
}

// Largest share by which n modes are off, of the mass that an impact meets and of what gives way
// under a load, each value from the matrices, none from modal sums.
double left_out(scene::Scene s, int n) {
  s.rotor.geometry->modes = n;
  const RotorModes modes = rotor_modes(s);
  double worst = 0.0;
  for (const double z : {0.24, 0.03, 0.57, 0.42}) {
    const Eigen::VectorXd u = modes.ritz.basis.deflection(z).transpose();
    double mobility = 0.0, flexibility = 0.0;
    for (int k = 0; k < n; ++k) {
      const Eigen::VectorXd phi = modes.x.shape.col(k);
      const double square = u.dot(phi) * u.dot(phi) / phi.dot(modes.ritz.mass * phi);
      mobility += square;
      flexibility += square / (modes.x.frequency[k] * modes.x.frequency[k]);
    }
    const double all = u.dot(Cholesky(modes.ritz.stiffness_x).solve(u));
    worst = std::max(worst, 1.0 - flexibility / all);
    if (z == 0.24)
      worst = std::max(worst, u.dot(Cholesky(modes.ritz.mass).solve(u)) / mobility - 1.0);
  }
  return worst;
}

TEST(AutoModes, IsTheLeastSufficientNumber) {
  for (const auto& [sleeve, tolerance] :
       std::vector<std::pair<double, double>>{{5.0, 0.02}, {2.0, 0.05}, {0.2, 0.5}}) {
    SCOPED_TRACE(sleeve);
    const int kept = rotor_modes(automatic(rig(sleeve), tolerance)).kept;
    int least = 1;
    while (left_out(rig(sleeve), least) > tolerance) ++least;
    EXPECT_EQ(kept, least);
    EXPECT_GT(kept, 1);
    EXPECT_EQ(prepare(automatic(rig(sleeve), tolerance)).layout.modes, kept);
  }
}

TEST(AutoModes, RefusesAStationWithoutMassAndSaysWhy) {
  EXPECT_TRUE(test::contains(
      test::message_of<scene::SceneError>([] { prepare(automatic(rig(0.0), 0.01)); }),
      {"rotor.modes", "up to 50", "effective mass at the contact", "sleeve",
       "Set a modes_tolerance well above"}));
}

// Only static flexibilities converge on any shaft.
TEST(AutoModes, NeedsNoSleeveWithoutAContact) {
  scene::Scene s = rig(0.0);
  s.first().contact.reset();
  const int one = rotor_modes(automatic(s, 0.01)).kept;
  const int tenth = rotor_modes(automatic(s, 0.001)).kept;
  EXPECT_GT(one, 1);
  EXPECT_GT(tenth, one);
  EXPECT_LT(tenth, kMostAutoModes);
}

// The rig with a sleeve of 5 kg at one contact and of 0.05 kg at the other. Each contact must have
// its effective mass, whichever comes first in the list.
TEST(AutoModes, CountEveryContactInAnyOrder) {
  scene::Scene s = rig(5.0);
  s.rotor.geometry->discs.push_back({.z = 0.42, .mass = 0.05, .Jt = 1e-5, .Jp = 1.5e-5});
  const int heavy = rotor_modes(automatic(s, 0.5)).kept;
  s.auxiliary.push_back(s.first());
  s.auxiliary[1].contact->station = 0.42;
  const int both = rotor_modes(automatic(s, 0.5)).kept;
  std::swap(s.auxiliary[0], s.auxiliary[1]);
  EXPECT_EQ(rotor_modes(automatic(s, 0.5)).kept, both);
  EXPECT_GT(both, heavy) << "the light sleeve needs more modes";
}

TEST(AutoModes, NameTheContactWithoutAMass) {
  scene::Scene s = rig(5.0);
  s.auxiliary.push_back(s.first());
  s.auxiliary[1].name = "free end";
  s.auxiliary[1].contact->station = 0.42;
  const auto refused = [&] {
    return test::message_of<scene::SceneError>([&] { prepare(automatic(s, 0.01)); });
  };
  EXPECT_TRUE(test::contains(refused(), {"effective mass at contact free end", "sleeve"}));
  std::swap(s.auxiliary[0], s.auxiliary[1]);
  EXPECT_TRUE(test::contains(refused(), {"effective mass at contact free end", "sleeve"}));
}

// The effective mass at the contact: known for a shaft that is all sleeve, and falling with the
// modes.
TEST(ContactMass, FallsWithTheModesWithoutASleeve) {
  double last = 1e9;
  for (const char* modes : {"rotor.modes=1", "rotor.modes=2", "rotor.modes=8", "rotor.modes=20"}) {
    const ContactMass mass = contact_mass(test::shipped("paper_passive", {modes})).value();
    EXPECT_LT(mass.kept, 0.9 * last) << modes;
    EXPECT_LT(mass.mesh, mass.kept) << "all modes are softer";
    EXPECT_GT(mass.mesh, 0.0);
    last = mass.kept;
  }
  EXPECT_TRUE(contact_mass(test::shipped("paper_passive", {"rotor.modes=2"}))->truncated());
}

// Impacts meet a sleeve of 50 kg, whatever the modes, once one of them is that of the sleeve.
TEST(ContactMass, OfAHeavySleeveIsTheSleeve) {
  const scene::Scene scene =
      test::shipped("paper_passive",
                    {"rotor.disc[1]={z=0.24,mass=50.0,Jt=1e-2,Jp=2e-2,eccentricity=0.0,phase=0.0}",
                     "rotor.modes=12"});
  const ContactMass mass = contact_mass(scene).value();
  EXPECT_NEAR(mass.mesh, 50.0, 1.0);
  EXPECT_NEAR(mass.kept, mass.mesh, 0.02 * mass.mesh);
  EXPECT_FALSE(mass.truncated());
}

// A heavy sleeve at one contact, none at the other: impacts at the latter depend on the modes.
TEST(ContactMass, IsThatOfTheContactWhoseImpactsLeaveOutMost) {
  scene::Scene s = rig(50.0);
  s.rotor.geometry->modes = 12;
  ASSERT_FALSE(contact_mass(s)->truncated());
  s.auxiliary.push_back(s.first());
  s.auxiliary[1].contact->station = 0.42;
  const ContactMass mass = contact_mass(s).value();
  EXPECT_TRUE(mass.truncated());
  std::swap(s.auxiliary[0], s.auxiliary[1]);
  const ContactMass swapped = contact_mass(s).value();
  EXPECT_NEAR(swapped.kept, mass.kept, 1e-9 * mass.kept);
  EXPECT_NEAR(swapped.mesh, mass.mesh, 1e-9 * mass.mesh);
}

TEST(ContactMass, IsUnknownForModalData) {
  EXPECT_FALSE(contact_mass(test::shipped("bench_ring")));
}

}  // namespace
}  // namespace rotorub
