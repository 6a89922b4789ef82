// A rotor that moves along the axis of its ring: friction in both directions of the tangent plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "plugin/config_cache.h"
#include "plugin/contact/forces.h"
#include "plugin/hooks.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr double kLiftMass = 2.0, kLiftRadius = 0.05, kPlay = 5e-4, kWeight = 19.62,
                 kLiftStep = 1e-5;

// A rotor of 2 kg in a fixed ring, on slides across and along the axis and a hinge, unless `joints`
// says otherwise.
struct Lift {
  std::string across = R"(<joint type="slide" axis="0 1 0"/>)";
  std::string joints = "";
  double inertia = 5e-3;  // kg m^2, about every axis: m r^2
  double armature = 0.0;  // of the spin
  double friction = 0.5, restitution = 0.0, tangential = 0.0, step = kLiftStep;
  std::string contact = "rigid";
  std::string turn = "1 0 0 0";  // of the whole machine
  std::string bodies = "", more = "";
};

std::string document(const Lift& x) {
  const std::string soft = " solref=\"-4e8 -39900\" solimp=\"0.9999 0.9999 0.001\" margin=\"5e-7\"";
  const std::string both = number(x.friction) + " " + number(x.friction);
  const std::string pair = x.contact == "rigid"  ? R"(condim="1" margin="5e-6" gap="1")"
                           : x.contact == "cone" ? "condim=\"3\" friction=\"" + both + "\"" + soft
                                                 : "condim=\"1\"" + soft;
  const std::string joints = !x.joints.empty()
                                 ? x.joints
                                 : R"(<joint name="press" type="slide" axis="1 0 0"/>)" + x.across +
                                       R"(<joint name="lift" type="slide" axis="0 0 1"/>
      <joint name="spin" type="hinge" axis="0 0 1" armature=")" +
                                       number(x.armature) + "\"/>";
  const bool free = joints == "<freejoint/>";
  const std::string frame = "<body name=\"frame\" quat=\"" + x.turn + "\">";
  const auto sensor = [](const std::string& name) {
    return "<user name=\"" + name +
           R"(" objtype="geom" objname="disc" datatype="real" needstage="acc" dim="1"/>)";
  };
  const auto numeric = [](const std::string& name, double value) {
    return "<numeric name=\"rotorub_" + name + "\" data=\"" + number(value) + "\"/>";
  };
  return "<mujoco><option timestep=\"" + number(x.step) +
         "\" gravity=\"0 0 0\" collision=\"predefined\" cone=\"elliptic\" "
         "tolerance=\"1e-14\"/><size nuserdata=\"40\"/>"
         "<worldbody>" +
         (free ? "" : frame) + R"(<body name="rotor">)" + joints +
         "<inertial pos=\"0 0 0\" mass=\"2\" diaginertia=\"" + number(x.inertia) + " " +
         number(x.inertia) + " " + number(x.inertia) +
         R"("/><geom name="disc" type="sphere" size="0.05"/></body>)" + (free ? frame : "") +
         x.bodies +
         R"(<geom name="bore" type="sphere" size="0.0505"/></body></worldbody>
    <contact><pair geom1="disc" geom2="bore" )" +
         pair + "/></contact>" + x.more + "<sensor>" + sensor("normal_force") +
         sensor("friction_force") + sensor("slip") + sensor("rotorub_active") +
         R"(</sensor><custom><text name="rotorub_rotor_geom" data="disc"/><text name="rotorub_ring_geom" data="bore"/>
    <text name="rotorub_contact" data=")" +
         x.contact + "\"/>" + numeric("clearance", kPlay) + numeric("friction", x.friction) +
         (x.contact == "rigid" ? numeric("restitution", x.restitution) : "") +
         (x.tangential > 0.0 ? numeric("tangential_restitution", x.tangential) : "") +
         "</custom></mujoco>";
}

// A rotor that is turned by nothing but friction: across the press it is held.
Lift held_across() {
  Lift x;
  x.across = "";
  return x;
}

