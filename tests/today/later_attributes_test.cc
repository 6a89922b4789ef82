// Attributes that MuJoCo added after 2.2 to elements that the plugin takes over: they are refused
// by name, or obeyed.
#include <gtest/gtest.h>

#include <string>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/hooks.h"
#include "plugin/make_config.h"
#include "plugin/model/config.h"
#include "tests/plugin/own/machine.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/two_rings.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

class LaterAttributes : public MujocoTest {
 protected:
  static std::string with(const std::string& text, const std::string& element,
                          const std::string& attribute) {
    return replaced(text, element, element + " " + attribute);
  }
  static std::string cone() {
    Machine x;
    x.contact = "cone";
    x.friction = 0.15;
    return replaced(document(x), "condim=\"1\"", "condim=\"3\" friction=\"0.15 0.15 0 0 0\"");
  }
  plugin::Hooks hooks_;
};

// The ends of a <weld> may be sites, whose numbers are those of other bodies.
TEST_F(LaterAttributes, AWeldOfSitesActsOnTheirBodies) {
  const std::string chain = mjcf(two_rings_scene("moving"));
  const auto welded = [&](const std::string& site) {
    std::string sites;  // in the world, before those of the bodies
    for (int k = 0; k < 5; ++k) sites += "<site name=\"w" + std::to_string(k) + "\"/>";
    const std::string bodies =
        sites +
        "<body><freejoint/><geom size=\"0.01\"/><site name=\"a\"/></body>"
        "<body><freejoint/><geom size=\"0.01\" pos=\"0 1 0\"/><site name=\"b\"/></body>";
    return replaced(replaced(replaced(chain, "<worldbody>", "<worldbody>" + bodies),
                             "<body name=\"ring\">", "<body name=\"ring\"><site name=\"c\"/>"),
                    "</mujoco>",
                    "<equality><weld site1=\"a\" site2=\"" + site + "\"/></equality></mujoco>");
  };
  load(welded("b"));
  expect_refused(welded("c"), "<equality name=\"\">");
}

TEST_F(LaterAttributes, ASurfaceThatMovesIsRefused) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    x.friction = 0.15;
    for (const char* geom : {"disc", "bore"}) {
      const std::string name = std::string("<geom name=\"") + geom + "\"";
      expect_refused(with(document(x), name, "surfacevel=\"0 0 0 0 0 600\""),
                     name +
                         ">: the attribute surfacevel, new in MuJoCo 3.11, is not supported by "
                         "contact model " +
                         contact + "; remove it, turn the body");
    }
  }
  load(with(cone(), "<geom name=\"bore\"", "surfacevel=\"0 0 0 0 0 600\""));
}

TEST_F(LaterAttributes, AdhesionOfAPairIsRefused) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    expect_refused(with(document(x), "geom2=\"bore\"", "adhesion=\"20\""),
                   "<pair geom1=\"disc\" geom2=\"bore\">: the attribute adhesion, new in MuJoCo "
                   "3.11, is not supported by contact model " +
                       std::string(contact) + "; remove");
  }
  load(with(cone(), "geom2=\"bore\"", "adhesion=\"20\""));
}

// In a contact of a <pair> MuJoCo takes the adhesion of the <pair> alone: that of a geom is for its
// other contacts, and changes no bit of ours.
TEST_F(LaterAttributes, AdhesionOfAGeomActsInNoPair) {
  for (const char* contact : {"rigid", "coulomb", "cone"}) {
    Machine x;
    x.contact = contact;
    const std::string plain = contact == std::string("cone") ? cone() : document(x);
    const auto run = [](const std::string& text) {
      const ModelPointer m = load(text);
      const DataPointer d = start(m.get());
      d->qvel[0] = 0.1;
      int touched = 0;
      for (int k = 0; k < 2000; ++k) {
        mj_step(m.get(), d.get());
        touched += sensor(m.get(), d.get(), names::kNormalForce) > 0.0 ? 1 : 0;
        for (int i = 0; i < d->ncon; ++i) EXPECT_EQ(d->contact[i].adhesion, 0.0);
      }
      EXPECT_GT(touched, 0);
      return state_bits(m.get(), d.get());
    };
    std::string sticky = plain;
    for (const char* geom : {"<geom name=\"disc\"", "<geom name=\"bore\""})
      sticky = with(sticky, geom, "adhesion=\"20\"");
    EXPECT_EQ(run(sticky), run(plain)) << contact;
  }
}

