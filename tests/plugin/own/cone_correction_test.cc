// The correction of MuJoCo's friction cone for sliding (plugin/contact/cone.h) on geoms of MuJoCo's
// own, named by a user: a sliding body brakes with mu g and stays down, with any cone, solver and
// friction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

constexpr double kGravity = 9.81;

struct Slide {
  std::string body = R"(<geom name="body" type="sphere" size="0.1" mass="1"/>)";
  std::string joints =
      R"(<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint type="slide" axis="0 0 1"/>)";
  double height = 0.1;  // m
  double friction = 0.5;
  int condim = 3;
  std::string further;  // bodies
  std::string elements;
  std::string custom = R"(<text name="rotorub_cone_coulomb_pair" data="sliding"/>)";
};

std::string document(const Slide& s) {
  const std::string mu = std::to_string(s.friction);
  return R"(<mujoco><option timestep="0.001"/><size nuserdata="21"/>
<worldbody><geom name="floor" type="plane" size="100 100 1"/>
<body name="body" pos="0 0 )" +
         std::to_string(s.height) + "\">" + s.joints + s.body + "</body>" + s.further +
         R"(</worldbody>
<contact><pair name="sliding" geom1="floor" geom2="body" condim=")" +
         std::to_string(s.condim) + "\" friction=\"" + mu + " " + mu +
         R"( 1e-5 1e-7 1e-7"/></contact>)" + s.elements + "<custom>" + s.custom +
         "</custom></mujoco>";
}

class ConeCorrection : public HookedTest {
 protected:
  struct Motion {
    double lost = 0.0;     // m/s, of the speed
    double contact = 0.0;  // share of the steps
    double force = 0.0;    // N, mean normal force
    double across = 0.0;   // m/s, at the end
  };
  static Motion slid(const mjModel* m, double speed, double angle = 0.0, int steps = 1000) {
    const DataPointer d(mj_makeData(m));
    d->qvel[0] = speed * std::cos(angle);
    d->qvel[1] = speed * std::sin(angle);
    Motion out;
    for (int k = 0; k < steps; ++k) {
      mj_step(m, d.get());
      double normal = 0.0;
      for (int i = 0; i < d->ncon; ++i) {
        mjtNum force[6];
        mj_contactForce(m, d.get(), i, force);
        normal += force[0];
      }
      out.contact += normal > 0.0 ? 1.0 / steps : 0.0;
      out.force += normal / steps;
    }
    out.lost = speed - (d->qvel[0] * std::cos(angle) + d->qvel[1] * std::sin(angle));
    out.across = d->qvel[1] * std::cos(angle) - d->qvel[0] * std::sin(angle);
    return out;
  }
};

TEST_F(ConeCorrection, WithoutItMujocosDefaultsLoseTheContact) {
  Slide s;
  s.custom = "";
  const ModelPointer m = load(document(s));
  EXPECT_LT(slid(m.get(), 10.0).contact, 0.1);
}

TEST_F(ConeCorrection, WhatSlidesBrakesWithMuG) {
  for (const int cone : {int{mjCONE_ELLIPTIC}, int{mjCONE_PYRAMIDAL}}) {
    for (const int solver : {int{mjSOL_NEWTON}, int{mjSOL_CG}, int{mjSOL_PGS}}) {
      const ModelPointer m = load(document({}));
      m->opt.cone = cone;
      m->opt.solver = solver;
      m->opt.tolerance = 0.0;
      m->opt.iterations = 200;
      for (const double speed : {5.5, 10.0, 100.0}) {
        const Motion x = slid(m.get(), speed);
        SCOPED_TRACE(std::to_string(cone) + " " + std::to_string(solver) + " " +
                     std::to_string(speed));
        EXPECT_GT(x.contact, 0.995);
        EXPECT_NEAR(x.force, kGravity, 2e-3 * kGravity);
        EXPECT_NEAR(x.lost, 0.5 * kGravity, 2e-3 * kGravity);
      }
    }
  }
}