class Axial : public MujocoTest {
 protected:
  // Coordinates and speeds of Lift's joints.
  static double& of(const mjModel* m, mjtNum* all, const char* joint) {
    return all[m->jnt_dofadr[mj_name2id(m, mjOBJ_JOINT, joint)]];
  }
  // Pressed against the ring with 100 N, under its weight.
  static DataPointer pressed(const mjModel* m, double along = 0.0, double spin = 0.0) {
    DataPointer d = start(m);
    of(m, d->qpos, "press") = kPlay;
    of(m, d->qvel, "lift") = along;
    of(m, d->qvel, "spin") = spin;
    of(m, d->qfrc_applied, "press") = 100.0;
    of(m, d->qfrc_applied, "lift") = -kWeight;
    return d;
  }
  static void run(const mjModel* m, mjData* d, double time) {
    const long steps = std::lround(time / m->opt.timestep);
    for (long i = 0; i < steps; ++i) mj_step(m, d);
  }
  plugin::Hooks hooks_;
};

TEST_F(Axial, FallsWithItsWeightLessFriction) {
  Lift x;
  x.friction = 0.1;
  const ModelPointer m = load(document(x));
  const DataPointer d = pressed(m.get());
  run(m.get(), d.get(), 0.1);
  EXPECT_NEAR(of(m.get(), d->qvel, "lift"), -0.1 * (kWeight - 10.0) / kLiftMass, 1e-12);
  EXPECT_EQ(sensor(m.get(), d.get(), "rotorub_active"), 1.0);
  EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 100.0, 1e-9);
  EXPECT_NEAR(sensor(m.get(), d.get(), "friction_force"), 0.0, 1e-9);  // none along the ring
}

// Normal force by MuJoCo's solver, friction beside it.
TEST_F(Axial, CoulombHasBothDirectionsToo) {
  for (const double mu : {0.1, 0.5}) {
    Lift x;
    x.friction = mu;
    x.contact = "coulomb";
    const ModelPointer m = load(document(x));
    const DataPointer d = pressed(m.get(), mu == 0.1 ? 0.0 : -0.2);
    run(m.get(), d.get(), 0.1);
    const double speed = mu == 0.1 ? -0.1 * (kWeight - 10.0) / kLiftMass : 0.0;
    EXPECT_NEAR(of(m.get(), d->qvel, "lift"), speed, 1e-5) << mu;
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 100.0, 1e-3) << mu;
    if (mu == 0.1) continue;
    EXPECT_LT(std::abs(of(m.get(), d->qvel, "lift")), 1e-12);
  }
  Lift x = held_across();
  x.contact = "coulomb";
  const ModelPointer m = load(document(x));
  const DataPointer d = pressed(m.get(), 4.0, 3.0 / kLiftRadius);
  of(m.get(), d->qfrc_applied, "lift") = 0.0;
  run(m.get(), d.get(), 0.02);
  const double left = 1.0 - 0.02 * 50.0 / kLiftMass / 5.0;
  EXPECT_NEAR(of(m.get(), d->qvel, "lift"), 4.0 * left, 1e-4);
  EXPECT_NEAR(of(m.get(), d->qvel, "spin") * kLiftRadius, 3.0 * left, 1e-4);
  EXPECT_NEAR(sensor(m.get(), d.get(), "friction_force"), -30.0, 1e-2);
}

// MuJoCo's own cone has both directions in the frame of its contact. Its friction reference lets a
// contact that slides hop; on the mean it brakes as it should.
TEST_F(Axial, AsMujocosCone) {
  for (const double mu : {0.1, 0.5}) {
    Lift x;
    x.friction = mu;
    x.contact = "cone";
    const ModelPointer m = load(document(x));
    const DataPointer d = pressed(m.get());
    int sliding = 0, closed = 0;
    for (int i = 0; i < 10000; ++i) {
      mj_step(m.get(), d.get());
      const Mode mode =
          plugin::contact_forces(*plugin::find_config(m.get(), d.get()), m.get(), d.get()).mode;
      closed += mode == Mode::kFree ? 0 : 1;
      sliding += mode == Mode::kSlide ? 1 : 0;
    }
    const double speed = mu == 0.1 ? -0.1 * (kWeight - 10.0) / kLiftMass : 0.0;
    EXPECT_NEAR(of(m.get(), d->qvel, "lift"), speed, 5e-3) << mu;
    EXPECT_NEAR(sensor(m.get(), d.get(), "friction_force"), 0.0, 1e-9) << mu;
    EXPECT_GT(closed, 100);
    if (mu == 0.1) {
      EXPECT_GT(sliding, 9 * closed / 10);  // though it does not slip round the ring
      continue;
    }
    EXPECT_LT(sliding, closed / 10);
    EXPECT_NEAR(sensor(m.get(), d.get(), "normal_force"), 100.0, 1e-2);
    ASSERT_EQ(d->ncon, 1);
    EXPECT_NEAR(std::abs(d->efc_force[d->contact[0].efc_address + 2]), kWeight, 1e-2);
  }
}

