// MuJoCo's force, torque and touch sensors beside a contact whose force the plugin computes:
// Newton's law of the rotor gives their values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact_force.h"
#include "plugin/load_cells.h"
#include "plugin/make_config.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

constexpr double kDiscMass = 2.0, kSpinInertia = 1e-3, kRingMass = 1.0;

const std::string kCells = R"(<sensor>
    <force name="cell" site="cell"/><torque name="moment" site="cell"/><force name="held" site="held"/>
    <touch name="pad" site="pad"/>)";
const std::string kSites = R"(<site name="cell"/><site name="pad" type="box" size="1 1 1"/>)";

class LoadCells : public HookedTest {
 protected:
  // The machine of machine.h with cells below ring and rotor.
  static std::string with_cells(Machine x) {
    x.ring_geoms += kSites;
    return replaced(replaced(document(x), "<sensor>", kCells), "<body name=\"shaft\">",
                    "<body name=\"shaft\"><site name=\"held\"/>");
  }
  static const mjtNum* data(const mjModel* m, const mjData* d, const char* name) {
    return d->sensordata + m->sensor_adr[mj_name2id(m, mjOBJ_SENSOR, name)];
  }
  // Pressed and whirling, 0.02 s: blows, then a rub.
  template <typename Check>
  static void run(const mjModel* m, Check check) {
    const DataPointer d = start(m);
    d->qvel[0] = 0.2;
    d->qvel[1] = 0.3;
    d->qvel[2] = 300.0;
    int touched = 0;
    for (int k = 0; k < 2000; ++k) {
      d->qfrc_applied[0] = 200.0;
      d->qfrc_applied[1] = -50.0;
      mj_step(m, d.get());
      touched += sensor(m, d.get(), "normal_force") > 0.0;
      check(d.get());
    }
    EXPECT_GT(touched, 100);
  }
};

// On a ring at rest m a = applied + F, and the cell reads the force on the ring, F.
TEST_F(LoadCells, BelowARingThatStands) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    x.friction = 0.2;
    x.ring_moves = false;
    const ModelPointer m = load(with_cells(x));
    run(m.get(), [&](const mjData* d) {
      const double fx = kDiscMass * d->qacc[0] - d->qfrc_applied[0];
      const double fy = kDiscMass * d->qacc[1] - d->qfrc_applied[1];
      const double size = 1e-9 * (200.0 + std::hypot(fx, fy));
      const mjtNum* cell = data(m.get(), d, "cell");
      EXPECT_NEAR(cell[0], fx, size) << contact << " " << d->time;
      EXPECT_NEAR(cell[1], fy, size) << contact << " " << d->time;
      EXPECT_NEAR(cell[2], 0.0, size);
      // A force that acts only on the joints is not a force between bodies.
      const mjtNum* held = data(m.get(), d, "held");
      EXPECT_NEAR(held[0], d->qfrc_applied[0], size);
      EXPECT_NEAR(held[1], d->qfrc_applied[1], size);
      // mj_contactForce and the touch sensor, if MuJoCo has the contact in its list.
      if (d->ncon == 0) return;
      const double normal = sensor(m.get(), d, "normal_force");
      mjtNum force[6];
      plugin::contact_force(m.get(), d, 0, force);
      EXPECT_NEAR(force[0], normal, 1e-3 * normal);
      EXPECT_NEAR(std::abs(force[1]), std::abs(sensor(m.get(), d, "friction_force")),
                  1e-9 * (1.0 + normal));
      EXPECT_NEAR(data(m.get(), d, "pad")[0], normal, 1e-3 * normal) << contact;
    });
  }
}