// The ellipse is round. The pyramid is MuJoCo's: along its edge it brakes with mu / sqrt 2.
TEST_F(ConeCorrection, AcrossTheAxesToo) {
  const ModelPointer m = load(document({}));
  for (const double angle : {0.3, 0.7853981633974483, 2.0, -1.0}) {
    m->opt.cone = mjCONE_ELLIPTIC;
    const Motion x = slid(m.get(), 10.0, angle);
    EXPECT_NEAR(x.lost, 0.5 * kGravity, 2e-3 * kGravity) << angle;
    EXPECT_NEAR(x.across, 0.0, 1e-6) << angle;
    EXPECT_GT(x.contact, 0.995) << angle;
    m->opt.cone = mjCONE_PYRAMIDAL;
    const Motion y = slid(m.get(), 10.0, angle);
    EXPECT_GT(y.contact, 0.995) << angle;
    EXPECT_NEAR(y.force, kGravity, 5e-3 * kGravity) << angle;
  }
}

// A sphere that may roll, with frictions where y_T of the step before would not do: mu^2 A_TT /
// A_NN = 3.5 mu^2 > 1.
TEST_F(ConeCorrection, StrongFrictionAndARollingSphere) {
  for (const double friction : {0.2, 0.5, 0.8, 1.5}) {
    Slide s;
    s.joints = "<freejoint/>";
    s.friction = friction;
    const ModelPointer m = load(document(s));
    m->opt.cone = mjCONE_ELLIPTIC;
    const double speed = 10.0, t = 0.1;
    const Motion x = slid(m.get(), speed, 0.0, 100);
    EXPECT_NEAR(x.lost, friction * kGravity * t, 0.02 * friction * kGravity * t) << friction;
    EXPECT_GT(x.contact, 0.97) << friction;
    EXPECT_NEAR(slid(m.get(), 3.0, 0.0, 2000).lost, 3.0 * 2.0 / 7.0, 0.01)
        << friction << ": it rolls then";
  }
}

// Four corners share the load, each with the torsional friction of condim 4, or with rolling
// friction too.
TEST_F(ConeCorrection, ABoxOnFourCorners) {
  for (const int condim : {3, 4, 6}) {
    Slide s;
    s.body = R"(<geom name="body" type="box" size="0.2 0.2 0.05" mass="1"/>)";
    s.height = 0.05;
    s.joints = "<freejoint/>";
    s.condim = condim;
    for (const int cone : {int{mjCONE_ELLIPTIC}, int{mjCONE_PYRAMIDAL}}) {
      const ModelPointer m = load(document(s));
      m->opt.cone = cone;
      const Motion x = slid(m.get(), 10.0);
      EXPECT_NEAR(x.lost, 0.5 * kGravity, 0.01 * kGravity) << condim << " " << cone;
      EXPECT_GT(x.contact, 0.99) << condim << " " << cone;
      EXPECT_NEAR(x.force, kGravity, 0.01 * kGravity) << condim << " " << cone;
    }
  }
}

// A cube of 0.1 m stops after v^2 / (2 mu g) and v / (mu g), and its corners stay down.
TEST_F(ConeCorrection, ACubeSlidesToItsStop) {
  constexpr double kSpeed = 6.0, kFriction = 0.5;
  Slide s;
  s.body = R"(<geom name="body" type="box" size="0.05 0.05 0.05" mass="1"/>)";
  s.height = 0.05;
  s.joints = "<freejoint/>";
  const ModelPointer m = load(document(s));
  const DataPointer d(mj_makeData(m.get()));
  d->qvel[0] = kSpeed;
  double stopped = 0.0, highest = 0.0;  // s; m above the height at rest on the floor
  while (d->time < 1.5) {
    mj_step(m.get(), d.get());
    if (d->qvel[0] > 1e-3) stopped = d->time;
    highest = std::max(highest, d->qpos[2] - s.height);
  }
  EXPECT_NEAR(d->qpos[0], 0.5 * kSpeed * kSpeed / (kFriction * kGravity), 0.01);
  EXPECT_NEAR(stopped, kSpeed / (kFriction * kGravity), 5e-3);
  EXPECT_LT(highest, 1e-5);
  EXPECT_LT(std::hypot(d->qpos[4], d->qpos[5], d->qpos[6]), 1e-3) << "half the angle it has turned";
}

