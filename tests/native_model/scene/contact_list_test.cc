// [[contact]]: several auxiliary bearings in one scene.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/scene/scene_samples.h"
#include "tests/support/said.h"

namespace rotorub::scene {
namespace {

constexpr const char* kTwo = R"([rotor.modal]
mass = [2.0, 1.2]
stiffness = [0.0, 0.0]
[[contact]]
name = "drive end"
radius = 0.02
clearance = "0.2 mm"
friction = 0.1
restitution = 0.6
[contact.stator]
mass = 0.5
stiffness = 1e5
position = ["10 um", 0]
velocity = [0, 0.1]
[contact.stator.spin]
inertia = 1e-4
[contact.actuator]
force_limit = 50.0
[[contact]]
radius = 0.03
clearance = 3e-4
friction = 0.2
restitution = 0.4
shape = [1.0, -0.8]
offset = [1e-5, 0]
)";

Scene two_with(const std::vector<std::string>& overrides) {
  return parse_scene(kTwo, "s.toml", overrides);
}

TEST(ContactList, ReadsEachWithItsOwnRing) {
  const Scene s = two_with({});
  ASSERT_EQ(s.auxiliary.size(), 2u);
  EXPECT_EQ(s.name_of(0), "drive end");
  EXPECT_EQ(s.name_of(1), "2");
  EXPECT_EQ(s.auxiliary[0].contact->clearance, 0.2e-3);
  EXPECT_EQ(s.auxiliary[0].stator->position, Eigen::Vector2d(1e-5, 0.0));
  EXPECT_EQ(s.auxiliary[0].stator->velocity, Eigen::Vector2d(0.0, 0.1));
  EXPECT_EQ(s.auxiliary[0].stator->spin->inertia, 1e-4);
  EXPECT_EQ(s.auxiliary[0].actuator->force_limit, 50.0);
  EXPECT_FALSE(s.auxiliary[1].stator);
  EXPECT_EQ(s.auxiliary[1].contact->shape, (std::vector<double>{1.0, -0.8}));
  EXPECT_EQ(s.auxiliary[1].contact->offset.x(), 1e-5);
}

TEST(ContactList, AKeyWithoutANumberIsThatOfAll) {
  const Scene all =
      two_with({"contact.friction=0.3", "contact[1].restitution=0.1", "contact[0].stator.mass=2"});
  EXPECT_EQ(all.auxiliary[0].contact->friction.coefficient, 0.3);
  EXPECT_EQ(all.auxiliary[1].contact->friction.coefficient, 0.3);
  EXPECT_EQ(all.auxiliary[0].contact->restitution, 0.6);
  EXPECT_EQ(all.auxiliary[1].contact->restitution, 0.1);
  EXPECT_EQ(all.auxiliary[0].stator->mass, PlanePair(2.0, 2.0));
  // The changed text reads back to the same values.
  EXPECT_EQ(parse_scene(all.text, "s.toml").auxiliary[1].contact->shape,
            all.auxiliary[1].contact->shape);
}

TEST(ContactList, AListOfOneIsTheTableAlone) {
  const Scene one = two_with({"contact[1]=none"});
  ASSERT_EQ(one.auxiliary.size(), 1u);
  EXPECT_EQ(one.first().stator->mass, PlanePair(0.5, 0.5));
}

TEST(ContactList, TheSmallestClearanceIsThatOfAnyContact) {
  Scene s = two_with({});
  EXPECT_EQ(smallest_clearance(s), 0.2e-3);
  std::swap(s.auxiliary[0], s.auxiliary[1]);
  EXPECT_EQ(smallest_clearance(s), 0.2e-3);
  EXPECT_FALSE(smallest_clearance(Scene{}).has_value());
}

TEST(ContactList, IsRefusedWithTheElementsPath) {
  const std::string two = kTwo;
  std::string nine = "[rotor.modal]\nmass = [2.0]\nstiffness = [0.0]\n";
  for (int k = 0; k < 9; ++k) {
    nine += "[[contact]]\nradius = 0.02\nclearance = 2e-4\nfriction = 0.1\nrestitution = 0.6\n";
  }
  expect_refused({
      {"another's name",
       test::replaced(two, "radius = 0.03", "name = \"drive end\"\nradius = 0.03"), 20,
       "contact[1].name", "is the name of contact[0] too"},
      {"a number is a name", test::replaced(two, "\"drive end\"", "\"2\""), 19, "contact[1].name",
       "is the name of contact[0] too"},
      {"the ring beside the list", two + "[stator]\nmass = 1\nstiffness = 1\n", 26, "stator",
       "as [contact.stator]"},
      {"a key's value", test::replaced(two, "clearance = 3e-4", "clearance = 0"), 21,
       "contact[1].clearance", "> 0"},
      {"modes of the first",
       test::replaced(two, "restitution = 0.6", "restitution = 0.6\nshape = [1, 2]"), 10,
       "contact[0].shape", "scaled to 1 at the first contact"},
      {"length of a shape", test::replaced(two, "[1.0, -0.8]", "[1.0]"), 24, "contact[1].shape",
       "expected 2 value(s)"},
      {"an impact that takes time", two + "expansion_time = 1e-4\n", 26,
       "contact[1].expansion_time", "only with a single contact"},
      {"a controller without a ring", two + "[contact.controller]\nkind = \"pd\"\n", 26,
       "contact[1].controller", "needs [stator]"},
      {"a table of another kind",
       two + "[contact.stator]\nmass = 1\nstiffness = 1\n[contact.controller]\nkind = "
             "\"pd\"\nstiffness = 1\ndamping = 1\n[contact.controller.config]\na = 1\n",
       33, "contact[1].controller.config", "belongs to kind"},
      {"a start beside the list", two + "[initial]\nstator = [0, 0]\n", 27, "initial.stator",
       "position and velocity in each [contact.stator]"},
      {"position of the only ring",
       "[rotor.modal]\nmass = [2.0]\nstiffness = [0.0]\n[stator]\nmass = 1\nstiffness = "
       "1\nposition = [0, 0]\n",
       7, "stator.position", "initial.stator"},
      {"too many", nine, 4, "contact", "at most 8"},
  });
}

// ---------------------------------------------------------------- friction
// [contact.friction]: a table in the place of the number.

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
