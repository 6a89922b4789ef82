#include "native_model/scene/overrides.h"

#include <gtest/gtest.h>

#include <numbers>

#include "native_model/scene/reader.h"
#include "tests/native_model/scene/scene_samples.h"
#include "tests/support/refusal.h"

namespace rotorub::scene {
namespace {

Scene with(const std::vector<std::string>& overrides) {
  return parse_scene(kFullModalScene, "scene.toml", overrides);
}

std::vector<Diagnostic> override_refusal(const std::vector<std::string>& overrides) {
  return test::refusals([&] { with(overrides); });
}

TEST(Overrides, TakeTomlWordsAndUnits) {
  EXPECT_EQ(with({"contact.friction=0.3"}).first().contact->friction.coefficient, 0.3);
  EXPECT_EQ(with({" contact.friction = 0.3 "}).first().contact->friction.coefficient, 0.3);
  EXPECT_EQ(with({"contact.friction=30 %"}).first().contact->friction.coefficient, 0.3);
  EXPECT_EQ(with({"run.end=100ms"}).run.end, 0.1);
  EXPECT_EQ(with({"run.end=\"100 ms\"", "run.output_times=[]"}).run.output_times.size(), 0u);
  EXPECT_EQ(with({"rotor.speed=60 Hz"}).rotor.speed, 120.0 * std::numbers::pi);
  EXPECT_EQ(with({"run.integrator=verlet"}).run.integrator, Integrator::kVerlet);
  EXPECT_TRUE(with({"mujoco.shadow=true"}).mujoco.shadow);
  EXPECT_FALSE(with({"mujoco.shadow=true", "mujoco.shadow=false"}).mujoco.shadow);
  EXPECT_EQ(with({"stator.mass=[1,2]"}).first().stator->mass, PlanePair(1.0, 2.0));
  EXPECT_EQ(
      with({"contact.friction=0.3", "contact.friction=0.4"}).first().contact->friction.coefficient,
      0.4);
}

TEST(Overrides, TakeWordsOfTheLastReleaseWithANote) {
  for (const std::string word : {"midpoint", "paper"}) {
    const Scene removed = with({"run.integrator=" + word});
    EXPECT_EQ(removed.run.integrator, Integrator::kVerlet);
    ASSERT_EQ(removed.notes.size(), 1u);
    EXPECT_EQ(removed.notes[0], "run.integrator: \"" + word +
                                    "\" was removed and runs \"verlet\"; the word is accepted "
                                    "until version 0.4");
  }
  const Scene renamed = with({"run.integrator=literal"});
  EXPECT_EQ(renamed.run.integrator, Integrator::kEuler);
  ASSERT_EQ(renamed.notes.size(), 1u);
  EXPECT_EQ(renamed.notes[0],
            "run.integrator: \"literal\" is called \"euler\" now; the word is accepted until "
            "version 0.4");
  EXPECT_TRUE(with({"run.integrator=euler"}).notes.empty());
}

// A speed without a unit, as on a name plate, is taken in rad/s, with a note.
TEST(Overrides, ASpeedThatReadsAsTurnsPerMinuteIsNoted) {
  const Scene plain = with({"rotor.speed=3600"});
  EXPECT_EQ(plain.rotor.speed, 3600.0);
  ASSERT_EQ(plain.notes.size(), 1u);
  EXPECT_EQ(plain.notes[0],
            "rotor.speed = 3600 has no unit, so it is read as rad/s (34377 rpm); if you mean rpm, "
            "write \"3600 rpm\"");
  for (const char* meant : {"rotor.speed=3600 rpm", "rotor.speed=3600 rad/s", "rotor.speed=314",
                            "rotor.speed=1570.8", "rotor.speed=100000.0", "rotor.speed=0"}) {
    EXPECT_TRUE(with({meant}).notes.empty()) << meant;
  }
  EXPECT_EQ(with({"rotor.speed=-1500"}).notes.size(), 1u);
}

TEST(Overrides, ReachElementsMakeTablesAndAppend) {
  EXPECT_EQ(with({"force[0].amplitude=200 N"}).forces[0].amplitude, 200.0);
  EXPECT_EQ(with({"force.0.amplitude=200"}).forces[0].amplitude, 200.0);
  EXPECT_EQ(with({"rotor.modal.mass[1]=0.9"}).rotor.modal->mass[1], 0.9);
  EXPECT_EQ(with({"gravity.acceleration=[0,-9.81]"}).gravity->acceleration.y(), -9.81);
  EXPECT_EQ(with({"gravity={acceleration=[0,-9.81]}"}).gravity->acceleration.y(), -9.81);
  const Scene more = with({"force[2].kind=constant", "force[2].vector=[1,0]"});
  ASSERT_EQ(more.forces.size(), 3u);
  EXPECT_EQ(more.forces[2].vector.x(), 1.0);
}

TEST(Overrides, TakePartsAndKeysAway) {
  EXPECT_FALSE(with({"drive=none"}).drive);
  EXPECT_EQ(with({"force[0]=none"}).forces.size(), 1u);
  EXPECT_EQ(with({"force=none"}).forces.size(), 0u);
  EXPECT_EQ(with({"run.output_step=none"}).run.output_step, std::nullopt);
  // `none` is a value of this key.
  const Scene blind = with({"controller.kind=library", "controller.library=law.so",
                            "controller.sample_time=1e-4", "controller.sensors.velocity=none"});
  EXPECT_EQ(blind.first().controller->sensors.velocity, VelocitySensor::kNone);
  EXPECT_FALSE(with({"controller=none"}).first().controller);  // was not there: nothing to do
}

TEST(Overrides, ANewKindTakesAwayTheKeysOfTheOldOne) {
  EXPECT_EQ(with({"drive.kind=free"}).drive->kind, DriveKind::kFree);
  const Scene constant = with({"force[0].kind=constant", "force[0].vector=[3,0]"});
  EXPECT_EQ(constant.forces[0].kind, ForceKind::kConstant);
  EXPECT_EQ(constant.forces[0].on, 0.1);  // belongs to every kind
  EXPECT_EQ(constant.text.find("amplitude"), std::string::npos);
}

TEST(Overrides, AnEarlierEndTakesAwayTheTimesBeyondIt) {
  EXPECT_EQ(with({"run.end=0.2"}).run.output_times, std::vector<double>{0.1234});
  EXPECT_EQ(override_refusal({"run.end=0.2", "run.output_times=[0.3]"}).size(), 1u);
}

TEST(Overrides, LeaveATextThatGivesTheSameScene) {
  const Scene first = with({"contact.friction=0.1", "run.end=0.7 s",
                            "force[1].vector=[1e-300, 0.3]", "gravity={acceleration=[0,-9.81]}"});
  const Scene again = parse_scene(first.text, "scene.toml");
  EXPECT_EQ(again.text, first.text);
  EXPECT_EQ(again.first().contact->friction.coefficient, 0.1);
  EXPECT_EQ(again.run.end, 0.7);
  EXPECT_EQ(again.forces[1].vector, Eigen::Vector2d(1e-300, 0.3));
  EXPECT_EQ(again.gravity->acceleration.y(), -9.81);
  EXPECT_EQ(again.rotor.speed, first.rotor.speed);
  EXPECT_EQ(again.initial.x, first.initial.x);
  EXPECT_NE(scene_hash(first), scene_hash(with({})));
}

TEST(Overrides, AreRefusedLikeAFile) {
  struct Case {
    const char* text;
    const char* key;
    const char* reason;
  };
  const std::vector<Case> cases = {
      {"contact.frictoin=0.3", "contact.frictoin", "did you mean `friction`?"},
      {"contat.friction=0.3", "contat", "did you mean `contact`?"},
      {"contact.friction=-1", "contact.friction", ">= 0"},
      {"run.end=50 Hz", "run.end", "a time"},
      {"run.end=soon", "run.end", "a time"},
      {"run.end=1\nrun.step=2", "run.end", "a time"},
      {"run.end=true", "run.end", "a boolean"},
      {"run.end=nan", "run.end", "not finite"},
      {"run.end.x=1", "run.end.x", "not a table"},
      {"force.amplitude=1", "force.amplitude", "name an element"},
      {"force[7].amplitude=1", "force[7].amplitude",
       "the list has 2 elements, counted from 0; use [2] to add one"},
      {"contact[1].friction=1", "contact[1].friction", "contact is a table, which has no elements"},
      {"contact.friction=none", "contact.friction", "missing"},
      {"rotor=none", "rotor", "cannot be removed"},
      {"contact.friction", "", "expected table.key=value"},
      {"contact.friction=", "", "expected table.key=value"},
      {"=3", "", "expected table.key=value"},
      {"a..b=3", "", "expected table.key=value"},
      {"[0]=3", "", "expected table.key=value"},
      {"force[x].on=3", "", "expected table.key=value"},
      {"force[0]on=3", "", "expected table.key=value"},
      {"force[99999999999999999999].on=3", "", "expected table.key=value"},
      {"a.b.c.d.e.f.g.h.i.j=3", "", "expected table.key=value"},
  };
  for (const Case& wrong : cases) {
    const std::vector<Diagnostic> found = override_refusal({wrong.text});
    ASSERT_EQ(found.size(), 1u) << wrong.text;
    EXPECT_EQ(found[0].key, wrong.key) << wrong.text;
    EXPECT_NE(found[0].reason.find(wrong.reason), std::string::npos)
        << wrong.text << " gave " << found[0].reason;
    const bool taken_away = std::string(wrong.reason) == "missing";
    EXPECT_EQ(found[0].file, taken_away ? "scene.toml" : kOverrideFile) << wrong.text;
    const bool in_file =
        taken_away && wrong.key != std::string("rotor");  // a whole table has no line
    EXPECT_EQ(found[0].line > 0, in_file) << wrong.text;
  }
}

// [contact] is a list of one: key by key, and as a whole.
TEST(Overrides, ATableIsAListOfOne) {
  const Scene s = with({"contact[0].friction=0.07", "contact[0].restitution=0.2"});
  EXPECT_EQ(s.first().contact->friction.coefficient, 0.07);
  EXPECT_EQ(s.first().contact->restitution, 0.2);
  const Scene whole =
      with({"contact[0]={radius=0.02,clearance=3e-4,friction=0.1,restitution=0.4}"});
  EXPECT_EQ(whole.first().contact->clearance, 3e-4);
  EXPECT_EQ(whole.first().contact->restitution, 0.4);
}

}  // namespace
}  // namespace rotorub::scene
