// Attributes that MuJoCo has had since 2.2 on what the plugin takes over: refused by name, or
// honoured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/hooks.h"
#include "tests/plugin/own/machine.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

class LaterAttributes : public MujocoTest {
 protected:
  static void expect_refused(const std::string& text, const std::string& named) {
    std::string why;
    EXPECT_EQ(try_load(text, why), nullptr) << named;
    EXPECT_NE(why.find(named), std::string::npos) << why;
  }
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

TEST_F(LaterAttributes, ASurfaceThatMovesIsRefused) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    x.friction = 0.15;
    for (const char* geom : {"disc", "bore"}) {
      const std::string name = std::string("<geom name=\"") + geom + "\"";
      expect_refused(with(document(x), name, "surfacevel=\"0 0 0 0 0 600\""),
                     name + " surfacevel=\"...\">");
    }
  }
  load(with(cone(), "<geom name=\"bore\"", "surfacevel=\"0 0 0 0 0 600\""));
}

TEST_F(LaterAttributes, AdhesionIsRefused) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    const std::string text = document(x);
    expect_refused(with(text, "geom2=\"bore\"", "adhesion=\"20\""), "adhesion=\"20\"");
    expect_refused(with(text, "<geom name=\"bore\"", "adhesion=\"20\""), "adhesion=\"20\"");
  }
  load(with(cone(), "geom2=\"bore\"", "adhesion=\"20\""));
}

// Edited in mjModel, they are found in the next pass.
TEST_F(LaterAttributes, AnEditIsRefusedInTheNextPass) {
  for (const bool surface : {true, false}) {
    const ModelPointer m = load(document(Machine{}));
    const DataPointer d = start(m.get());
    mj_step(m.get(), d.get());
    (surface ? m->geom_surfacevel[5] : m->pair_adhesion[0]) = 20.0;
    EXPECT_THROW(mj_step(m.get(), d.get()), std::runtime_error) << surface;
  }
}

TEST_F(LaterAttributes, AGeneratedRingRefusesThemToo) {
  const std::string text = mjcf(shipped("bench_ring"));
  const std::string ring = std::string("name=\"") + names::kRingContact + "\"";
  expect_refused(with(text, ring, "surfacevel=\"0 0 0 0 0 600\""), "surfacevel");
  expect_refused(with(text, "<body name=\"ring\"", "gravcomp=\"1\""), "gravcomp=\"1\"");
}

// A belt at 10 m/s takes a box along with mu g, as a box that slides on a floor is braked.
TEST_F(LaterAttributes, APairThatIsCorrectedKnowsItsBelt) {
  const ModelPointer m = load(R"(<mujoco><option timestep="1e-3" cone="elliptic"/>
    <size nuserdata="32"/>
    <worldbody><geom name="belt" type="plane" size="100 100 1" surfacevel="10 0 0 0 0 0"/>
    <body pos="0 0 0.1"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 0 1"/>
      <geom name="box" type="sphere" size="0.1" mass="1"/></body></worldbody>
    <contact><pair name="sliding" geom1="belt" geom2="box" condim="3" friction="0.5 0.5 0 0 0"/>
    </contact>
    <custom><text name="rotorub_cone_coulomb_pair" data="sliding"/></custom></mujoco>)");
  const DataPointer d = start(m.get());
  for (int k = 0; k < 1000; ++k) mj_step(m.get(), d.get());
  EXPECT_NEAR(d->qvel[0], 0.5 * 9.81, 0.01);
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
