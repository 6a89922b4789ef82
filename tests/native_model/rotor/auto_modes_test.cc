// As few modes as the tolerance allows, against trying every number.
#include "native_model/rotor/auto_modes.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/system/model.h"
#include "tests/native_model/rotor/rotors.h"

namespace rotorub {
namespace {

// The rig with a sleeve of so many kg at the contact, and a force at 0.42 m.
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
    const double all = u.dot(modes.ritz.stiffness_x.llt().solve(u));
    worst = std::max(worst, 1.0 - flexibility / all);
    if (z == 0.24) worst = std::max(worst, u.dot(modes.ritz.mass.llt().solve(u)) / mobility - 1.0);
  }
  return worst;
}

TEST(AutoModes, IsTheLeastNumberThatDoes) {
  for (const auto& [sleeve, tolerance] :
       std::vector<std::pair<double, double>>{{5.0, 0.02}, {2.0, 0.05}, {0.2, 0.5}}) {
    SCOPED_TRACE(sleeve);
    const int kept = rotor_modes(automatic(rig(sleeve), tolerance)).kept;
    int least = 1;
    while (left_out(rig(sleeve), least) > tolerance) ++least;
    EXPECT_EQ(kept, least);
    EXPECT_GT(kept, 1);
    EXPECT_EQ(make_model(automatic(rig(sleeve), tolerance)).layout.modes, kept);
  }
}

TEST(AutoModes, RefusesAStationWithoutMassAndSaysWhy) {
  try {
    make_model(automatic(rig(0.0), 0.01));
    FAIL() << "accepted";
  } catch (const scene::SceneError& error) {
    const std::string text = error.what();
    for (const char* part : {"rotor.modes", "up to 50", "effective mass at the contact", "sleeve",
                             "Accepted: a modes_tolerance well above"}) {
      EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
    }
  }
}

// Static flexibilities alone have a limit on any shaft.
TEST(AutoModes, NeedsNoSleeveWithoutAContact) {
  scene::Scene s = rig(0.0);
  s.first().contact.reset();
  const int one = rotor_modes(automatic(s, 0.01)).kept;
  const int tenth = rotor_modes(automatic(s, 0.001)).kept;
  EXPECT_GT(one, 1);
  EXPECT_GT(tenth, one);
  EXPECT_LT(tenth, kMostAutoModes);
}

}  // namespace
}  // namespace rotorub