// A contact without a force shows none, although the thread still has the results of an earlier
// pass at the same time, as after mj_resetData.
TEST_F(LoadCells, ForgetTheFrictionOfAnEarlierPass) {
  Machine x;
  x.ring_moves = false;
  const ModelPointer m = load(with_cells(x));
  const DataPointer d = start(m.get());
  mj_forward(m.get(), d.get());
  const int userdata = plugin::make_config(m.get()).pairs.front().userdata;
  plugin::note_contact(d.get(), userdata, {1.0, 0.0}, 50.0);
  mj_forward(m.get(), d.get());
  EXPECT_NEAR(data(m.get(), d.get(), "cell")[2], 0.0, 1e-9);
}

// A touch sensor reads a contact whose ray out of the sensor's body meets its site, under `rigid`
// as MuJoCo has it for its own contacts.
TEST_F(LoadCells, TouchSensorsLookOutOfTheirBody) {
  const std::string inner = R"( type="box" size="0.005 0.005 0.005" pos="0.02 0 0"/>)",
                    outer = R"( type="box" size="0.005 0.005 0.005" pos="0.08 0 0"/>)";
  const auto readings = [&](const char* contact) {
    Machine x;
    x.contact = contact;
    x.ring_moves = false;
    x.ring_geoms = "<site name=\"ring_inner\"" + inner + "<site name=\"ring_outer\"" + outer;
    std::string text = replaced(document(x), "<body name=\"rotor\">",
                                "<body name=\"rotor\"><site name=\"rotor_inner\"" + inner +
                                    "<site name=\"rotor_outer\"" + outer);
    std::string sensors = "<sensor>";
    const std::vector<std::string> names{"ring_inner", "ring_outer", "rotor_inner", "rotor_outer"};
    for (const std::string& name : names)
      sensors += "<touch name=\"" + name + "\" site=\"" + name + "\"/>";
    const ModelPointer m = load(replaced(text, "<sensor>", sensors));
    const DataPointer d = start(m.get());
    d->qpos[0] = 5e-4;
    for (int k = 0; k < 3000; ++k) {
      d->qfrc_applied[0] = 100.0;
      mj_step(m.get(), d.get());
    }
    std::vector<bool> seen;
    for (const std::string& name : names)
      seen.push_back(data(m.get(), d.get(), name.c_str())[0] > 50.0);
    return seen;
  };
  const std::vector<bool> of_mujoco{true, false, false, true};
  EXPECT_EQ(readings("coulomb"), of_mujoco);
  EXPECT_EQ(readings("rigid"), of_mujoco);
}

// The forces between bodies, computed by hand in a model without any cell: for a ring that stands
// on the world, cfrc_ext is the rub on it and cfrc_int the force that it passes on.
TEST_F(LoadCells, AreNotNeededForTheForcesBetweenBodies) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    x.friction = 0.2;
    x.ring_moves = false;
    const ModelPointer m = load(document(x));
    const DataPointer d = start(m.get());
    d->qpos[0] = 5e-4;
    d->qvel[2] = 10.0;
    for (int k = 0; k < 300; ++k) {
      d->qfrc_applied[0] = 100.0;
      mj_step(m.get(), d.get());
    }
    plugin::rne_post_constraint(m.get(), d.get());
    const int ring = mj_name2id(m.get(), mjOBJ_BODY, "ring");
    for (int i = 0; i < 2; ++i) {
      const double rub = d->qfrc_applied[i] - kDiscMass * d->qacc[i];
      EXPECT_NEAR(d->cfrc_ext[6 * ring + 3 + i], rub, 1e-6) << contact << i;
      EXPECT_NEAR(d->cfrc_int[6 * ring + 3 + i], -rub, 1e-6) << contact << i;
    }
    EXPECT_GT(d->cfrc_ext[6 * ring + 3], 50.0) << contact;
  }
}

