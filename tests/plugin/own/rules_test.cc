// Rules for a user's own model: the names that it may have, the refusals, and the place where rotor
// and ring touch.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

using OwnRules = HookedTest;

TEST_F(OwnRules, MisspeltNamesAreRefusedWithASuggestion) {
  const std::string good = document(Machine{});
  load(good);
  expect_refused(replaced(good, "rotorub_friction", "rotorub_fricton"),
                 "did you mean \"rotorub_friction\"");
  expect_refused(replaced(good, "rotorub_ring_geom", "rotorub_rnig_geom"),
                 "did you mean \"rotorub_ring_geom\"");
  // Neither geom is named, but the model is still ours.
  expect_refused(replaced(replaced(good, "rotorub_ring_geom", "rotorub_ring"), "rotorub_rotor_geom",
                          "rotorub_rotor"),
                 "rotorub_rotor");
  // A number among the texts.
  Machine x;
  x.custom = "<text name=\"rotorub_width\" data=\"0.02\"/>";
  expect_refused(document(x), "rotorub_width");
}

TEST_F(OwnRules, ASceneStandsAlone) {
  const std::string scene = mjcf(shipped("bench_ring"));
  expect_refused(
      replaced(scene, "<custom>", "<custom><text name=\"rotorub_rotor_geom\" data=\"rotor\"/>"),
      "beside a scene's text");
  expect_refused(
      replaced(scene, "<custom>", "<custom><numeric name=\"rotorub_friction\" data=\"0.3\"/>"),
      "set the value in the scene");
}

TEST_F(OwnRules, ThePairSaysWhatTheTextSays) {
  Machine soft;
  soft.contact = "coulomb";
  load(document(soft));
  expect_refused(replaced(document(soft), "-10211.0255", "-1000"),
                 "the present solref gives a restitution of 0.9");
  expect_refused(replaced(document(soft), "solref=\"-4e8 -10211.0255\"", ""),
                 "the present solref gives a restitution of 0.13");
  soft.custom = "<numeric name=\"rotorub_tangential_restitution\" data=\"0.5\"/>";
  expect_refused(document(soft), "rotorub_tangential_restitution");

  Machine cone;
  cone.contact = "cone";
  cone.friction = 0.15;
  expect_refused(document(cone), "condim");
  const std::string three = replaced(document(cone), "condim=\"1\"", "condim=\"3\"");
  expect_refused(three, "friction is 1,");
  load(replaced(three, "condim=\"3\"", "condim=\"3\" friction=\"0.15 0.15 0 0 0\""));
}

TEST_F(OwnRules, RigidRefusesAnotherFrictionInThePair) {
  Machine x;
  x.friction = 0.15;
  const std::string three = replaced(document(x), "condim=\"1\"", "condim=\"3\"");
  load(three);  // MuJoCo's own, that nobody wrote
  expect_refused(replaced(three, "condim=\"3\"", "condim=\"3\" friction=\"0.4 0.4 0 0 0\""),
                 "friction is 0.4, but rotorub_friction is 0.15");
  load(replaced(three, "condim=\"3\"", "condim=\"3\" friction=\"0.15 0.15 0 0 0\""));
}

// A rotor that lies across its ring is not a disc in it.
TEST_F(OwnRules, RefuseARotorAcrossItsRing) {
  const std::string upright = document(Machine{});
  load(replaced(upright, "<geom name=\"disc\"", "<geom euler=\"30 0 0\" name=\"disc\""));
  expect_refused(replaced(upright, "<geom name=\"disc\"", "<geom euler=\"90 0 0\" name=\"disc\""),
                 "across the axis of its ring");
}

// Its motion is in no velocity, so the contact would not notice it.
TEST_F(OwnRules, RigidRefusesGeomsOfMocapBodies) {
  Machine x;
  x.ring_moves = false;
  const std::string mocap =
      replaced(document(x), "<body name=\"ring\">", "<body name=\"ring\" mocap=\"true\">");
  expect_refused(mocap, "<body name=\"ring\" mocap=\"true\">");
  const std::string child =
      replaced(replaced(document(Machine{}), "<body name=\"ring\">",
                        "<body name=\"base\" mocap=\"true\"><body name=\"ring\">"),
               "size=\"0.06 0.01\"/>", "size=\"0.06 0.01\"/></body>");
  expect_refused(child, "<body name=\"base\" mocap=\"true\">");
  x = Machine{};
  x.bodies = "<body name=\"hand\" mocap=\"true\"/>";
  x.constraints = equality("<weld body1=\"ring\" body2=\"hand\"/>");
  load(document(x));
}