// A pull below mu m g is held, and one above it accelerates the box by the difference.
TEST_F(ConeCorrection, ABoxIsHeldUpToMuTimesItsWeight) {
  Slide s;
  s.body = R"(<geom name="body" type="box" size="0.2 0.2 0.05" mass="1"/>)";
  s.height = 0.05;
  s.joints = "<freejoint/>";
  for (const int cone : {int{mjCONE_ELLIPTIC}, int{mjCONE_PYRAMIDAL}}) {
    for (const double pull : {0.0, 0.4, 0.6}) {
      const ModelPointer m = load(document(s));
      m->opt.cone = cone;
      const DataPointer d(mj_makeData(m.get()));
      d->qfrc_applied[0] = pull * kGravity;
      for (int k = 0; k < 500; ++k) mj_step(m.get(), d.get());
      const double speed = 0.5 * std::max(0.0, pull - 0.5) * kGravity;
      EXPECT_NEAR(d->qvel[0], speed, 2e-3 * kGravity) << cone << " " << pull;
    }
  }
}

// Other constraints of MuJoCo take part: two masses of 1 kg are tied to each other, and one of them
// rubs.
TEST_F(ConeCorrection, BesideConstraints) {
  Slide s;
  s.joints =
      R"(<joint name="x" type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint type="slide" axis="0 0 1"/>)";
  s.further =
      R"(<body pos="0 2 1"><joint name="tied" type="slide" axis="1 0 0"/><geom type="sphere" size="0.1" mass="1" contype="0" conaffinity="0"/></body>)";
  s.elements =
      R"(<equality><joint joint1="x" joint2="tied" solimp="0.9999 0.9999 0.001"/></equality>)";
  const ModelPointer m = load(document(s));
  m->opt.cone = mjCONE_ELLIPTIC;
  for (const int solver : {mjSOL_PGS, mjSOL_CG, mjSOL_NEWTON}) {
    m->opt.solver = solver;
    const DataPointer d(mj_makeData(m.get()));
    d->qvel[0] = d->qvel[3] = 10.0;
    for (int k = 0; k < 1000; ++k) mj_step(m.get(), d.get());
    EXPECT_NEAR(10.0 - d->qvel[0], 0.25 * kGravity, 2e-3 * kGravity) << solver;
    EXPECT_NEAR(d->qvel[0], d->qvel[3], 1e-3) << solver;
    EXPECT_LT(std::abs(d->qpos[2]), 1e-3) << solver;
  }
}

// PGS with an elliptic cone finds a sliding contact only from a start with its force.
TEST_F(ConeCorrection, NeedsTheWarmStartOfAnEllipticPgs) {
  const std::string option = R"(<option timestep="0.001"/>)";
  const auto with = [&](const std::string& cone) {
    return replaced(document({}), option,
                    R"(<option timestep="0.001" solver="PGS" cone=")" + cone +
                        R"("><flag warmstart="disable"/></option>)");
  };
  expect_refused(with("elliptic"), "warmstart");
  EXPECT_NEAR(slid(load(with("pyramidal")).get(), 10.0).lost, 0.5 * kGravity, 1e-2 * kGravity);
}

// The correction has no memory: a forward pass may be repeated, and a state written.
TEST_F(ConeCorrection, IsAFunctionOfTheState) {
  const ModelPointer m = load(document({}));
  m->opt.cone = mjCONE_ELLIPTIC;
  const DataPointer d(mj_makeData(m.get())), fresh(mj_makeData(m.get()));
  d->qvel[0] = 10.0;
  for (int k = 0; k < 100; ++k) mj_step(m.get(), d.get());
  const auto force = [&](mjData* of) {
    mjtNum f[6];
    mj_contactForce(m.get(), of, 0, f);
    return f[0];
  };
  mj_forward(m.get(), d.get());
  const double once = force(d.get());
  ASSERT_GT(once, 5.0);
  mj_forward(m.get(), d.get());
  EXPECT_NEAR(force(d.get()), once, 1e-9);
  mju_copy(fresh->qpos, d->qpos, m->nq);
  mju_copy(fresh->qvel, d->qvel, m->nv);
  mj_forward(m.get(), fresh.get());
  EXPECT_NEAR(force(fresh.get()), once, 1e-9);
  d->qvel[0] = -3.0;
  fresh->qvel[0] = -3.0;
  mj_forward(m.get(), d.get());
  mj_forward(m.get(), fresh.get());
  EXPECT_NEAR(force(d.get()), force(fresh.get()), 1e-9);
}

