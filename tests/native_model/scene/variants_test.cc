#include "native_model/scene/reader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rotorub::scene {
namespace {

const std::string kRing = std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml";

TEST(Variants, AreWhatReadSceneGives) {
  const std::vector<std::string> all{"run.end=0.2"};
  const Variants variants(kRing, all);
  for (const std::string change :
       {"contact.friction=0.25", "contact.friction=1", "contact.friction=1e-1", "rotor.speed=20 Hz",
        "rotor.speed=-12.5", "force[0].amplitude=\"0.2 kN\"", "stator=none",
        "gravity={acceleration=[0,-9.81]}"}) {
    const std::vector<std::string> one{change}, both{all[0], change};
    const Scene made = variants.scene(one, true), read = read_scene(kRing, both);
    EXPECT_EQ(made.text, read.text) << change;
    EXPECT_EQ(made.name, read.name);
    EXPECT_EQ(made.rotor.speed, read.rotor.speed) << change;
    EXPECT_EQ(made.first().contact->friction.coefficient,
              read.first().contact->friction.coefficient)
        << change;
    EXPECT_EQ(made.first().stator.has_value(), read.first().stator.has_value()) << change;
  }
}

TEST(Variants, WithoutTextAreTheSameScene) {
  const std::vector<std::string> one{"contact.friction=0.25"};
  const Scene scene = Variants(kRing).scene(one, false);
  EXPECT_TRUE(scene.text.empty());
  EXPECT_EQ(scene.first().contact->friction.coefficient, 0.25);
}

TEST(Variants, EachIsRefusedByItself) {
  const Variants variants(kRing);
  const std::vector<std::string> bad{"contact.friction=-1"}, good{"contact.friction=0.5"};
  EXPECT_THROW(variants.scene(bad, false), SceneError);
  EXPECT_EQ(variants.scene(good, false).first().contact->friction.coefficient, 0.5);
}

// The short way for plain decimal numbers takes nothing but those.
TEST(Variants, NumbersAreThoseOfToml) {
  const Variants variants(kRing);
  for (const char* text : {".", "1.5.2", "1.5e", "--1.5", "1.5-2"}) {
    const std::vector<std::string> change{std::string("contact.friction=") + text};
    EXPECT_THROW(variants.scene(change, false), SceneError) << text;
  }
  for (const char* text : {"0.15", "1.5e-1", "1.5E-1", ".15", "+0.15", "0.1_5"}) {
    const std::vector<std::string> change{std::string("contact.friction=") + text};
    EXPECT_EQ(variants.scene(change, false).first().contact->friction.coefficient, 0.15) << text;
  }
}

}  // namespace
}  // namespace rotorub::scene
