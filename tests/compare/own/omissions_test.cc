// The effects that a twin leaves out of its machine are measured: each size has a closed form.
#include "compare/own/omissions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "compare/own/own_machine.h"
#include "compare/study/answer.h"
#include "compare/study/scene_comparison.h"
#include "compare/study/verdict.h"
#include "native_model/scene/reader.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/twin/twins.h"
#include "tests/support/temporary_folder.h"

namespace rotorub {
namespace {

constexpr auto kRigid = scene::ContactModel::kRigid;
const std::string kOwnModel = std::string(ROTORUB_MJCF_DIR) + "/examples/own_model.xml";

std::vector<Omission> omissions_of(const std::string& document, double end = 0.01) {
  const test::TemporaryFolder folder;
  OwnRun run;
  run.end = end;
  return OwnMachine(folder.write("own.xml", document), run).omissions(kRigid);
}

std::string key(const std::string& attributes) {
  return "<keyframe><key name=\"start\" " + attributes + "/></keyframe>";
}

// The size of the omission with that name; 0 if there is none.
double peak_of(const std::vector<Omission>& all, const std::string& named) {
  for (const Omission& o : all) {
    if (o.what.find(named) != std::string::npos) return o.peak;
  }
  return 0.0;
}
// Expects that the omissions of the document's twin contain one of that name, of this size within
// `room`.
void expect_omission(const std::string& document, const std::string& named, double size,
                     double room, double end = 0.01) {
  const std::vector<Omission> all = omissions_of(document, end);
  std::string text;
  for (const Omission& o : all) text += o.sentence(100.0) + "\n";
  EXPECT_NEAR(peak_of(all, named), size, room) << text;
}
void expect_nothing(const std::vector<Omission>& all) {
  for (const Omission& o : all) EXPECT_LT(o.share(100.0), 1e-6) << o.sentence(100.0);
}

// Springs, slides, a motor and a rub: the twin has all of them.
TEST(Omissions, TheShippedMachineHasNone) {
  OwnRun run;
  run.end = 0.06;
  for (const auto contact : {kRigid, scene::ContactModel::kCoulomb, scene::ContactModel::kCone})
    expect_nothing(OwnMachine(kOwnModel, run).omissions(contact));
}

// Both sides have a command.
TEST(Omissions, ACommandOfTheControllerIsNone) {
  OwnRun run;
  run.end = 0.03;
  run.control = {"controller.kind=pd", "controller.stiffness=1e5", "controller.damping=100"};
  expect_nothing(OwnMachine(kOwnModel, run).omissions(kRigid));
}

// The contact's own force is not an omission if MuJoCo calls the plugin among the passive forces.
TEST(Omissions, TheContactIsNoneWithoutActuation) {
  test::Machine x;
  x.constraints = key("qpos=\"4.9e-4 0 0 0 0\" qvel=\"0.1 0 0 0 0\"");
  expect_nothing(omissions_of(test::replaced(
      test::document(x), "<size", "<option><flag actuation=\"disable\"/></option><size")));
}

TEST(Omissions, FrictionLossIsMeasured) {
  test::Machine x = test::rubbing_ring();
  x.constraints = key("qpos=\"4.9e-4 0 0 0 0\" qvel=\"1 0 0 0 0\"");
  expect_omission(test::document(x),
                  "the native model leaves out the friction loss of <joint name=\"ring_x\">",
                  test::kLoss, 1e-3 * test::kLoss);
}

// On the spin: N m over the rotor's radius of 50 mm.
TEST(Omissions, FrictionLossOfTheSpinCountsAtTheSurface) {
  test::Machine x;
  x.spin = "frictionloss=\"0.2\" solimpfriction=\"0.9999 0.9999 0.001\"";
  x.constraints = key("qvel=\"0 0 300 0 0\"");
  expect_omission(test::document(x), "the friction loss of <joint name=\"spin\">", 0.2 / 0.05,
                  1e-3);
}

// A rotor at rest on its limit under a steady 40 N, and on a tendon's.
TEST(Omissions, LimitsAreMeasured) {
  const std::string hard = "limited=\"true\" range=\"-1 0\" solimplimit=\"0.9999 0.9999 0.001\"";
  const std::string motor =
      "<actuator><motor joint=\"rotor_x\" gear=\"40\"/></actuator>" + key("ctrl=\"1\"");
  test::Machine joint;
  joint.rotor_joint = hard;
  joint.constraints = motor;
  expect_omission(test::document(joint), "the limit of <joint name=\"rotor_x\">", 40.0, 4.0);
  test::Machine tendon;
  tendon.constraints = "<tendon><fixed name=\"stop\" " + hard +
                       "><joint joint=\"rotor_x\" coef=\"1\"/></fixed></tendon>" + motor;
  expect_omission(test::document(tendon), "the limit of tendon \"stop\"", 40.0, 4.0);
}

// The ring also strikes the part behind it.
TEST(Omissions, OtherContactsAreMeasured) {
  test::Machine x = test::loose_part();
  x.constraints = key("qpos=\"4.9e-4 0 0 0 0 0\" qvel=\"1 0 0 0 0 0\"");
  EXPECT_GT(peak_of(omissions_of(test::document(x), 0.001),
                    "the contact of geom \"cheek\" with geom \"part\""),
            1000.0);
}

// An equality constraint that holds a body beside the machine.
TEST(Omissions, AnEqualityBesideItIsNone) {
  test::Machine x;
  x.bodies = R"(<body name="motor"><joint name="shaft2" type="hinge" axis="0 0 1"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/></body>)";
  x.constraints =
      R"(<equality><joint name="brake" joint1="shaft2" polycoef="1 0 0 0 0"/></equality>)";
  expect_nothing(omissions_of(test::document(x)));
}

// A servo that saturates at 5 N where the twin's pulls with k y: most at the start, where the
// rotor is furthest out.
TEST(Omissions, AServoThatSaturatesIsNamed) {
  test::Machine x;
  x.constraints = R"(<actuator><position name="servo" joint="rotor_y" kp="1e5" forcelimited="true"
      forcerange="-5 5"/></actuator>)" +
                  key("qpos=\"0 4e-4 0 0 0\"");
  expect_omission(test::document(x),
                  "the forces on the rotor, mainly of actuator \"servo\", differ", 1e5 * 4e-4 - 5.0,
                  1e-6);
}

// An actuator with a time constant: the twin keeps its force of the start.
TEST(Omissions, AnActivationThatMovesIsNamed) {
  test::Machine x;
  x.constraints = R"(<actuator><general name="lag" joint="ring_x" dyntype="filter" dynprm="0.01"
      gainprm="10"/></actuator>)" +
                  key("ctrl=\"1\"");
  expect_omission(test::document(x), "the forces on the ring, mainly of actuator \"lag\", differ",
                  10.0 * (1.0 - std::exp(-0.5)), 0.01, 0.005);
}

