// [contact.friction]: a table in the place of the number.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/support/said.h"

namespace rotorub::scene {
namespace {

constexpr const char* kHead = R"(
[rotor]
speed = 10.0
[rotor.modal]
mass = [2.0]
stiffness = [1e4]
damping = [0.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
restitution = 0.0
)";

FrictionLaw law_of(const std::string& contact, const std::vector<std::string>& overrides = {}) {
  return parse_scene(kHead + contact, "scene.toml", overrides).first().contact->friction;
}

constexpr const char* kInline =
    "friction = { static = 0.3, kinetic = 0.15, stribeck_speed = \"100 mm/s\", viscous = 0.02 }";

TEST(FrictionOfAScene, IsANumberOrATable) {
  EXPECT_TRUE(law_of("friction = 0.3").is_constant());
  for (const char* text :
       {kInline,
        "[contact.friction]\nstatic = \"30 %\"\nkinetic = 0.15\nstribeck_speed = 0.1\n"
        "viscous = \"0.02 s/m\""}) {
    const FrictionLaw law = law_of(text);
    EXPECT_DOUBLE_EQ(law.sticking(), 0.3);
    EXPECT_EQ(law.coefficient, 0.15);
    EXPECT_DOUBLE_EQ(law.stribeck_speed, 0.1);
    EXPECT_EQ(law.viscous, 0.02);
  }
  EXPECT_TRUE(law_of("friction = { static = 0.2, kinetic = 0.2 }").is_constant());
}

TEST(FrictionOfAScene, RefusesWhatIsNoLaw) {
  const auto says = [](const std::string& text, const char* part) {
    EXPECT_TRUE(test::contains(test::message_of<SceneError>([&] { law_of(text); }), part)) << text;
  };
  says("friction = { static = 0.1, kinetic = 0.15, stribeck_speed = 0.1 }",
       "scene.toml:12: contact.friction.static: is below contact.friction.kinetic = 0.15");
  says("friction = { static = 0.3, kinetic = 0.15 }", "contact.friction.stribeck_speed: missing");
  says("friction = { static = 0.3, kinetic = 0.15, stribeck_speed = 0.0 }", "out of range");
  says("friction = { static = 0.3, kinetic = 0.15, stribeck_speed = 0.1, viscous = -1.0 }",
       "contact.friction.viscous: out of range");
  says("friction = { static = 0.3, stribeck_speed = 0.1 }", "contact.friction.kinetic: missing");
  says("friction = { statik = 0.3, kinetic = 0.3 }", "did you mean `static`?");
  says("friction = [0.3, 0.1]", "contact.friction: expected a pure number");
}

TEST(FrictionOfAScene, IsOverriddenKeyByKey) {
  EXPECT_DOUBLE_EQ(law_of(kInline, {"contact.friction.static=0.4"}).sticking(), 0.4);
  EXPECT_EQ(law_of(kInline, {"contact.friction=0.1"}), FrictionLaw(0.1));
  // A number until then is the same at every slip.
  const FrictionLaw law = law_of(
      "friction = 0.3", {"contact.friction.kinetic=0.1", "contact.friction.stribeck_speed=0.2"});
  EXPECT_DOUBLE_EQ(law.sticking(), 0.3);
  EXPECT_EQ(law.coefficient, 0.1);
  const FrictionLaw braked = law_of("friction = 0.3", {"contact.friction.viscous=0.01"});
  EXPECT_EQ(braked.excess, 0.0);
  EXPECT_EQ(braked.viscous, 0.01);
}

TEST(FrictionOfAScene, OfEachOfSeveralContacts) {
  const std::string text = R"(
[rotor]
speed = 10.0
[rotor.modal]
mass = [2.0]
stiffness = [1e4]
damping = [0.0]
[[contact]]
radius = 0.05
clearance = "0.5 mm"
restitution = 0.0
friction = { static = 0.3, kinetic = 0.15, stribeck_speed = 0.1 }
[[contact]]
radius = 0.05
clearance = "0.5 mm"
restitution = 0.0
friction = 0.2
shape = [0.8]
)";
  const Scene read = parse_scene(text, "two.toml");
  EXPECT_EQ(read.auxiliary[0].contact->friction.stribeck_speed, 0.1);
  EXPECT_EQ(read.auxiliary[1].contact->friction, FrictionLaw(0.2));
  const Scene both =
      parse_scene(text, "two.toml", std::vector<std::string>{"contact.friction.viscous=0.01"});
  for (const AuxiliaryBearing& at : both.auxiliary) EXPECT_EQ(at.contact->friction.viscous, 0.01);
  // Written back and read again.
  EXPECT_EQ(parse_scene(both.text, "again.toml").auxiliary[0].contact->friction,
            both.auxiliary[0].contact->friction);
  const std::vector<std::string> below_kinetic{"contact[1].friction.static=0.1"};
  EXPECT_TRUE(test::contains(
      test::message_of<SceneError>([&] { parse_scene(text, "two.toml", below_kinetic); }),
      "contact[1].friction.static"));
}

}  // namespace
}  // namespace rotorub::scene