// MuJoCo solves pairs that are not named.
TEST_F(ConeCorrection, LeavesOtherContactsAlone) {
  Slide s;
  s.further =
      R"(<body pos="3 0 0.1"><freejoint/><geom name="other" type="sphere" size="0.1" mass="1"/></body>)";
  const std::string named = document(s);
  s.custom = "";
  const ModelPointer ours = load(named), theirs = load(document(s));
  const DataPointer a(mj_makeData(ours.get())), b(mj_makeData(theirs.get()));
  for (mjData* d : {a.get(), b.get()}) d->qvel[3] = 2.0;
  for (int k = 0; k < 500; ++k) {
    mj_step(ours.get(), a.get());
    mj_step(theirs.get(), b.get());
  }
  EXPECT_EQ(a->qpos[3], b->qpos[3]);
  EXPECT_EQ(a->qvel[3], b->qvel[3]);
}

TEST_F(ConeCorrection, RefusesWhatIsNoPairWithFriction) {
  Slide s;
  s.custom = R"(<text name="rotorub_cone_coulomb_pair" data="slidin"/>)";
  expect_refused(document(s), "no <pair> is called \"slidin\"");
  s = {};
  s.condim = 1;
  expect_refused(document(s), "condim");
  // A pair that is named twice would be corrected twice.
  s = {};
  s.custom += R"(<text name="rotorub_cone_coulomb_pair_2" data="sliding"/>)";
  expect_refused(document(s), "named twice");
}

// The example, a program without our code: plugin/README.md has its table.
TEST(SlidingContact, TheExampleShowsWhatTheConeDoesAndTheCure) {
  const std::filesystem::path program =
      std::filesystem::path(ROTORUB_BINARY).parent_path() / "sliding_contact";
  std::FILE* pipe = ::popen(("cd /tmp && " + program.string()).c_str(), "r");
  ASSERT_TRUE(pipe);
  struct Row {
    double contact, force, braking;
  };
  std::vector<Row> rows;
  char line[300];
  while (std::fgets(line, sizeof line, pipe)) {
    const std::string text = line;
    const auto after = [&text](const char* word) {
      return std::stod(text.substr(text.find(word) + std::strlen(word)));
    };
    if (text.find("contact") == text.npos) continue;
    rows.push_back({after("contact"), after("force"), after("brakes with")});
  }
  EXPECT_EQ(::pclose(pipe), 0);
  ASSERT_EQ(rows.size(), 9u);
  const double right = 0.5 * kGravity;
  EXPECT_LT(rows[3].contact, 50.0) << "1 m/s, as it is";
  EXPECT_LT(rows[6].contact, 5.0) << "10 m/s, as it is";
  // Below its lower border, theory.md (48): v' = -B_t v A / (A + R) = -d B_t v, d = 0.9 to 0.95 by
  // default.
  const double t = 0.183, mean = (1.0 - std::exp(-0.92 * t)) / t;
  EXPECT_NEAR(rows[4].braking, mean, 0.03 * mean) << "1 m/s, a constant friction reference";
  for (const Row& corrected : {rows[5], rows[8]}) {
    EXPECT_GT(corrected.contact, 99.0);
    EXPECT_NEAR(corrected.force, kGravity, 0.01);
    EXPECT_NEAR(corrected.braking, right, 1e-3);
  }
}

}  // namespace
}  // namespace rotorub::test