// A contact that lasted does not continue in a state that was written at another time.
TEST_F(OwnRules, AWrittenStateReboundsAsAFreshOne) {
  Machine one;
  one.friction = 0.15;
  TwoRings two;
  two.friction = 0.15;
  for (const std::string& text : {document(one), document(two)}) {
    const ModelPointer m = load(text);
    const DataPointer used = start(m.get());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int k = 0; k < 80; ++k) {
      mj_resetData(m.get(), used.get());
      used->qpos[0] = 5e-4 + 1e-8;
      used->qfrc_applied[0] = 30.0;
      for (int i = 0; i < 20; ++i) mj_step(m.get(), used.get());
      used->qfrc_applied[0] = 0.0;
      const DataPointer fresh = start(m.get());
      const double turn = 3.141592653589793 * unit(random), speed = 0.6 + 0.4 * unit(random);
      for (mjData* d : {fresh.get(), used.get()}) {
        d->time = 0.0;
        mju_copy(d->qpos, m->qpos0, m->nq);
        mju_zero(d->qvel, m->nv);
        d->qpos[0] = (5e-4 - 1e-7) * std::cos(turn);
        d->qpos[1] = (5e-4 - 1e-7) * std::sin(turn);
        d->qvel[0] = speed * std::cos(turn);
        d->qvel[1] = speed * std::sin(turn);
        for (int i = 0; i < 3; ++i) mj_step(m.get(), d);
      }
      EXPECT_LT(fresh->qvel[0] * std::cos(turn) + fresh->qvel[1] * std::sin(turn), 0.9 * speed);
      for (int i = 0; i < m->nv; ++i) EXPECT_EQ(used->qvel[i], fresh->qvel[i]) << k;
    }
  }
}

// Contact lasted in the step before, and the state is written at the same time: 1 to 100 nm before
// the wall it is a blow of 2 kg on 1 kg with its restitution, v' = v (2 - e) / 3 for the rotor and
// v 2 (1 + e) / 3 for the ring.
TEST_F(OwnRules, AStateThatIsWrittenBeforeTheWallHasItsImpact) {
  const ModelPointer m = load(document(Machine{}));
  for (const double gap : {1e-9, 1e-8, 1e-7}) {
    for (const bool forward : {false, true}) {
      const DataPointer d = start(m.get());
      d->qpos[0] = 5e-4 + 1e-8;
      d->qfrc_applied[0] = 30.0;
      for (int i = 0; i < 20; ++i) mj_step(m.get(), d.get());
      ASSERT_GT(sensor(m.get(), d.get(), names::kNormalForce), 1.0);
      if (forward) mj_forward(m.get(), d.get());
      d->qfrc_applied[0] = 0.0;
      mju_copy(d->qpos, m->qpos0, m->nq);
      mju_zero(d->qvel, m->nv);
      d->qpos[0] = 5e-4 - gap;
      d->qvel[0] = 0.3;
      for (int i = 0; i < 3; ++i) mj_step(m.get(), d.get());
      EXPECT_NEAR(d->qvel[0], 0.3 * (2.0 - kEps) / 3.0, 1e-9) << gap << forward;
      EXPECT_NEAR(d->qvel[3], 0.3 * 2.0 * (1.0 + kEps) / 3.0, 1e-9) << gap << forward;
    }
  }
}

TEST_F(OwnRules, SeveralNumbersForOneAreRefused) {
  const std::string good = document(Machine{});
  expect_refused(replaced(good, "data=\"5e-4\"", "data=\"5e-4 1e-3\""),
                 "<custom><numeric name=\"rotorub_clearance\">: has 2 numbers; give one");
  for (const char* friction : {"0.3 0.1", "0.3 0.1 3", "0.3 0.1 3 0 7"}) {
    expect_refused(replaced(good, "data=\"0.000000\"", std::string("data=\"") + friction + "\""),
                   "numbers; give one, or four");
  }
  Machine x;
  x.custom = "<numeric name=\"rotorub_userdata\" data=\"0 1\"/>";
  expect_refused(document(x), "rotorub_userdata");
}