// Edits in mjModel are found in the next pass.
TEST_F(LaterAttributes, AnEditIsRefusedInTheNextPass) {
  const auto expect_refusal = [](const std::string& text, auto edit) {
    const ModelPointer m = load(text);
    const DataPointer d = start(m.get());
    mj_step(m.get(), d.get());
    edit(m.get());
    EXPECT_THROW(mj_step(m.get(), d.get()), std::runtime_error);
  };
  const std::string own = document(Machine{}), generated = mjcf(shipped("bench_ring"));
  expect_refusal(own, [](mjModel* m) { m->geom_surfacevel[5] = 20.0; });
  expect_refusal(own, [](mjModel* m) { m->pair_adhesion[0] = 20.0; });
  expect_refusal(generated, [](mjModel* m) { m->pair_adhesion[0] = 20.0; });
  expect_refusal(generated, [](mjModel* m) { m->jnt_actfrclimited[0] = 1; });
}

// Each message names the element, the attribute, its release and what to do. A model without them
// that was loaded before, and differs in nothing else, hides none of them.
TEST_F(LaterAttributes, AGeneratedModelNamesEach) {
  const std::string text = mjcf(shipped("paper_sliding"));
  const ModelPointer plain = load(text);
  const std::string ring = std::string("<geom name=\"") + names::kRingContact + "\"",
                    unsupported = "is not supported on a generated rotor or its ring";
  struct Case {
    std::string element, attribute, message;
  };
  const Case cases[] = {
      {ring, "surfacevel=\"0 0 0 0 0 600\"",
       ">: the attribute surfacevel, new in MuJoCo 3.11, is not supported by contact model"},
      {"<body name=\"ring\"", "gravcomp=\"1\"",
       ">: the attribute gravcomp, new in MuJoCo 2.3.1, " + unsupported +
           ", whose weight the plugin applies; remove it, and set [gravity]"},
      {"<joint name=\"ring_x\"", "actuatorfrcrange=\"-1 1\"",
       ">: the attribute actuatorfrcrange, new in MuJoCo 2.3.7, " + unsupported +
           "; remove it, and limit"},
      {"<fixed name=\"axis_1\"", "armature=\"1\"",
       ">: the attribute armature, new in MuJoCo 3.3.1, " + unsupported + "; remove it, and set"},
      {"<fixed name=\"axis_1\"", "actuatorfrcrange=\"-1 1\" actuatorfrclimited=\"true\"",
       ">: the attribute actuatorfrcrange, new in MuJoCo 3.3.1, " + unsupported},
      {"<fixed name=\"axis_1\"", "stiffness=\"1 1\"",
       ">: the attribute stiffness with several numbers, new in MuJoCo 3.7, " + unsupported +
           "; give one number"},
      {"<motor name=\"actuator_1\"", "armature=\"1\"",
       "<actuator name=\"actuator_1\">: the attribute armature, new in MuJoCo 3.7, " + unsupported +
           "; remove it, and set"},
      {"<motor name=\"actuator_1\"", "nsample=\"2\" delay=\"1e-5\"",
       "<actuator name=\"actuator_1\">: the attribute delay, new in MuJoCo 3.5, is not supported "
       "on an actuator of the bearing, whose force the plugin computes; remove it, and set"},
  };
  for (const Case& c : cases) {
    const std::string named = c.message.front() == '>' ? c.element + c.message : c.message;
    expect_refused(with(text, c.element, c.attribute), named);
  }
  const std::string spring = "armature=\"1.5\" stiffness=\"200000";
  expect_refused(replaced(text, spring, spring + " 1"),
                 "<joint name=\"ring_x\">: the attribute stiffness with several numbers, new in "
                 "MuJoCo 3.7, " +
                     unsupported + "; give one number");
}

// What MJCF does not offer on these elements can be set by mjSpec.
TEST_F(LaterAttributes, WhatMjSpecCanSetIsNamedToo) {
  const auto refusal = [](auto edit) -> std::string {
    const ModelPointer m = load(mjcf(shipped("paper_sliding")));
    edit(m.get());
    try {
      plugin::make_config(m.get());
    } catch (const plugin::ConfigError& error) {
      return error.what();
    }
    return "";
  };
  const std::string gap = "rotorub: <user name=\"gap\">: the attribute ",
                    written =
                        ", new in MuJoCo 3.5, is not supported for a sensor whose value the "
                        "plugin writes; remove it";
  const auto sensor = [](const mjModel* m) { return mj_name2id(m, mjOBJ_SENSOR, "gap"); };
  EXPECT_EQ(refusal([&](mjModel* m) { m->sensor_delay[sensor(m)] = 1e-4; }),
            gap + "delay" + written);
  EXPECT_EQ(refusal([&](mjModel* m) { m->sensor_interval[2 * sensor(m)] = 1e-4; }),
            gap + "interval" + written);
  EXPECT_EQ(refusal([&](mjModel* m) { m->sensor_history[2 * sensor(m)] = 2; }),
            gap + "nsample" + written);
  EXPECT_EQ(
      refusal([](mjModel* m) { m->actuator_actearly[0] = 1; }),
      "rotorub: <actuator name=\"actuator_1\">: the attribute actearly, new in MuJoCo 3.0, is "
      "not supported on an actuator of the bearing, whose force the plugin computes; remove "
      "it");
}

