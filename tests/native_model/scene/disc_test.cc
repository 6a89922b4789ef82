// Discs described by dimensions, against their mass and inertia; and keys with two names.
#include "native_model/scene/disc.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/native_model/scene/scene_samples.h"

namespace rotorub::scene {
namespace {

Disc disc_of(const std::string& keys, const std::string& before = "speed = \"100 Hz\"\n") {
  std::string text(kGeometrySample);
  text.insert(text.find('\n') + 1, before);
  return parse_scene(text + "[[rotor.disc]]\n" + keys, "disc.toml").rotor.geometry->discs.front();
}

// A steel disc of 200 mm with a bore of 20 mm, 30 mm wide.
TEST(DiscWords, DimensionsGiveMassAndInertia) {
  const Disc disc = disc_of(
      "station = 0.3\ndiameter = \"200 mm\"\ninner_diameter = \"20 mm\"\nthickness = \"30 mm\"\n");
  const double mass = 7850.0 * std::numbers::pi * (0.1 * 0.1 - 0.01 * 0.01) * 0.03;
  EXPECT_EQ(disc.z, 0.3);
  EXPECT_NEAR(disc.mass, mass, 1e-14);
  EXPECT_NEAR(disc.Jp, 0.5 * mass * (0.1 * 0.1 + 0.01 * 0.01), 1e-15);
  EXPECT_NEAR(disc.Jt, mass / 12.0 * (3.0 * (0.1 * 0.1 + 0.01 * 0.01) + 0.03 * 0.03), 1e-15);
  const Disc light = disc_of("z = 0.3\ndiameter = 0.2\nthickness = 0.03\nrho = \"2.7 g/cm^3\"\n");
  EXPECT_NEAR(light.mass, 2700.0 * std::numbers::pi * 0.01 * 0.03, 1e-14);
}

TEST(DiscWords, UnbalanceIsMassTimesEccentricity) {
  const Disc disc = disc_of("z = 0.3\nmass = 2.0\nJt = 1e-3\nJp = 2e-3\nunbalance = \"72 g mm\"\n");
  EXPECT_NEAR(disc.eccentricity, 36e-6, 1e-20);
  const Disc solid =
      disc_of("z = 0.3\ndiameter = 0.2\nthickness = 0.03\nunbalance = \"72 g mm\"\n");
  EXPECT_NEAR(solid.eccentricity * solid.mass, 72e-6, 1e-19);
}

// ISO 21940-11, figure 2: G 6.3 at 3000 1/min is 20 um.
TEST(DiscWords, GradeIsEccentricityTimesSpeed) {
  const std::string numbers = "z = 0.3\nmass = 2.0\nJt = 1e-3\nJp = 2e-3\n";
  EXPECT_NEAR(
      disc_of(numbers + "balance_grade = \"G 6.3\"\nbalance_speed = \"3000 rpm\"\n").eccentricity,
      6.3e-3 / (100.0 * std::numbers::pi), 1e-18);
  EXPECT_NEAR(disc_of(numbers + "balance_grade = \"G2.5\"\n").eccentricity,
              2.5e-3 / (200.0 * std::numbers::pi), 1e-18);
  EXPECT_EQ(balance_quality("G 0.4"), 0.4 / 1000.0);
  for (const char* no : {"", "G", "2.5", "G -1", "G 0", "G 2.5 mm/s", "g 2.5", "G inf", "G nan"}) {
    EXPECT_FALSE(balance_quality(no)) << no;
  }
}

TEST(DiscWords, ContradictionsAreRefused) {
  const std::string sample(kGeometrySample), disc = sample + "[[rotor.disc]]\nz = 0.3\n";
  const std::string numbers = disc + "mass = 2.0\nJt = 1e-3\nJp = 2e-3\n";
  expect_refused({
      {"no mass", disc + "Jt = 1e-3\nJp = 2e-3\n", 10, "rotor.disc[0].mass",
       "or give the disc's `diameter` and `thickness`"},
      {"one number of three", disc + "mass = 2.0\nJt = 1e-3\n", 10, "rotor.disc[0].Jp", "missing"},
      {"both", disc + "mass = 2.0\ndiameter = 0.2\nthickness = 0.03\n", 12, "rotor.disc[0].mass",
       "follows from"},
      {"no thickness", disc + "diameter = 0.2\n", 10, "rotor.disc[0].thickness", "missing"},
      {"bore", disc + "diameter = 0.2\ninner_diameter = 0.2\nthickness = 0.1\n", 13,
       "rotor.disc[0].inner_diameter", "must be below"},
      {"density of nothing", numbers + "rho = 7850\n", 15, "rotor.disc[0].rho",
       "belongs to a disc with"},
      {"two words", numbers + "eccentricity = 1e-5\nunbalance = \"1 g mm\"\n", 16,
       "rotor.disc[0].unbalance", "remove one of them"},
      {"no grade", numbers + "balance_grade = \"2.5\"\nbalance_speed = 100\n", 15,
       "rotor.disc[0].balance_grade", "as \"G 2.5\""},
      {"no speed", numbers + "balance_grade = \"G 2.5\"\n", 15, "rotor.disc[0].balance_grade",
       "give `balance_speed`"},
      {"speed of nothing", numbers + "balance_speed = 100\n", 15, "rotor.disc[0].balance_speed",
       "belongs to"},
      {"unbalance of nothing", disc + "mass = 0\nJt = 1e-3\nJp = 2e-3\nunbalance = 1e-5\n", 15,
       "rotor.disc[0].unbalance", "needs a mass"},
  });
}

TEST(TwoNames, AreOneKey) {
  const std::string sample(kGeometrySample);
  const std::string contact =
      "[contact]\nradius = 0.02\nclearance = 1e-3\nfriction = 0\nrestitution = 0\n";
  EXPECT_EQ(parse_scene(sample + contact + "z = 0.3\n", "a.toml").first().contact->station, 0.3);
  const std::vector<std::string> moved{"contact.station=0.4"}, back{"contact.z=0.2"};
  EXPECT_EQ(parse_scene(sample + contact + "z = 0.3\n", "a.toml", moved).first().contact->station,
            0.4);
  EXPECT_EQ(
      parse_scene(sample + contact + "station = 0.3\n", "a.toml", back).first().contact->station,
      0.2);
  expect_refused({
      {"both", sample + contact + "z = 0.3\nstation = 0.3\n", 15, "contact.z",
       "another name of `station`"},
      {"by the name that is written", sample + contact + "z = 0.7\n", 15, "contact.z",
       "not on the shaft"},
      {"by the other name", sample + contact + "station = 0.7\n", 15, "contact.station",
       "not on the shaft"},
      {"not a number", sample + "[[rotor.bearing]]\nstation = \"here\"\nstiffness = 1e6\n", 11,
       "rotor.bearing[0].station", "here"},
  });
}

}  // namespace
}  // namespace rotorub::scene