// Friction along the axis is in them too.
TEST_F(LoadCells, BelowARingThatARotorSlidesThrough) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    x.friction = 0.2;
    x.ring_moves = false;
    const std::string y = "<joint name=\"rotor_y\" type=\"slide\" axis=\"0 1 0\"/>";
    const ModelPointer m = load(
        replaced(with_cells(x), y, y + "<joint name=\"lift\" type=\"slide\" axis=\"0 0 1\"/>"));
    const DataPointer d = start(m.get());
    d->qpos[0] = 5e-4;
    d->qvel[2] = 0.1;
    d->qvel[3] = 10.0;
    double along = 0.0;
    for (int k = 0; k < 500; ++k) {
      d->qfrc_applied[0] = 100.0;
      mj_step(m.get(), d.get());
      const mjtNum* cell = data(m.get(), d.get(), "cell");
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(cell[i], kDiscMass * d->qacc[i] - d->qfrc_applied[i], 1e-7)
            << contact << " " << k << " " << i;
      }
      along = std::min(along, cell[2]);
      mjtNum force[6];
      if (d->ncon == 0) continue;
      plugin::contact_force(m.get(), d.get(), 0, force);
      EXPECT_NEAR(std::abs(force[2]), std::abs(cell[2]), 1e-7);
    }
    EXPECT_LT(along, -2.0) << contact;
  }
}

// About the ring's axis it takes what the rotor loses: J spin' + (x, y) x F.
TEST_F(LoadCells, TheMomentIsThatOfTheRub) {
  Machine x;
  x.friction = 0.2;
  x.ring_moves = false;
  const ModelPointer m = load(with_cells(x));
  const DataPointer d = start(m.get());
  d->qpos[0] = 5e-4;
  d->qvel[2] = 300.0;
  for (int k = 0; k < 200; ++k) {
    d->qfrc_applied[0] = 200.0;
    d->qfrc_applied[1] = 40.0;  // as friction pulls, so that it stays
    mj_step(m.get(), d.get());
  }
  mj_forward(m.get(), d.get());
  const double fx = kDiscMass * d->qacc[0] - 200.0, fy = kDiscMass * d->qacc[1] - 40.0;
  const double moment = kSpinInertia * d->qacc[2] + d->qpos[0] * fy - d->qpos[1] * fx;
  EXPECT_LT(moment, -1.9);
  EXPECT_NEAR(data(m.get(), d.get(), "moment")[2], moment, 1e-9);
}

// A ring that floats transmits no force.
TEST_F(LoadCells, BelowARingThatFloats) {
  Machine x;
  x.friction = 0.2;
  const ModelPointer m = load(with_cells(x));
  run(m.get(), [&](const mjData* d) {
    const mjtNum* cell = data(m.get(), d, "cell");
    const double size = 1e-9 * (1.0 + kRingMass * std::hypot(d->qacc[3], d->qacc[4]));
    EXPECT_NEAR(cell[0], 0.0, size) << d->time;
    EXPECT_NEAR(cell[1], 0.0, size) << d->time;
  });
}

// Two rings in one holder.
TEST_F(LoadCells, OfSeveralContactsHaveTheSum) {
  for (const char* contact : {"rigid", "coulomb"}) {
    TwoRings x;
    x.contact = contact;
    x.friction = 0.2;
    x.sensors = R"(<force name="cell" site="cell"/><force name="other" site="other"/>
      <user name="later" objtype="body" objname="shaft" datatype="real" needstage="acc" dim="1"/>)";
    std::string text = document(x);
    for (const auto& [ring, site] : {std::pair{"ring", "cell"}, std::pair{"holder", "other"}}) {
      const std::string body = "<geom name=\"" + std::string(ring) + "\"";
      text = replaced(text, body, "<site name=\"" + std::string(site) + "\"/>" + body);
    }
    const ModelPointer m = load(text);
    const DataPointer d = start(m.get());
    d->qvel[0] = 0.2;
    d->qvel[4] = 300.0;
    int touched = 0;
    for (int k = 0; k < 2000; ++k) {
      d->qfrc_applied[0] = 200.0;
      d->qfrc_applied[1] = -50.0;
      mj_step(m.get(), d.get());
      touched += sensor(m.get(), d.get(), "normal_force") > 0.0;
      const double size = 1e-9 * (200.0 + 2.0 * std::hypot(d->qacc[0], d->qacc[1]));
      const mjtNum *one = data(m.get(), d.get(), "cell"), *two = data(m.get(), d.get(), "other");
      EXPECT_NEAR(one[0] + two[0], 2.0 * d->qacc[0] - 200.0, size) << contact << " " << d->time;
      EXPECT_NEAR(one[1] + two[1], 2.0 * d->qacc[1] + 50.0, size) << contact << " " << d->time;
    }
    EXPECT_GT(touched, 50) << contact;
  }
}

