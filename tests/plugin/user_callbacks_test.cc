// Programs that overwrite MuJoCo's callbacks after us, preloaded and linked: the run keeps its
// contact to the bit, the user's callback is called once a step, and rotorub_active is right.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/trajectory/output.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/temporary_folder.h"

namespace rotorub::test {
namespace {

namespace fs = std::filesystem;

constexpr int kCallbackSteps = 2000;

struct Line {
  double calls = -1, active = -1, touching = -1, penetration = -1;
  std::string state;
};

class Program : public MujocoTest {
 protected:
  explicit Program(bool linked) : linked_(linked) {}

  // The lines that the program prints for a case.
  std::string said(const std::string& document, const std::string& what,
                   int steps = kCallbackSteps) const {
    const fs::path xml = folder_ / "scene.xml", out = folder_ / "out";
    write_whole(xml, for_this_mujoco(document));
    const std::string name = linked_ ? "rotorub_user_program_linked" : "rotorub_user_program";
    const fs::path program = fs::path(ROTORUB_BINARY).parent_path() / name;
    EXPECT_TRUE(fs::exists(program)) << program;
    std::string libraries = ROTORUB_SANITIZER_RUNTIME;
    if (!linked_) libraries += (libraries.empty() ? "" : ":") + std::string(ROTORUB_PLUGIN);
    const std::string command = "cd " + folder_.path().string() +
                                " && ASAN_OPTIONS=detect_leaks=0 LD_PRELOAD=" + libraries + " " +
                                program.string() + " " + xml.string() + " " + what + " " +
                                std::to_string(steps) + " " + mjcf_names::kRotorContact + " " +
                                mjcf_names::kRingContact + " 5e-4 > " + out.string() + " 2>&1";
    std::ignore = std::system(command.c_str());
    std::ifstream in(out);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
  static Line line_of(const std::string& text) {
    Line line;
    std::stringstream in(text);
    in >> line.calls >> line.active >> line.touching >> line.penetration;
    std::getline(in, line.state);
    EXPECT_FALSE(line.state.empty()) << text;
    return line;
  }
  Line run(const std::string& document, const std::string& what) const {
    return line_of(said(document, what));
  }

  bool linked_;
  const TemporaryFolder folder_;
};

class UserCallbacks : public Program, public ::testing::WithParamInterface<bool> {
 protected:
  UserCallbacks() : Program(GetParam()) {}
};

class PreloadedProgram : public Program {
 protected:
  PreloadedProgram() : Program(false) {}
};

// 0.02 s of the rub from its start: impacts, their accumulation, lasting contact.
std::string bench(const std::string& contact = "rigid", const std::string& more = "run.end=0.5") {
  return mjcf(shipped("bench_ring", {"mujoco.contact=\"" + contact + "\"", more}));
}

// A coil that has neither, so that the actuators' callbacks carry the force.
std::string magnets() { return mjcf(shipped("paper_magnetic", {"contact.clearance=\"0.1 mm\""})); }

std::string with_cell(std::string text) {
  const std::string ring = "<body name=\"ring\">", sensors = "<sensor>";
  text.insert(text.find(ring) + ring.size(), "<site name=\"cell\"/>");
  return text.insert(text.find(sensors) + sensors.size(), "<force name=\"cell\" site=\"cell\"/>");
}

TEST_P(UserCallbacks, AreCalledAndTheContactStays) {
  for (const char* contact : {"rigid", "coulomb", "cone", "cone-coulomb"}) {
    const std::string document = bench(contact);
    const Line plain = run(document, "none");
    EXPECT_EQ(plain.active, 1.0);
    EXPECT_GT(plain.touching, 0.0) << contact;
    EXPECT_LT(plain.penetration, 20.0);
    EXPECT_EQ(plain.calls, 0.0);
    for (const std::string what :
         {"control", "passive", "chained", "chained_passive", "set_if_not_there", "threads"}) {
      const Line line = run(document, what);
      EXPECT_EQ(line.state, plain.state) << contact << " " << what;
      EXPECT_EQ(line.active, 1.0) << contact << " " << what;
      EXPECT_EQ(line.penetration, plain.penetration) << contact << " " << what;
      // A passive force that was found missing during a pass is computed again.
      EXPECT_NEAR(line.calls, kCallbackSteps, what == "passive" ? 1 : 0) << contact << " " << what;
    }
  }
}

// A user's own model with two contacts on one shaft.
std::string two_rings(const std::string& contact) {
  TwoRings x;
  x.contact = contact;
  x.friction = 0.15;
  x.ring_mass = 1.0;
  x.sensors =
      "<user name=\"rotorub_active\" objtype=\"body\" objname=\"shaft\" datatype=\"real\" "
      "needstage=\"pos\" dim=\"1\"/>";
  x.constraints = "<keyframe><key name=\"start\" qvel=\"0.3 0.1 0 1 100 0 0 0 0\"/></keyframe>";
  std::string text = document(x);
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"\"disc\"", mjcf_names::kRotorContact},
        {"\"ring\"", mjcf_names::kRingContact}}) {
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + 1)) {
      text.replace(at, from.size(), "\"" + to + "\"");
    }
  }
  return text;
}