// A pair that has one value of friction has MuJoCo's default, 1, for the second.
TEST_F(Axial, TheConesTwoFrictionsAreHeldAgainstTheText) {
  Lift x;
  x.contact = "cone";
  std::string error;
  EXPECT_FALSE(try_load(replaced(document(x), "friction=\"0.5 0.5\"", "friction=\"0.5\""), error));
  EXPECT_NE(error.find("friction along the axis, the second value, is 1"), std::string::npos)
      << error;
}

// mu N = 50 N is beyond the weight: it brakes with the difference, and then stands, not creeping.
TEST_F(Axial, StopsAndSticksUnderItsWeight) {
  const ModelPointer m = load(document(Lift{}));
  const DataPointer d = pressed(m.get(), -1.0);
  const double braking = (50.0 - kWeight) / kLiftMass;
  double &speed = of(m.get(), d->qvel, "lift"), &height = of(m.get(), d->qpos, "lift");
  run(m.get(), d.get(), 0.05);
  EXPECT_NEAR(speed, -1.0 + 0.05 * braking, 1e-12);
  run(m.get(), d.get(), 0.05);
  EXPECT_LT(std::abs(speed), 1e-15);
  const double where = height;
  EXPECT_NEAR(where, -0.5 / braking, 1e-5);
  run(m.get(), d.get(), 0.1);
  EXPECT_LT(std::abs(height - where), 1e-14);
}

// As heavy round its axis as along it, J = m r^2: the slip keeps its direction and falls by mu N /
// m.
TEST_F(Axial, FrictionIsSharedAsTheSlipIs) {
  const ModelPointer m = load(document(held_across()));
  const DataPointer d = pressed(m.get(), 4.0, 3.0 / kLiftRadius);
  of(m.get(), d->qfrc_applied, "lift") = 0.0;
  run(m.get(), d.get(), 0.1);
  const double left = 1.0 - 0.1 * 50.0 / kLiftMass / 5.0;
  constexpr double kManySteps = 1e-11;  // m/s, round-off of 10,000
  EXPECT_NEAR(of(m.get(), d->qvel, "lift"), 4.0 * left, kManySteps);
  EXPECT_NEAR(of(m.get(), d->qvel, "spin") * kLiftRadius, 3.0 * left, kManySteps);
  EXPECT_NEAR(sensor(m.get(), d.get(), "friction_force"), -30.0, 1e-9);
}

// A rotor that spins fast sinks slowly, as friction has little left for the axis:
//   m v' = -m g - mu N v / sqrt(v^2 + (r Omega)^2),   at the end v = -r Omega s / sqrt(1 - s^2), s
//   = m g / (mu N)
TEST_F(Axial, AFastRotorCreepsAlongItsAxis) {
  const double around = 0.5, share = kWeight / 50.0;
  const auto exact = [&](double time) {
    double v = 0.0;
    constexpr int kSteps = 2000;
    const double h = time / kSteps;
    const auto slope = [&](double u) {
      return -(kWeight + 50.0 * u / std::hypot(u, around)) / kLiftMass;
    };
    for (int i = 0; i < kSteps; ++i) {
      const double a = slope(v), b = slope(v + 0.5 * h * a), c = slope(v + 0.5 * h * b),
                   e = slope(v + h * c);
      v += h / 6.0 * (a + 2.0 * b + 2.0 * c + e);
    }
    return v;
  };
  double errors[2];
  for (int k = 0; k < 2; ++k) {
    Lift x = held_across();
    x.armature = 1e9;
    x.step = k == 0 ? 2e-5 : 1e-5;
    const ModelPointer m = load(document(x));
    const DataPointer d = pressed(m.get(), 0.0, around / kLiftRadius);
    run(m.get(), d.get(), 0.02);
    errors[k] = std::abs(of(m.get(), d->qvel, "lift") - exact(0.02));
    run(m.get(), d.get(), 1.0);
    EXPECT_NEAR(of(m.get(), d->qvel, "lift"), -around * share / std::sqrt(1.0 - share * share),
                1e-8);
  }
  EXPECT_LT(errors[1], kLiftStep * kWeight / kLiftMass);  // what a step changes
  EXPECT_NEAR(errors[0] / errors[1], 2.0, 0.1);           // first order in the step
}

