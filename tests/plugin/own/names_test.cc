// Several contacts in one model: their names, refusals by name, and the owners of sensors and
// memory.
#include <gtest/gtest.h>

#include "plugin/model/user_data.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

class OwnNames : public HookedTest {
 protected:
  static std::string replaced_all(std::string text, const std::string& from,
                                  const std::string& to) {
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
      text.replace(at, from.size(), to);
    }
    return text;
  }
  static std::string between(const std::string& text, const std::string& from,
                             const std::string& to) {
    const std::size_t begin = text.find(from) + from.size();
    return text.substr(begin, text.find(to, begin) - begin);
  }
  // The machine twice, as after an attach: every name has a prefix, and texts have none.
  static std::string attached(const std::string& one, const std::string& other) {
    const std::string plain = document(Machine{});
    std::string all = "<mujoco>" + between(plain, "<mujoco>", "<worldbody>");
    all = replaced(all, "nuserdata=\"32\"", "nuserdata=\"34\"");
    for (const char* part : {"worldbody", "contact", "sensor", "custom"}) {
      const std::string begin = std::string("<") + part + ">", end = std::string("</") + part + ">";
      all += begin;
      for (const std::string& prefix : {one, other}) {
        std::string inside = between(plain, begin, end);
        for (const char* key : {" name=\"", " geom1=\"", " geom2=\"", " objname=\""}) {
          inside = replaced_all(inside, key, key + prefix);
        }
        all += inside;
      }
      all += end;
    }
    return all + "</mujoco>";
  }
  static double clearance(const mjModel* m, const char* gap) {
    const DataPointer d = start(m);
    mj_forward(m, d.get());
    return sensor(m, d.get(), gap);
  }
};

TEST_F(OwnNames, AnyEndingNumbersAContact) {
  for (const char* end : {"_2", "2", "_far", "-b"}) {
    TwoRings x;
    x.second = end;
    x.clearance[1] = 3e-4;
    const ModelPointer m = load(document(x));
    EXPECT_DOUBLE_EQ(clearance(m.get(), "gap"), 5e-4);
    EXPECT_DOUBLE_EQ(clearance(m.get(), (std::string("gap") + end).c_str()), 3e-4);
  }
}

// Two machines side by side: each has the bits that it has alone.
TEST_F(OwnNames, AttachedMachinesDoNotMeet) {
  for (const auto& [one, other] :
       {std::pair<std::string, std::string>{"left_", "right_"}, {"a/", ""}}) {
    const ModelPointer both = load(attached(one, other)), alone = load(document(Machine{}));
    const DataPointer d = start(both.get()), e = start(alone.get());
    const auto push = [](mjtNum* force, mjtNum* speed, double by) {
      speed[0] = 0.3 * by;
      speed[1] = 0.1;
      speed[2] = 80.0;
      force[0] = 50.0;
    };
    push(d->qfrc_applied, d->qvel, 1.0);
    push(d->qfrc_applied + 5, d->qvel + 5, 0.7);
    push(e->qfrc_applied, e->qvel, 1.0);
    double pressed = 0.0;
    for (int k = 0; k < 1500; ++k) {
      mj_step(both.get(), d.get());
      mj_step(alone.get(), e.get());
      pressed = std::max(pressed, sensor(both.get(), d.get(), (one + "normal_force").c_str()));
      ASSERT_EQ(sensor(both.get(), d.get(), (one + "normal_force").c_str()),
                sensor(alone.get(), e.get(), "normal_force"));
    }
    EXPECT_GT(pressed, 10.0);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(d->qpos[i], e->qpos[i]) << i;
    EXPECT_NE(d->qpos[5], e->qpos[0]);
  }
}

TEST_F(OwnNames, WhatATextSaysMayBeTheAttachedName) {
  std::string text = attached("left_", "right_");
  text = replaced(text, "name=\"left_rotorub_rotor_geom\" data=\"disc\"",
                  "name=\"left_rotorub_rotor_geom\" data=\"left_disc\"");
  load(text);
}

TEST_F(OwnNames, AMisspeltGeomIsRefusedWithTheOneThatIsMeant) {
  expect_refused(replaced(document(Machine{}), "data=\"disc\"", "data=\"disk\""),
                 "no geom is called \"disk\", did you mean \"disc\"?");
}

TEST_F(OwnNames, MisspeltNamesOfAFurtherContactAreRefused) {
  const std::string good = document(TwoRings{});
  expect_refused(replaced(good, "rotorub_friction_2", "rotorub_friction_3"),
                 "did you mean \"rotorub_friction_2\"");
  expect_refused(replaced(good, "rotorub_clearance_2", "rotorub_clearence_2"),
                 "did you mean \"rotorub_clearance_2\"");
  expect_refused(replaced(good, "rotorub_ring_geom_2", "rotorub_ring_goem_2"),
                 "rotorub_ring_goem_2");
  const std::string attachment = attached("left_", "right_");
  expect_refused(replaced(attachment, "right_rotorub_friction", "rigth_rotorub_friction"),
                 "did you mean \"right_rotorub_friction\"");
  expect_refused(replaced(attachment, "right_rotorub_contact", "right_rotorub_scene"),
                 "a scene cannot be attached");
}