TEST_P(UserCallbacks, FindBothContactsOfAShaft) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const std::string document = two_rings(contact);
    const Line plain = run(document, "none");
    EXPECT_EQ(plain.active, 1.0);
    EXPECT_GT(plain.touching, 0.0) << contact;
    EXPECT_LT(plain.penetration, contact[0] == 'r' ? 0.01 : 20.0);
    for (const std::string what :
         {"control", "chained_passive", "threads", "reset_always", "null"}) {
      const Line line = run(document, what);
      EXPECT_EQ(line.state, plain.state) << contact << " " << what;
      EXPECT_EQ(line.active, 1.0) << contact << " " << what;
    }
  }
}

TEST_P(UserCallbacks, MayBeTakenOffAgain) {
  const std::string document = bench();
  const Line plain = run(document, "none");
  for (const std::string what : {"taken_off", "replaced", "chained_taken_off"}) {
    const Line line = run(document, what);
    EXPECT_EQ(line.state, plain.state) << what;
    EXPECT_EQ(line.active, 1.0) << what;
    EXPECT_EQ(line.calls, kCallbackSteps / 2) << what;
  }
}

TEST_P(UserCallbacks, ResetTakesNothingOfOurs) {
  for (const char* contact : {"rigid", "coulomb", "cone", "cone-coulomb"}) {
    const std::string document = bench(contact);
    const Line plain = run(document, "none");
    for (const std::string what : {"reset", "reset_always", "null", "sensor", "collision"}) {
      const Line line = run(document, what);
      EXPECT_EQ(line.state, plain.state) << contact << " " << what;
      EXPECT_EQ(line.active, 1.0) << contact << " " << what;
    }
  }
}

TEST_P(UserCallbacks, DoNotReplaceTheMagnets) {
  const Line plain = run(magnets(), "none");
  const Line line = run(magnets(), "magnets");
  EXPECT_EQ(line.state, plain.state);
  EXPECT_EQ(run(magnets(), "reset").state, plain.state);
}

// Whoever has called us and then does not costs one step its contact, is told of, and comes second.
TEST_P(UserCallbacks, ThatStopCallingUsAreNoticed) {
  const std::string text = said(bench(), "chained_at_first");
  EXPECT_NE(
      text.find(
          "warning: rotorub: your mjcb_control called the plugin's mjcb_control before, but not "
          "in the last step, so that step had no contact"),
      std::string::npos)
      << text;
  const Line line = line_of(text.substr(text.find('\n') + 1));
  EXPECT_EQ(line.active, 1.0 - 1.0 / kCallbackSteps);
  EXPECT_EQ(line.calls, kCallbackSteps);
  EXPECT_LT(line.penetration, 20.0);
}