TEST_F(OwnRules, ARotorThatCannotMoveInItsRingIsRefused) {
  Machine x;
  x.bodies = R"(<geom name="wall" type="cylinder" size="0.06 0.01"/>
                <body><geom name="shelf" type="cylinder" size="0.06 0.01" mass="1"/></body>)";
  const std::string text = document(x);
  const auto ring = [&](const std::string& name) {
    return replaced(replaced(text, "geom2=\"bore\"", "geom2=\"" + name + "\""),
                    "ring_geom\" data=\"bore\"", "ring_geom\" data=\"" + name + "\"");
  };
  load(ring("wall"));
  const std::string twin = "<geom name=\"disc\"";
  expect_refused(
      replaced(ring("hub"), twin, "<geom name=\"hub\" type=\"sphere\" size=\"0.06\"/>" + twin),
      "both are on one body");
  const std::string fixed =
      replaced(ring("wall"), "rotor_geom\" data=\"disc\"", "rotor_geom\" data=\"shelf\"");
  expect_refused(fixed, "there is no joint between their bodies");
}

TEST_F(OwnRules, TwoPairsOfTheSameGeomsAreRefused) {
  Machine x;
  x.pairs = "<pair geom1=\"bore\" geom2=\"disc\" condim=\"1\" margin=\"5e-6\" gap=\"1\"/>";
  EXPECT_NE(load_refusal(document(x)), "") << "MuJoCo or the plugin";
}

// For a first model all mistakes are reported together, and a missing pair is written out.
TEST_F(OwnRules, AllThatIsWrongIsSaidAtOnce) {
  std::string bad = replaced(document(Machine{}), "nuserdata=\"32\"", "nuserdata=\"2\"");
  bad = replaced(bad, "data=\"0.500000\"", "data=\"1.5\"");
  bad = replaced(bad, "gap=\"1\"", "gap=\"0\"");
  bad = replaced(bad, "rotorub_friction", "rotorub_fricton");
  expect_refused(bad, "rotorub_fricton");
  expect_refused(bad, "1.5 must be between 0 and 1");
  expect_refused(bad, "set nuserdata=\"21\" or more");
  const std::string pair =
      "<pair geom1=\"disc\" geom2=\"bore\" condim=\"1\" margin=\"5e-6\" gap=\"1\"/>";
  expect_refused(replaced(document(Machine{}), pair, ""),
                 "missing; add <pair geom1=\"disc\" geom2=\"bore\" condim=\"1\" margin=\"");
}

// The force is available at the stage of the sensor, or the sensor is refused.
TEST_F(OwnRules, ForcesAreToldAtTheStageThatIsAsked) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    const ModelPointer m = load(replaced(document(x), "needstage=\"acc\"", "needstage=\"vel\""));
    const DataPointer d = start(m.get());
    d->qpos[0] = 5e-4 + 1e-8;
    d->qfrc_applied[0] = 30.0;
    for (int k = 0; k < 100; ++k) mj_step(m.get(), d.get());
    EXPECT_NEAR(sensor(m.get(), d.get(), names::kNormalForce), 10.0, contact[0] == 'r' ? 0.1 : 5.0);
  }
  Machine cone;
  cone.contact = "cone";
  expect_refused(replaced(document(cone), "needstage=\"acc\"", "needstage=\"vel\""),
                 "normal_force");
}

// Recent versions of MuJoCo clear the user sensors of a stage before they call mjcb_sensor.
TEST_F(OwnRules, SensorsOfEveryStageAreTold) {
  const auto told = [](const char* stage) {
    std::string text = document(Machine{});
    const std::string sensors =
        text.substr(text.find("<sensor>"), text.find("</sensor>") - text.find("<sensor>"));
    std::string all = "<sensor>";
    for (const char* name : {names::kGap, names::kGapRate, names::kSlip, names::kNormalForce,
                             names::kFrictionForce, names::kActive}) {
      all += std::string("<user name=\"") + name +
             "\" objtype=\"geom\" objname=\"disc\" datatype=\"real\" "
             "needstage=\"" +
             stage + "\" dim=\"1\"/>";
    }
    const ModelPointer m = load(replaced(text, sensors, all));
    const DataPointer d = start(m.get());
    d->qpos[0] = 5e-4 + 1e-8;
    d->qvel[1] = 0.1;
    d->qfrc_applied[0] = 30.0;
    for (int k = 0; k < 3; ++k) mj_step(m.get(), d.get());
    return std::vector<double>(d->sensordata, d->sensordata + m->nsensordata);
  };
  const std::vector<double> wanted = told("pos");
  EXPECT_EQ(wanted.back(), 1.0);
  EXPECT_GT(wanted[3], 1.0);
  for (const double value : {wanted[0], wanted[1], wanted[2]}) EXPECT_NE(value, 0.0);
  EXPECT_EQ(told("vel"), wanted);
  EXPECT_EQ(told("acc"), wanted);
}