// A ball on a free joint strikes obliquely: sliding and, with more friction, sticking; closed form
// of a mobility 1/m + r^2/J in both directions.
TEST_F(Axial, AnObliqueBlowOfABall) {
  for (const double mu : {0.1, 2.0}) {
    Lift x;
    x.joints = "<freejoint/>";
    x.inertia = 2e-3;
    x.friction = mu;
    x.restitution = 0.5;
    const ModelPointer m = load(document(x));
    const DataPointer d = start(m.get());
    const std::array<double, 6> v{1.0, 2.0, -1.5, 3.0, 8.0, 10.0};
    d->qpos[0] = kPlay - 0.5 * kLiftStep;
    std::copy(v.begin(), v.end(), d->qvel);
    mj_step(m.get(), d.get());
    const double r = kLiftRadius, normal = 1.5 * kLiftMass;
    const double around = v[1] + r * v[5], along = v[2] - r * v[4],
                 slip = std::hypot(around, along);
    const double friction = std::min(mu * normal, slip / (1.0 / kLiftMass + r * r / x.inertia));
    const double t = -friction * around / slip, z = -friction * along / slip;
    EXPECT_NEAR(d->qvel[0], -0.5, 1e-12);
    EXPECT_NEAR(d->qvel[1], v[1] + t / kLiftMass, 1e-12) << mu;
    EXPECT_NEAR(d->qvel[2], v[2] + z / kLiftMass, 1e-12) << mu;
    EXPECT_NEAR(d->qvel[3], v[3], 1e-12) << mu;
    EXPECT_NEAR(d->qvel[4], v[4] - r * z / x.inertia, 1e-12) << mu;
    EXPECT_NEAR(d->qvel[5], v[5] + r * t / x.inertia, 1e-12) << mu;
  }
}

TEST_F(Axial, ATurnedMachineMovesAlike) {
  Lift x;
  x.friction = 0.3;
  x.restitution = 0.5;
  const auto end = [&](const std::string& turn) {
    x.turn = turn;
    const ModelPointer m = load(document(x));
    const DataPointer d = pressed(m.get(), 0.7, 30.0);
    of(m.get(), d->qpos, "press") = 0.0;
    run(m.get(), d.get(), 0.05);
    return state_of(m.get(), d.get());
  };
  const std::vector<double> upright = end("1 0 0 0"), turned = end("0.5 -0.7 0.3 0.41");
  for (std::size_t i = 0; i < upright.size(); ++i) {
    EXPECT_NEAR(turned[i], upright[i], 1e-9 * (1.0 + std::abs(upright[i]))) << i;
  }
}

// A ball that bounces about, with tangential restitution and without.
TEST_F(Axial, NoEnergyIsGained) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const double tangential : {0.0, 0.8}) {
    Lift x;
    x.joints = "<freejoint/>";
    x.inertia = 2e-3;
    x.friction = 0.4;
    x.restitution = 0.9;
    x.tangential = tangential;
    const ModelPointer m = load(document(x));
    for (int k = 0; k < 20; ++k) {
      const DataPointer d = start(m.get());
      for (int i = 0; i < 3; ++i) d->qvel[i] = normal(random);
      for (int i = 3; i < 6; ++i) d->qvel[i] = 30.0 * normal(random);
      const auto energy = [&] {
        double sum = 0.0;
        for (int i = 0; i < 6; ++i)
          sum += 0.5 * (i < 3 ? kLiftMass : x.inertia) * d->qvel[i] * d->qvel[i];
        return sum;
      };
      double before = energy();
      const double first = before;
      for (int i = 0; i < 1000; ++i) {
        mj_step(m.get(), d.get());
        ASSERT_LE(energy(), before * (1.0 + 1e-12)) << k << " " << i;
        before = energy();
      }
      EXPECT_LT(before, first);
    }
  }
}