// With contact disabled by MuJoCo's own flags there is none, and rotorub_active shows it.
TEST_P(UserCallbacks, DisabledContactIsNone) {
  for (const std::string what : {"no_contact", "no_constraint"}) {
    const Line line = run(bench(), what);
    EXPECT_EQ(line.touching, 0.0) << what;
    EXPECT_EQ(line.active, 0.0) << what;
    EXPECT_GT(line.penetration, 500.0) << what;
  }
}

// Then not even the collision function is called. The loads of the scene are ours still where the
// library is preloaded; linked, nothing of ours is called, and the sensor keeps to the 0 of before.
TEST_P(UserCallbacks, AllOffAtOnceWithoutContact) {
  const Line wanted = run(bench(), "no_contact");
  for (const std::string what : {"no_contact_reset", "no_contact_null"}) {
    const Line line = run(bench(), what);
    EXPECT_EQ(line.active, 0.0) << what;
    if (!GetParam()) {
      EXPECT_EQ(line.state, wanted.state) << what;
    }
  }
}

// What MuJoCo's own functions give where the library stands before them. (Linked: plugin::inverse
// and plugin::transition, interface_test.cc.)
TEST_F(PreloadedProgram, InverseKnowsTheContact) {
  std::stringstream left(said(bench(), "inverse"));
  double value = -1.0;
  left >> value;
  EXPECT_GE(value, 0.0);
  EXPECT_LT(value, 1e-9) << "N; 80 N of contact without";
}

TEST_F(PreloadedProgram, DifferencesKeepTimeAndMemory) {
  std::stringstream line(said(bench(), "differences", 100));
  double over_position = 0.0, over_velocity = 0.0;
  line >> over_position >> over_velocity;
  // v' = ((1 - h d/2m) v - h k/m x) / (1 + h d/2m)
  const double h = 1e-5, beta = 0.5 * h * 40.0 / 2.0;
  EXPECT_NEAR(over_position, -h * 2e5 / 2.0 / (1.0 + beta), 1e-6);
  EXPECT_NEAR(over_velocity, (1.0 - beta) / (1.0 + beta), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Programs, UserCallbacks, ::testing::Bool(),
                         [](const auto& of) { return of.param ? "Linked" : "Preloaded"; });

// A load cell of the user's below the ring. Of `rigid` the model has no sensor of the acceleration
// stage: preloaded it has the rub's forces, and mj_contactForce too; linked it is refused.
TEST_P(UserCallbacks, ALoadCellHasTheForces) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const std::string document = with_cell(bench(contact));
    const std::string text = said(document, "forces", 30000);
    if (linked_ && contact == std::string("rigid")) {
      EXPECT_NE(text.find("<sensor name=\"cell\">"), std::string::npos) << text;
      EXPECT_NE(text.find("needstage=\"acc\""), std::string::npos) << text;
      continue;
    }
    double x = 0, y = 0, normal = 0, tangent = 0, told_normal = 0, told_friction = 0, on_ring = 0;
    std::stringstream(text) >> x >> y >> normal >> tangent >> told_normal >> told_friction >>
        on_ring;
    EXPECT_NEAR(told_normal, 121.7, 5.0) << text;
    // Within MuJoCo's regularisation.
    EXPECT_NEAR(normal, told_normal, 1e-3 * told_normal) << contact;
    const double linked_friction =
        contact == std::string("coulomb") && linked_ ? 0.0 : told_friction;
    EXPECT_NEAR(std::abs(tangent), std::abs(linked_friction), 1e-6) << contact;
    EXPECT_NEAR(std::hypot(x, y), std::hypot(told_normal, told_friction), 1e-3 * told_normal)
        << contact;
    EXPECT_NEAR(on_ring, std::hypot(told_normal, linked_friction), 1e-3 * told_normal) << contact;
  }
}

}  // namespace
}  // namespace rotorub::test