TEST_F(OwnNames, TheNameOfACorrectedPairIsSuggested) {
  expect_refused(replaced(document(Machine{}), "<custom>",
                          "<custom><text name=\"rotorub_cone_coulom_pair\" data=\"a\"/>"),
                 "did you mean \"rotorub_cone_coulomb_pair\"?");
}

TEST_F(OwnNames, NumbersBesideCorrectedPairsAloneAreRefused) {
  const auto sliding = [](const std::string& custom) {
    return "<mujoco><size nuserdata=\"21\"/><worldbody><geom name=\"floor\" type=\"plane\" "
           "size=\"1 1 "
           "1\"/><body pos=\"0 0 .1\"><freejoint/><geom name=\"ball\" size=\".1\"/></body>"
           "</worldbody><contact><pair name=\"slide\" geom1=\"floor\" geom2=\"ball\"/></contact>"
           "<custom><text name=\"rotorub_cone_coulomb_pair\" data=\"slide\"/>" +
           custom + "</custom></mujoco>";
  };
  load(sliding(""));
  load(sliding("<numeric name=\"rotorub_userdata\" data=\"0\"/>"));
  expect_refused(sliding("<numeric name=\"rotorub_friction\" data=\"0.2\"/>"),
                 "belongs to no contact");
}

TEST_F(OwnNames, AFrictionLawIsFinite) {
  const std::string good = document(Machine{});
  const std::string begin = "<numeric name=\"rotorub_friction\" data=\"";
  const std::size_t at = good.find(begin) + begin.size(), end = good.find('"', at);
  for (const char* law : {"inf 0.1 1 0", "0.2 0.1 inf 0", "0.3 0.1 1 inf"}) {
    expect_refused(std::string(good).replace(at, end - at, law), "is not a friction law");
  }
}

TEST_F(OwnNames, EachContactHasItsOwnNumbers) {
  const std::string good = document(TwoRings{});
  const std::string friction = "<numeric name=\"rotorub_friction_2\" data=\"0\"/>";
  expect_refused(replaced(good, friction, ""), "rotorub_friction_2");
  expect_refused(replaced(good, "<text name=\"rotorub_contact_2\" data=\"rigid\"/>", ""),
                 "rotorub_contact_2");
  expect_refused(
      replaced(good, "<numeric name=\"rotorub_clearance_2\" data=\"0.00050000000000000001\"/>", ""),
      "rotorub_clearance_2");
}

TEST_F(OwnNames, OneContactForTwoGeoms) {
  std::string text = document(TwoRings{});
  text = replaced(text, "name=\"rotorub_rotor_geom_2\" data=\"far\"",
                  "name=\"rotorub_rotor_geom_2\" data=\"disc\"");
  text = replaced(text, "name=\"rotorub_ring_geom_2\" data=\"holder\"",
                  "name=\"rotorub_ring_geom_2\" data=\"ring\"");
  expect_refused(text, "already has a contact");
}

// Both "disc" and "disc_2" exist: it is not guessed which one "disc" is for contact _2.
TEST_F(OwnNames, ANumberThatIsAnEndingOfAGeomIsNotGuessed) {
  std::string text = replaced_all(document(TwoRings{}), "\"far\"", "\"disc_2\"");
  load(text);
  expect_refused(replaced(text, "name=\"rotorub_rotor_geom_2\" data=\"disc_2\"",
                          "name=\"rotorub_rotor_geom_2\" data=\"disc\""),
                 "the name is ambiguous");
}

TEST_F(OwnNames, TwoContactModelsOnOneShaftAreRefused) {
  std::string text = document(TwoRings{});
  text = replaced(text, "name=\"rotorub_contact_2\" data=\"rigid\"",
                  "name=\"rotorub_contact_2\" data=\"coulomb\"");
  text = replaced(text, "geom2=\"holder\" condim=\"1\" margin=\"5e-6\" gap=\"1\"",
                  "geom2=\"holder\" condim=\"1\" solref=\"-4e8 -10211.0255\" margin=\"5e-7\"");
  expect_refused(text, "use one contact model for both");
}

TEST_F(OwnNames, TheSizeThatIsNeededIsSaid) {
  TwoRings x;
  x.userdata = "33";
  expect_refused(document(x), "set nuserdata=\"34\" or more");
  x.userdata = "34";
  load(document(x));
  x.custom = "<numeric name=\"rotorub_userdata\" data=\"10\"/>";
  expect_refused(document(x), "set nuserdata=\"44\" or more: 34 entries from index 10 on");
}

class OwnUserData : public OwnNames {};