// A shaft on a free joint in two rings 2 a apart, pressed in the middle: it slides down with m g -
// mu N, and the rings bear unlike shares, as friction acts beside the middle: N = N_0 / 2 (1 +- mu
// r / a).
TEST_F(Axial, AShaftInTwoRings) {
  TwoRings x;
  x.friction = 0.15;
  std::string text = document(x);
  for (const char* axis : {"1 0 0", "0 1 0"})
    text = replaced(text, std::string("<joint type=\"hinge\" axis=\"") + axis + "\"/>", "");
  text =
      replaced(text, R"(<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>)", "");
  text = replaced(text, R"(<joint type="hinge" axis="0 0 1"/>)", "<freejoint/>");
  const ModelPointer m = load(text);
  const DataPointer d = start(m.get());
  d->qpos[0] = kPlay;
  d->qfrc_applied[0] = 100.0;
  d->qfrc_applied[2] = -kWeight;
  run(m.get(), d.get(), 1e-3);
  EXPECT_NEAR(d->qvel[2], -1e-3 * (kWeight - 15.0) / kLiftMass, 1e-9);
  const double one = sensor(m.get(), d.get(), "normal_force"),
               two = sensor(m.get(), d.get(), "normal_force_2");
  EXPECT_NEAR(one + two, 100.0, 1e-6);
  EXPECT_NEAR(std::abs(one - two), 100.0 * 0.15 * 0.5, 1e-4);
}

// The ring moves instead, on a damper: what friction takes from the rotor it gives to the ring. At
// the end the ring falls no faster than its damper lets it, c v = mu N.
TEST_F(Axial, ARingThatIsDraggedAlong) {
  Lift x;
  x.friction = 0.1;
  x.joints =
      R"(<joint name="press" type="slide" axis="1 0 0"/><joint name="spin" type="hinge" axis="0 0 1"/>
      <joint name="lift" type="slide" axis="0 0 1"/>)";
  const std::string text =
      replaced(document(x), R"(<geom name="bore")",
               R"(<body name="holder"><joint name="ring" type="slide" axis="0 0 1" damping="20"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/><geom name="bore")");
  const ModelPointer m = load(replaced(text, "size=\"0.0505\"/>", "size=\"0.0505\"/></body>"));
  const DataPointer d = pressed(m.get(), -1.0);
  run(m.get(), d.get(), 0.01);
  const double first = 1.0 - std::exp(-20.0 * 0.01);  // of 1 kg on 20 N s/m
  EXPECT_NEAR(of(m.get(), d->qvel, "ring"), -0.5 * first, 1e-4);
  EXPECT_NEAR(of(m.get(), d->qvel, "lift"), -1.0 - 0.01 * (kWeight - 10.0) / kLiftMass, 1e-12);
  run(m.get(), d.get(), 1.0);
  EXPECT_NEAR(of(m.get(), d->qvel, "ring"), -0.5, 1e-8);
}

// What is told apart is the machine, not its names: the same document with another axis.
TEST_F(Axial, ModelsThatDifferInAnAxisAlone) {
  const std::string lifts = document(Lift{}),
                    stays = replaced(lifts, "name=\"lift\" type=\"slide\" axis=\"0 0 1\"",
                                     "name=\"lift\" type=\"slide\" axis=\"0 1 0\"");
  for (const std::string* text : {&stays, &lifts, &stays}) {
    const ModelPointer m = load(*text);
    const DataPointer d = pressed(m.get(), -1.0);
    run(m.get(), d.get(), 1e-3);
    const double friction = sensor(m.get(), d.get(), "friction_force");
    if (text == &lifts) {
      EXPECT_NEAR(of(m.get(), d->qvel, "lift"), -1.0 + 1e-3 * (50.0 - kWeight) / kLiftMass, 1e-12);
    } else {
      EXPECT_GT(std::abs(friction), 10.0);
    }
  }
}

// Tied along its axis to 3 kg: friction brakes both.
TEST_F(Axial, BesideAConstraint) {
  for (const char* contact : {"rigid", "coulomb"}) {
    Lift x;
    x.friction = 0.1;
    x.contact = contact;
    x.bodies = R"(<body name="weight" pos="1 0 0"><joint name="weight" type="slide" axis="0 0 1"/>
      <inertial pos="0 0 0" mass="3" diaginertia="1 1 1"/></body>)";
    x.more = equality("<joint joint1=\"lift\" joint2=\"weight\"" + kHard + "/>");
    const ModelPointer m = load(document(x));
    const DataPointer d = pressed(m.get());
    run(m.get(), d.get(), 0.1);
    EXPECT_NEAR(of(m.get(), d->qvel, "lift"), -0.1 * (kWeight - 10.0) / 5.0, 1e-3) << contact;
  }
}

}  // namespace
}  // namespace rotorub::test