// A sphere on a belt at 10 m/s, whose contact is corrected.
constexpr const char* kBelt = R"(<mujoco><option timestep="1e-3" cone="elliptic"/>
    <size nuserdata="32"/>
    <worldbody><geom name="belt" type="plane" size="100 100 1" surfacevel="10 0 0 0 0 0"/>
    <body pos="0 0 0.1"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>
      <geom name="box" type="sphere" size="0.1" mass="1"/></body></worldbody>
    <contact><pair name="sliding" geom1="belt" geom2="box" condim="3" friction="0.5 0.5 0 0 0"/>
    </contact>
    <custom><text name="rotorub_cone_coulomb_pair" data="sliding"/></custom></mujoco>)";

// The belt takes it along with mu g, as a box that slides on a floor is braked.
TEST_F(LaterAttributes, APairThatIsCorrectedKnowsItsBelt) {
  const ModelPointer m = load(kBelt);
  const DataPointer d = start(m.get());
  for (int k = 0; k < 1000; ++k) mj_step(m.get(), d.get());
  EXPECT_NEAR(d->qvel[0], 0.5 * 9.81, 0.01);
}

TEST_F(LaterAttributes, AdhesionOfAPairThatIsCorrectedIsRefused) {
  expect_refused(with(kBelt, "geom2=\"box\"", "adhesion=\"20\""),
                 "<pair geom1=\"belt\" geom2=\"box\">: the attribute adhesion, new in MuJoCo 3.11, "
                 "is not supported by contact model cone-coulomb; remove it");
  const ModelPointer m = load(kBelt);
  const DataPointer d = start(m.get());
  mj_step(m.get(), d.get());
  m->pair_adhesion[0] = 20.0;
  EXPECT_THROW(mj_step(m.get(), d.get()), std::runtime_error);
}

// The steady force of an engine plugin, N.
constexpr double kWind = 60.0;
void register_wind() {
  if (mjp_getPlugin("rotorub.test.wind", nullptr)) return;
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = "rotorub.test.wind";
  plugin.capabilityflags = mjPLUGIN_PASSIVE;
  plugin.nstate = [](const mjModel*, int) { return 0; };
  plugin.init = [](const mjModel*, mjData*, int) { return 0; };
  plugin.reset = [](const mjModel*, mjtNum*, void*, int) {};
  plugin.compute = [](const mjModel*, mjData* d, int, int) { d->qfrc_passive[0] += kWind; };
  mjp_registerPlugin(&plugin);
}

// Pressed against a fixed ring with 40 N and the wind: 100 N, with the actuation disabled as well,
// where MuJoCo adds the plugin's force after the contact was solved.
TEST_F(LaterAttributes, PassiveEnginePluginsPressWithoutActuationToo) {
  register_wind();
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    x.ring_moves = false;
    std::string text = replaced(document(x), "<worldbody>",
                                "<extension><plugin plugin=\"rotorub.test.wind\"><instance "
                                "name=\"wind\"/></plugin></extension><worldbody>");
    text =
        replaced(text, "<body name=\"rotor\">", "<body name=\"rotor\"><plugin instance=\"wind\"/>");
    const ModelPointer m = load(text);
    for (const bool disabled : {false, true}) {
      if (disabled) m->opt.disableflags |= mjDSBL_ACTUATION;
      const DataPointer d = start(m.get());
      d->qpos[0] = 5e-4;
      for (int k = 0; k < 3000; ++k) {
        d->qfrc_applied[0] = 40.0;
        mj_step(m.get(), d.get());
      }
      EXPECT_NEAR(sensor(m.get(), d.get(), names::kNormalForce), 100.0, 0.1) << contact << disabled;
    }
  }
}

}  // namespace
}  // namespace rotorub::test