// At any place the bits are the same, and the user's entries are unchanged.
TEST_F(OwnUserData, OurBlockStandsWhereItIsTold) {
  TwoRings x;
  x.friction = 0.15;
  const auto run = [&](const std::string& place, int first, int last) {
    x.custom = place;
    const ModelPointer m = load(document(x));
    const DataPointer d = start(m.get());
    d->qvel[0] = 0.3;
    d->qvel[3] = 1.0;
    d->qvel[4] = 100.0;
    for (int k = 0; k < 1000; ++k) {
      for (int i = 0; i < m->nuserdata; ++i) {
        if (i < first || i >= last) d->userdata[i] = k + i;
      }
      mj_step(m.get(), d.get());
      for (int i = 0; i < m->nuserdata; ++i) {
        if (i < first || i >= last) {
          EXPECT_EQ(d->userdata[i], k + i);
        }
      }
    }
    EXPECT_GT(plugin::entries<plugin::ModelEntries>(d.get(), first).config_id, 0.0);
    return state_of(m.get(), d.get());
  };
  const auto first = run("", 0, 34);
  EXPECT_EQ(run("<numeric name=\"rotorub_userdata\" data=\"17\"/>", 17, 51), first);
  EXPECT_EQ(run("<numeric name=\"rotorub_userdata\" data=\"30\"/>", 30, 64), first);
}

TEST_F(OwnUserData, AFrictionReferenceNeedsTheCone) {
  TwoRings x;
  x.custom = "<numeric name=\"rotorub_friction_reference\" data=\"100\"/>";
  expect_refused(document(x), "contact model rigid has no friction reference");
}

TEST_F(OwnUserData, AClashIsRefusedInTheSameStep) {
  const ModelPointer m = load(document(TwoRings{}));
  for (int at = 0; at < 34; ++at) {
    // Only scenes use the entries from held_x on, and passive_fresh changes within a pass.
    const int unused = 2;
    if (at >= unused && at < plugin::kFirstContact) continue;
    const DataPointer d = start(m.get());
    d->qvel[0] = 0.3;
    for (int k = 0; k < 10; ++k) mj_step(m.get(), d.get());
    d->userdata[at] += 1.0;
    EXPECT_THROW(mj_step(m.get(), d.get()), std::runtime_error) << at;
  }
  // 0 before the first step, and if no entry is ours.
  const DataPointer used = start(m.get());
  used->userdata[20] = 3.0;
  EXPECT_THROW(mj_step(m.get(), used.get()), std::runtime_error);
  const DataPointer behind = start(m.get());
  behind->userdata[34] = 3.0;
  mj_step(m.get(), behind.get());
}

TEST_F(OwnUserData, PlacesThatCannotBeAreRefused) {
  TwoRings x;
  for (const char* place : {"-1", "0.5", "1e300"}) {
    x.custom = std::string("<numeric name=\"rotorub_userdata\" data=\"") + place + "\"/>";
    expect_refused(document(x), "rotorub_userdata");
  }
  x.custom =
      "<numeric name=\"rotorub_userdata\" data=\"1\"/><numeric name=\"a_rotorub_userdata\" "
      "data=\"2\"/>";
  expect_refused(document(x), "one value in the whole model");
}

class ScaledSensors : public OwnNames {};

// A viewer's plot from -1 to 1: the gap in clearances, forces in units of the sensor's own number.
TEST_F(ScaledSensors, AreShares) {
  TwoRings x;
  x.clearance[1] = 3e-4;
  const auto user = [](const std::string& name, const std::string& data) {
    return "<user name=\"" + name +
           "\" objtype=\"body\" objname=\"shaft\" datatype=\"real\" "
           "needstage=\"pos\" dim=\"1\" " +
           data + "/>";
  };
  x.sensors = user("gap_scaled", "") + user("gap_scaled_2", "") +
              user("normal_force_scaled", "user=\"200\"") +
              user("normal_force_scaled_2", "user=\"50\"") +
              user("friction_force_scaled", "user=\"10\"");
  x.friction = 0.1;
  const ModelPointer m = load(document(x));
  const DataPointer d = start(m.get());
  d->qpos[0] = 2e-4;
  mj_forward(m.get(), d.get());
  EXPECT_NEAR(sensor(m.get(), d.get(), "gap_scaled"), 0.6, 1e-12);
  EXPECT_NEAR(sensor(m.get(), d.get(), "gap_scaled_2"), 1.0 / 3.0, 1e-12);
  d->qvel[4] = 100.0;
  d->qfrc_applied[0] = 120.0;
  for (int k = 0; k < 3000; ++k) mj_step(m.get(), d.get());
  for (const auto& [name, share, unit] :
       {std::tuple{"normal_force", "normal_force_scaled", 200.0},
        std::tuple{"normal_force_2", "normal_force_scaled_2", 50.0},
        std::tuple{"friction_force", "friction_force_scaled", 10.0}}) {
    EXPECT_DOUBLE_EQ(sensor(m.get(), d.get(), share), sensor(m.get(), d.get(), name) / unit)
        << name;
  }
  x.sensors = user("normal_force_scaled", "");
  expect_refused(document(x), "user=\"200\" for 200 N");
}

}  // namespace
}  // namespace rotorub::test