// In generated models: the force between ring and rotor, on the modal chain and on segments.
TEST_F(LoadCells, OfAGeneratedRingHaveTheRub) {
  for (const char* rotor : {"modal", "segments"}) {
    for (const char* contact : {"rigid", "coulomb"}) {
      const std::vector<std::string> overrides{"mujoco.contact=\"" + std::string(contact) + "\""};
      const bool modal = rotor == std::string("modal");
      std::string text =
          mjcf(modal ? shipped("bench_ring", overrides) : parsed(kSegmentRub, overrides));
      text = replaced(text, "<body name=\"ring\">", "<body name=\"ring\"><site name=\"cell\"/>");
      text = replaced(
          text, "<sensor>",
          "<sensor><force name=\"cell\" site=\"cell\"/><user name=\"later\" objtype=\"body\" "
          "objname=\"ring\" datatype=\"real\" needstage=\"acc\" dim=\"1\"/>");
      const ModelPointer m = load(text);
      const DataPointer d = start(m.get());
      int touched = 0;
      for (int k = 0; k < 4000; ++k) {
        mj_step(m.get(), d.get());
        const double normal = sensor(m.get(), d.get(), mjcf_names::kNormalForce);
        const double friction = sensor(m.get(), d.get(), mjcf_names::kFrictionForce);
        if (!(normal > 0.0)) continue;
        ++touched;
        const mjtNum* cell = data(m.get(), d.get(), "cell");
        const double whole = std::hypot(normal, friction);
        ASSERT_NEAR(std::hypot(cell[0], cell[1]), whole, 1e-3 * whole)
            << rotor << " " << contact << " " << k;
      }
      EXPECT_GT(touched, 1) << rotor << " " << contact;
    }
  }
}

TEST_F(LoadCells, AreRefusedWhereNothingIsCalledAfterThem) {
  Machine x;
  x.ring_geoms = kSites;
  std::string text =
      replaced(document(x), "<sensor>", "<sensor><force name=\"cell\" site=\"cell\"/>");
  for (int i = 0; i < 2; ++i) text = replaced(text, "needstage=\"acc\"", "needstage=\"vel\"");
  EXPECT_TRUE(contains(load_refusal(text), {"<sensor name=\"cell\">", "preload the plugin"}));
  // MuJoCo alone computes a cell that carries neither rotor nor ring.
  x.ring_geoms = "";
  x.bodies = R"(<body name="aside"><site name="cell"/><geom size="0.01"/></body>)";
  text = replaced(document(x), "<sensor>", "<sensor><force name=\"cell\" site=\"cell\"/>");
  for (int i = 0; i < 2; ++i) text = replaced(text, "needstage=\"acc\"", "needstage=\"vel\"");
  load(text);
}

#if mjVERSION_HEADER >= 335
TEST_F(LoadCells, ContactSensorsAreRefused) {
  Machine x;
  const auto with = [&](const std::string& sensor) {
    return replaced(document(x), "<sensor>", "<sensor>" + sensor);
  };
  expect_refused(with("<contact name=\"pad\" geom1=\"disc\" data=\"found force\"/>"),
                 "<sensor name=\"pad\">");
  load(with("<contact name=\"pad\" geom1=\"disc\" data=\"found dist\"/>"));
}
#endif

}  // namespace
}  // namespace rotorub::test
