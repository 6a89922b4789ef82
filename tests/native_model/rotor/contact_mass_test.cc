// The effective mass at the contact: known for a shaft that is all sleeve, and falling with the
// modes.
#include <gtest/gtest.h>

#include "native_model/rotor/contact_mass.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

scene::Scene rig(const std::vector<std::string>& overrides = {}) {
  return scene::read_scene(std::string(ROTORUB_SOURCE_DIR) + "/mjcf/paper_passive.toml", overrides);
}

ContactMass of(const scene::Scene& scene) { return contact_mass(scene).value(); }

TEST(ContactMass, FallsWithTheModesWithoutASleeve) {
  double last = 1e9;
  for (const char* modes : {"rotor.modes=1", "rotor.modes=2", "rotor.modes=8", "rotor.modes=20"}) {
    const ContactMass mass = of(rig({modes}));
    EXPECT_LT(mass.kept, 0.9 * last) << modes;
    EXPECT_LT(mass.mesh, mass.kept) << "all modes are softer";
    EXPECT_GT(mass.mesh, 0.0);
    last = mass.kept;
  }
  EXPECT_TRUE(of(rig({"rotor.modes=2"})).truncated());
}

// A sleeve of 50 kg is what an impact meets, whatever the modes, once one of them is its own.
TEST(ContactMass, OfAHeavySleeveIsTheSleeve) {
  const scene::Scene scene =
      rig({"rotor.disc[1]={z=0.24,mass=50.0,Jt=1e-2,Jp=2e-2,eccentricity=0.0,phase=0.0}",
           "rotor.modes=12"});
  const ContactMass mass = of(scene);
  EXPECT_NEAR(mass.mesh, 50.0, 1.0);
  EXPECT_NEAR(mass.kept, mass.mesh, 0.02 * mass.mesh);
  EXPECT_FALSE(mass.truncated());
}

TEST(ContactMass, IsNotAskedOfModalData) {
  EXPECT_FALSE(
      contact_mass(scene::read_scene(std::string(ROTORUB_SOURCE_DIR) + "/mjcf/bench_ring.toml"))
          .has_value());
}

}  // namespace
}  // namespace rotorub
