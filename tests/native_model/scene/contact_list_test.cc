// [[contact]]: several auxiliary bearings in one scene.

#include <gtest/gtest.h>

#include <utility>

#include "tests/native_model/scene/refusals.h"

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
  // What was changed is read again to the same.
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
      {"another's name", replaced(two, "radius = 0.03", "name = \"drive end\"\nradius = 0.03"), 20,
       "contact[1].name", "is the name of contact[0] too"},
      {"a number is a name", replaced(two, "\"drive end\"", "\"2\""), 19, "contact[1].name",
       "is the name of contact[0] too"},
      {"the ring beside the list", two + "[stator]\nmass = 1\nstiffness = 1\n", 26, "stator",
       "accepted: below each, as [contact.stator]"},
      {"a key's value", replaced(two, "clearance = 3e-4", "clearance = 0"), 21,
       "contact[1].clearance", "> 0"},
      {"modes of the first",
       replaced(two, "restitution = 0.6", "restitution = 0.6\nshape = [1, 2]"), 10,
       "contact[0].shape", "scaled to 1 at the first contact"},
      {"length of a shape", replaced(two, "[1.0, -0.8]", "[1.0]"), 24, "contact[1].shape",
       "expected 2 value(s)"},
      {"an impact that takes time", two + "expansion_time = 1e-4\n", 26,
       "contact[1].expansion_time", "known of one contact alone"},
      {"a controller without a ring", two + "[contact.controller]\nkind = \"pd\"\n", 26,
       "contact[1].controller", "needs [stator]"},
      {"a start outside the second ring",
       two + "[contact.stator]\nmass = 1\nstiffness = 1\nposition = [0, 1]\n", 29,
       "contact[1].stator.position", "outside the ring"},
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

}  // namespace
}  // namespace rotorub::scene