// A rope across the motion pulls with k (L - L_0), which has no linear part in x.
TEST(Omissions, ATendonThatTurnsIsNamed) {
  constexpr double kStiffness = 1e6, kLength = 0.01, kAside = 4e-4;
  test::Machine x;
  x.bodies = R"(<site name="anchor" pos="0 0.01 0"/>)";
  x.constraints = R"(<tendon><spatial name="rope" stiffness="1e6" springlength="0.01">
      <site site="anchor"/><site site="knot"/></spatial></tendon>)" +
                  key("qpos=\"4e-4 0 0 0 0\"");
  const std::string inertial = R"(<inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/>)";
  expect_omission(test::replaced(test::document(x), inertial, inertial + R"(<site name="knot"/>)"),
                  "the forces on the rotor, mainly of tendon \"rope\", differ",
                  kStiffness * (std::hypot(kLength, kAside) - kLength), 0.02, 0.001);
}

// A pendulum of 2 mm is at l sin a, and its twin at l a.
TEST(Omissions, APlaceThatIsNotLinearIsMeasured) {
  const std::string arm = R"(<body name="arm" pos="0 0 0.098">
      <joint name="a" type="hinge" axis="0 1 0" stiffness="50"/>
      <joint name="b" type="hinge" axis="1 0 0" stiffness="50"/>
      <inertial pos="0 0 0.05" mass="2" diaginertia="1e-3 1e-3 1e-3"/>
      <geom name="disc" type="cylinder" size="0.05 0.01" pos="0 0 0.002" contype="0"
        conaffinity="0" mass="0"/></body>)";
  expect_omission(test::machine(arm, "", key("qpos=\"0.2 0\"")),
                  "the rotor's place in its ring differs", 0.002 * (0.2 - std::sin(0.2)) / 5e-4,
                  1e-6, 0.001);
}

// A rotor that is not a body of revolution: of its two moments of inertia the twin has the mean.
// Free in its plane it has A = 1 / m + l^2 / J at l from its centre of mass.
TEST(Omissions, AMassThatTurnsIsMeasured) {
  const std::string rotor = R"(<body name="shaft">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
      <joint type="hinge" axis="1 0 0"/><joint type="hinge" axis="0 1 0"/>
      <joint type="hinge" axis="0 0 1"/>
      <inertial pos="0 0 0" mass="2" diaginertia="0.01 0.03 0.02"/>)" +
                            test::kDisc + "</body>";
  const auto admittance = [](double inertia) { return 1.0 / 2.0 + 0.1 * 0.1 / inertia; };
  const double mean = admittance(0.02);
  const double expected =
      std::hypot(admittance(0.01) - mean, admittance(0.03) - mean) / std::hypot(mean, mean);
  expect_omission(test::machine(rotor, "", key("qpos=\"4.9e-4 0 0 0 0\" qvel=\"0.1 0 0 0 0\"")),
                  "the mass that the contact moves differs", expected, 1e-4, 0.001);
}

