#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"
#include "tests/fuzz/said.h"
#include "tests/native_model/scene/scene_samples.h"

namespace rotorub::scene {
namespace {

std::filesystem::path shipped(const std::string& name) {
  return std::filesystem::path(ROTORUB_MJCF_DIR) / (name + ".toml");
}

// The limit concerns the depth of a key, not the count of numbers in a line.
TEST(Reader, TakesLongLinesOfNumbers) {
  std::string times = "[", square = "[";
  for (int k = 0; k <= 1000; ++k) times += (k > 0 ? "," : "") + std::to_string(1e-4 * k);
  for (int k = 0; k < 41 * 41; ++k) square += (k > 0 ? "," : "") + std::to_string(0.1 * k);
  const std::vector<std::string> overrides{"run.output_times=" + times + "]"};
  const Scene scene = read_scene(shipped("bench_ring"), overrides);
  EXPECT_EQ(scene.run.output_times.size(), 1001U);
  EXPECT_EQ(parse_scene(scene.text, "again.toml").run.output_times, scene.run.output_times)
      << "its own text";
  std::vector<Diagnostic> wrong;
  EXPECT_TRUE(parse_toml("table = " + square + "]\n", "table.toml", wrong));
  EXPECT_TRUE(wrong.empty());
}

TEST(Reader, SaysThatAStringHasNoEnd) {
  const std::vector<Diagnostic> found = refusal("[controller]\nkind = \"passive\ngain = 1\n");
  const auto said = std::ranges::find_if(found, [](const Diagnostic& d) { return d.line == 2; });
  ASSERT_NE(said, found.end());
  EXPECT_NE(said->reason.find("a text in quotes does not end on its line"), std::string::npos)
      << said->reason;
}

TEST(Reader, TakesOneNumberForBothPlanesAndSortsTimes) {
  const Scene scene = parse_scene(kFullModalScene, "some/where/example.toml");
  EXPECT_EQ(scene.name, "example");
  EXPECT_EQ(scene.text, kFullModalScene);
  EXPECT_EQ(scene.run.output_times, (std::vector<double>{0.1234, 0.4}));
  EXPECT_EQ(scene.first().stator->mass, PlanePair(1.0, 1.0));
  EXPECT_EQ(scene.first().stator->damping, PlanePair(200.0, 300.0));  // a whole number is taken too
}

TEST(Reader, FillsInTheDefaults) {
  const Scene scene =
      parse_scene(std::string(kModalSample) + "[[force]]\nkind = \"constant\"\n" +
                      "vector = [1, 2]\n[rotor.torsion]\ninertia = [1]\n" + "stiffness = [2]\n",
                  "scene.toml");
  EXPECT_EQ(scene.run.end, 1.0);
  EXPECT_EQ(scene.run.step, 1e-5);
  EXPECT_EQ(scene.run.series_step(), 1e-3);
  const RotorModal& modal = *scene.rotor.modal;
  EXPECT_EQ(modal.damping, (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(modal.internal_damping, modal.damping);
  EXPECT_EQ(modal.gyroscopic, modal.damping);
  EXPECT_EQ(modal.mass_y, modal.mass);
  EXPECT_EQ(modal.stiffness_y, modal.stiffness);
  EXPECT_EQ(modal.damping_y, modal.damping);
  EXPECT_EQ(scene.forces[0].shape, (std::vector<double>{1.0, 1.0}));
  EXPECT_EQ(scene.forces[0].on, 0.0);
  EXPECT_EQ(scene.forces[0].off, kNever);
  EXPECT_EQ(scene.rotor.torsion->drive_shape, std::vector<double>{0.0});
  EXPECT_EQ(scene.first().contact->tangential_restitution, 0.0);
  EXPECT_FALSE(scene.drive || scene.first().stator || scene.first().actuator ||
               scene.first().controller || scene.gravity || !scene.magnetic_bearings.empty());
}

TEST(Reader, ReadsTheGeometryForm) {
  const std::string text = std::string(kGeometrySample) + R"(inner_diameter = 0.004
[[rotor.disc]]
z = 0.3
mass = 2
Jt = 1.8e-3
Jp = 3.6e-3
phase = "90 deg"
[[rotor.bearing]]
z = 0.03
stiffness = [2e7, "1 kN/mm"]
[[rotor.bearing]]
z = 0.57
stiffness = 2e7
damping = 5
)";
  const Scene scene = parse_scene(text, "scene.toml");
  ASSERT_TRUE(scene.rotor.geometry);
  EXPECT_FALSE(scene.rotor.modal);
  const RotorGeometry& shaft = *scene.rotor.geometry;
  EXPECT_EQ(shaft.length, 0.6);
  EXPECT_EQ(shaft.modes, 2);
  EXPECT_EQ(shaft.G, 2.1e11 / 2.6);  // nu = 0.3 where no torsion needs it
  ASSERT_EQ(shaft.sections.size(), 1u);
  EXPECT_EQ(shaft.sections[0].inner_diameter, 0.004);
  ASSERT_EQ(shaft.discs.size(), 1u);
  EXPECT_EQ(shaft.discs[0].phase, std::numbers::pi / 2.0);
  ASSERT_EQ(shaft.bearings.size(), 2u);
  EXPECT_EQ(shaft.bearings[0].stiffness, PlanePair(2e7, 1e6));
  EXPECT_EQ(shaft.bearings[1].damping, PlanePair(5.0, 5.0));
}

TEST(Reader, TakesTheShearModulusFromNuOrAsItIs) {
  const auto with = [](const std::string& keys) {
    std::string text(kGeometrySample);
    text.insert(text.find("modes"), keys + "\n");
    return parse_scene(text + "[rotor.torsion]\nmodes = 1\n", "scene.toml").rotor;
  };
  EXPECT_EQ(with("nu = 0.25").geometry->G, 2.1e11 / 2.5);
  EXPECT_EQ(with("G = \"81.2 GPa\"").geometry->G, 81.2e9);
  // Torsion is damped as bending is, unless the scene sets it.
  EXPECT_EQ(with("nu = 0.3\ndamping_ratio = 0.01").torsion->damping_ratio, 0.01);
}

TEST(Reader, ReadsEveryDrive) {
  const auto drive = [](const std::string& keys) {
    std::string text(kModalSample);
    text.insert(text.find("[contact]"), "inertia = 1e-3\n");
    return *parse_scene(text + "[drive]\n" + keys, "scene.toml").drive;
  };
  EXPECT_EQ(drive("kind = \"free\"\n").kind, DriveKind::kFree);
  const Drive kloss = drive(
      "kind = \"kloss\"\nbreakdown_torque = 3\nbreakdown_slip = 0.2\nsynchronous_speed = \"50 "
      "Hz\"\n");
  EXPECT_EQ(kloss.kind, DriveKind::kKloss);
  EXPECT_EQ(kloss.breakdown_slip, 0.2);
  const Drive table =
      drive("kind = \"table\"\ntable_speed = [0, \"50 Hz\"]\ntable_torque = [1.5, 0]\n");
  EXPECT_EQ(table.kind, DriveKind::kTable);
  EXPECT_EQ(table.table_speed, (std::vector<double>{0.0, 100.0 * std::numbers::pi}));
  const Drive controlled = drive(
      "kind = \"speed_controlled\"\ngain = 0.5\nspeed = \"75 Hz\"\nintegral_gain = 2.0\n"
      "torque_limit = \"3 N m\"\nacceleration = \"60 rpm/s\"\n");
  EXPECT_EQ(controlled.kind, DriveKind::kSpeedControlled);
  EXPECT_EQ(controlled.integral_gain, 2.0);
  EXPECT_EQ(controlled.torque_limit, 3.0);
  EXPECT_DOUBLE_EQ(controlled.acceleration, 2.0 * std::numbers::pi);
}

TEST(Reader, TakesALineEndingOrAByteOrderMarkFromOtherSystems) {
  std::string text = "\xef\xbb\xbf";
  for (char c : kModalSample) text += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(parse_scene(text, "scene.toml").first().contact->friction.coefficient, 0.15);
}

// Everything but the controller and the step.
TEST(Reader, ThePaperScenesAreOneRig) {
  const std::string passive = read_scene(shipped("paper_passive")).text,
                    sliding = read_scene(shipped("paper_sliding")).text;
  EXPECT_EQ(sliding.substr(sliding.find("[rotor]")).find(passive.substr(passive.find("[rotor]"))),
            0u);
}

TEST(Reader, HashesTheTextAlone) {
  const Scene one = parse_scene(kModalSample, "one.toml"),
              two = parse_scene(kModalSample, "two.toml");
  EXPECT_EQ(scene_hash(one), scene_hash(two));
  const Scene other = parse_scene(std::string(kModalSample) + "# note\n", "one.toml");
  EXPECT_NE(scene_hash(one), scene_hash(other));
  Scene known;
  known.text = "foobar";
  EXPECT_EQ(scene_hash(known), "85944171f73967e8");  // published FNV-1a of "foobar"
}

// ----------------------------------------------------------------
const std::string kRing = std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml";

TEST(Variants, AreWhatReadSceneGives) {
  const std::vector<std::string> all{"run.end=0.2"};
  const Variants variants(kRing, all);
  for (const std::string change :
       {"contact.friction=0.25", "contact.friction=1", "contact.friction=1e-1", "rotor.speed=20 Hz",
        "rotor.speed=-12.5", "force[0].amplitude=\"0.2 kN\"", "stator=none",
        "gravity={acceleration=[0,-9.81]}"}) {
    const std::vector<std::string> one{change}, both{all[0], change};
    const Scene made = variants.scene(one, true), read = read_scene(kRing, both);
    EXPECT_EQ(made.text, read.text) << change;
    EXPECT_EQ(made.name, read.name);
    EXPECT_EQ(made.rotor.speed, read.rotor.speed) << change;
    EXPECT_EQ(made.first().contact->friction.coefficient,
              read.first().contact->friction.coefficient)
        << change;
    EXPECT_EQ(made.first().stator.has_value(), read.first().stator.has_value()) << change;
  }
}

TEST(Variants, EachIsRefusedByItself) {
  const Variants variants(kRing);
  const std::vector<std::string> bad{"contact.friction=-1"}, good{"contact.friction=0.5"};
  EXPECT_THROW(variants.scene(bad, false), SceneError);
  EXPECT_EQ(variants.scene(good, false).first().contact->friction.coefficient, 0.5);
}

// The fast path for plain decimal numbers accepts nothing else.
TEST(Variants, NumbersAreThoseOfToml) {
  const Variants variants(kRing);
  for (const char* text : {".", "1.5.2", "1.5e", "--1.5", "1.5-2"}) {
    const std::vector<std::string> change{std::string("contact.friction=") + text};
    EXPECT_THROW(variants.scene(change, false), SceneError) << text;
  }
  for (const char* text : {"0.15", "1.5e-1", "1.5E-1", ".15", "+0.15", "0.1_5"}) {
    const std::vector<std::string> change{std::string("contact.friction=") + text};
    EXPECT_EQ(variants.scene(change, false).first().contact->friction.coefficient, 0.15) << text;
  }
}

// ---------------------------------------------------------------- found
// The inputs that once broke the scene's reader (tests/fuzz).

TEST(FoundInputs, AreReadOrRefusedInPrintableWords) {
  int inputs = 0;
  const std::string folder = ROTORUB_SOURCE_DIR "/tests/fuzz/found";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++inputs;
    try {
      parse_scene(file_text(entry.path().string()), "scene.toml");
    } catch (const SceneError& error) {
      test::check_said(error.what());
    }
  }
  EXPECT_GT(inputs, 0);
}

}  // namespace
}  // namespace rotorub::scene