// An override in <option> for all contacts does not affect `rigid`, and is refused where MuJoCo
// solves our contact by it.
TEST_F(OwnRules, AnOverrideOfAllContactsIsNotTakenForThePair) {
  Machine x;
  const auto run = [](const ModelPointer& m) {
    const DataPointer d = start(m.get());
    d->qvel[0] = 1.0;
    for (int k = 0; k < 120; ++k) mj_step(m.get(), d.get());
    EXPECT_EQ(d->nefc, 0);
    return state_of(m.get(), d.get());
  };
  const std::vector<double> wanted = run(load(document(x)));
  for (const char* margin : {"0", "1e-3", "2"}) {
    x.option =
        std::string("o_margin=\"") + margin + "\"><flag override=\"enable\"/></option><option ";
    EXPECT_EQ(run(load(document(x))), wanted) << margin;
  }
  for (const char* contact : {"coulomb", "cone"}) {
    x.contact = contact;
    expect_refused(document(x), "<flag override=\"enable\"/>");
  }
}

// A size that is edited in mjModel acts from the next pass on, also in collision.
TEST_F(OwnRules, AnEditedSizeCountsInTheSamePass) {
  const ModelPointer m = load(document(Machine{}));
  const DataPointer d = start(m.get());
  d->qpos[0] = 5e-4;
  mj_forward(m.get(), d.get());
  ASSERT_EQ(d->ncon, 1);
  EXPECT_NEAR(d->contact[0].pos[0], 0.0505, 1e-12);
  m->geom_size[3 * mj_name2id(m.get(), mjOBJ_GEOM, "disc")] = 0.04;
  mj_forward(m.get(), d.get());
  ASSERT_EQ(d->ncon, 1);
  EXPECT_NEAR(d->contact[0].pos[0], 0.0405, 1e-12);
  m->geom_size[3 * mj_name2id(m.get(), mjOBJ_GEOM, "disc")] = -0.04;
  EXPECT_THROW(mj_forward(m.get(), d.get()), std::runtime_error);
}

// 100 um deep, at rest: it is pushed out slowly, not thrown out with 4 J.
TEST_F(OwnRules, AStartInsideTheWallGainsNoEnergy) {
  const ModelPointer m = load(document(Machine{}));
  const DataPointer d = start(m.get());
  d->qpos[0] = 6e-4;
  for (int k = 0; k < 20000; ++k) {
    mj_step(m.get(), d.get());
    ASSERT_LT(d->qvel[0] * d->qvel[0] + 0.5 * d->qvel[3] * d->qvel[3], 1e-5) << k;
  }
  EXPECT_LT(std::abs(d->qpos[0] - d->qpos[3]), 5e-4 + 1e-9);
}

// Disc and ring are 20 mm long each; apart along the axis the rotor flies through.
TEST_F(OwnRules, ApartAlongTheAxisTheyDoNotMeet) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    const auto leaves = [&](const std::string& place, const std::string& custom) {
      x.custom = custom;
      const ModelPointer m = load(replaced(document(x), "<body name=\"shaft\">",
                                           "<body name=\"shaft\" pos=\"0 0 " + place + "\">"));
      const DataPointer d = start(m.get());
      d->qvel[0] = 0.3;
      for (int k = 0; k < 250; ++k) mj_step(m.get(), d.get());
      return d->qvel[0] == 0.3;
    };
    EXPECT_FALSE(leaves("0", "")) << contact;
    EXPECT_FALSE(leaves("0.019", "")) << contact;
    EXPECT_TRUE(leaves("0.021", "")) << contact;
    EXPECT_TRUE(leaves("-1", "")) << contact;
    EXPECT_FALSE(leaves("0.021", "<numeric name=\"rotorub_width\" data=\"0.03\"/>")) << contact;
  }
}

}  // namespace
}  // namespace rotorub::test