// It slides as fast along the axis as round the ring, so the twin lacks 1 - 1 / sqrt(2) of mu N.
TEST(Omissions, FrictionAlongTheAxisIsMeasured) {
  const std::string rotor = R"(<body name="shaft">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
      <joint type="slide" axis="0 0 1"/><joint type="hinge" axis="0 0 1"/>
      <inertial pos="0 0 0.1" mass="2" diaginertia="1e-3 1e-3 1e-3"/>)" +
                            test::kDisc + "</body>";
  expect_omission(test::machine(rotor, "", key("qpos=\"4.9e-4 0 0 0\" qvel=\"0.1 0 10 200\"")),
                  "the friction along the ring's axis", 0.15 * (1.0 - std::sqrt(0.5)), 1e-3,
                  0.0005);
}

TEST(Omissions, ASentenceHasTheSize) {
  const Omission force{"the native model leaves out the limit of tendon \"t\", whose force reaches",
                       12.0};
  EXPECT_EQ(
      force.sentence(150.0),
      "the native model leaves out the limit of tendon \"t\", whose force reaches 12 N, 8 % of the "
      "mean contact force");
  const Omission place{"the rotor's place differs by up to", 0.03, " of the clearance"};
  EXPECT_EQ(place.sentence(150.0), "the rotor's place differs by up to 3 % of the clearance");
  EXPECT_EQ(place.share(150.0), 0.03);
}

SceneComparison compared(const std::string& loss, double tolerance, CompareMode mode) {
  const test::TemporaryFolder folder;
  const std::string ring = "<joint name=\"ring_x\"";
  const std::string file =
      folder.write("lossy.xml", test::replaced(scene::regular_file_text(kOwnModel), ring,
                                               ring + " frictionloss=\"" + loss + "\""));
  OwnRun run;
  run.end = 0.04;
  CompareOptions options;
  options.own = std::make_shared<const OwnMachine>(file, run);
  options.mode = mode;
  options.tolerance = tolerance;
  options.twins = 0;
  options.timing_repeats = 0;
  return compare_scene(options.own->scene(), options);
}

// An omission above the tolerance leaves every verdict undecidable, and the sentence says its size.
TEST(Omissions, ALargeOneDecidesThatNothingIsDecided) {
  for (const CompareMode mode : {CompareMode::kLockstep, CompareMode::kResync}) {
    const SceneComparison c = compared("20", 0.01, mode);
    ASSERT_EQ(c.status(), Status::kOk);
    EXPECT_NE(c.omission.find("the friction loss of <joint name=\"ring_x\">, whose force reaches "
                              "20 N, "),
              std::string::npos)
        << c.omission;
    EXPECT_FALSE(c.within());
    for (const ComparedModel& m : c.models) {
      const AnswerRow row = answer_row(c, m);
      EXPECT_EQ(m.trust, Trust::kUndecidable) << row.contact;
      EXPECT_EQ(row.why, c.omission + ", so no difference can be attributed to the contact");
      EXPECT_NE(headline(c, m).find(c.omission), std::string::npos);
      for (const FigureDifference& f : m.figures) {
        EXPECT_TRUE(f.verdict == FigureVerdict::kNotJudged ||
                    f.verdict == FigureVerdict::kUndecidable)
            << f.figure->key;
      }
    }
  }
}

// A small omission is reported, and the contact models are judged as usual.
TEST(Omissions, ASmallOneIsSaid) {
  const SceneComparison c = compared("0.1", 0.01, CompareMode::kLockstep);
  ASSERT_EQ(c.status(), Status::kOk);
  EXPECT_EQ(c.omission, "");
  std::string notes;
  for (const std::string& note : own_notes(c)) notes += note + "\n";
  EXPECT_NE(notes.find("whose force reaches 0.1 N"), std::string::npos) << notes;
  for (const ComparedModel& m : c.models) {
    EXPECT_TRUE(std::ranges::any_of(m.figures, [](const FigureDifference& f) {
      return f.verdict == FigureVerdict::kWithin || f.verdict == FigureVerdict::kOutside;
    }));
  }
}

}  // namespace
}  // namespace rotorub
