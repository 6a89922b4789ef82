// Bad scenes: each is refused with the right file, line, key and reason, and with nothing else.
#include <gtest/gtest.h>

#include <string>

#include "native_model/scene/reader.h"
#include "native_model/scene/toml_source.h"
#include "tests/native_model/scene/scene_samples.h"
#include "tests/support/said.h"

namespace rotorub::scene {
namespace {

TEST(Refusal, NamesUnknownKeysAndTables) {
  expect_refused({
      {"misspelt optional key", modal_and("tangential_restituton = 0\n"), 11,
       "contact.tangential_restituton", "did you mean `tangential_restitution`?"},
      {"wrong case", geometry_and("[[rotor.disc]]\nz = 0.1\nmass = 1\nJt = 1\nJp = 1\njP = 1\n"),
       15, "rotor.disc[0].jP", "did you mean `Jp`?"},
      {"misspelt table", modal_and("[gravty]\nacceleration = [0, 0]\n"), 11, "gravty",
       "did you mean `gravity`?"},
      {"nothing like it", modal_and("[zzz]\n"), 11, "zzz", "choose from run, rotor"},
      {"key of another table", modal_and("gain = 1\n"), 11, "contact.gain", "belongs in [drive]"},
      {"key at the top", "friction = 0.1\n" + std::string(kModalSample), 1, "friction",
       "belongs in [contact]"},
      {"unknown below a known table", modal_and("[contact.more]\nx = 1\n"), 11, "contact.more",
       "unknown table"},
  });
}

// The value counts as the key or table that is meant, so nothing is missing or needed in addition.
TEST(Refusal, ReportsAMisspeltWordOnce) {
  expect_refused({
      {"required key", modal("friction = 0.15", "frictoin = 0.15"), 9, "contact.frictoin",
       "did you mean `friction`? Choose from "},
      {"table of the form", modal("[rotor.modal]", "[rotor.modl]"), 3, "rotor.modl",
       "did you mean `modal`?"},
      {"table of a required key", geometry("[[rotor.section]]", "[[rotor.sections]]"), 6,
       "rotor.sections", "did you mean `section`?"},
      {"table that another needs",
       modal_and("[statr]\nmass = 1\nstiffness = 1\n[controller]\nkind = \"pd\"\n"), 11, "statr",
       "did you mean `stator`?"},
      {"word in a misspelt table",
       modal_and("[stator]\nmass = 1\nstiffness = 1\n[controler]\nkind = \"pd\"\n"), 14,
       "controler", "did you mean `controller`?"},
      {"table with tables below it",
       modal_and(
           "[stator]\nmass = 1\nstiffness = 1\n[controler]\nkind = \"pd\"\nsample_time = 1e-4\n"
           "[controller.trigger]\ngap = 1e-4\n"),
       14, "controler", "did you mean `controller`?"},
      {"name of another table", modal_and("[initial]\nstation = 0.2\n"), 12, "initial.station",
       "`station` belongs in [[rotor.disc]]"},
  });
}

TEST(Refusal, OfAStudyIsOneSentence) {
  expect_refused({
      {"sweep", "scene = \"ring.toml\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = \"x\"\n", 1,
       "scene", "give it to `rotorub sweep`, or give its scene, \"ring.toml\""},
      {"optimise", "[optimise]\nminimise = \"impacts\"\n", 1, "optimise",
       "give it to `rotorub optimise`"},
  });
}

TEST(Refusal, NamesWrongTypesAndUnits) {
  expect_refused({
      {"frequency for a length", modal("\"0.5 mm\"", "\"50 Hz\""), 8, "contact.clearance",
       "a length"},
      {"length for a speed", modal("\"50 Hz\"", "\"0.5 mm\""), 2, "rotor.speed", "rad/s, Hz, rpm"},
      {"word for a number", modal("0.15", "\"low\""), 9, "contact.friction", "a pure number"},
      {"boolean", modal("0.15", "true"), 9, "contact.friction", "got a boolean"},
      {"list for a number", modal("0.15", "[0.15]"), 9, "contact.friction", "got an array"},
      {"date", modal("0.15", "1979-05-27"), 9, "contact.friction", "got a date"},
      {"number for a list", modal("[2.0, 0.8]", "2.0"), 4, "rotor.modal.mass", "a list"},
      {"word in a list", modal("0.8]", "\"x\"]"), 4, "rotor.modal.mass[1]", "a mass"},
      {"empty list", modal("[2.0, 0.8]", "[]"), 4, "rotor.modal.mass", "an empty list"},
      {"three planes", full("[200.0, 300]", "[1, 2, 3]"), 35, "stator.damping", "got a list of 3"},
      {"a number for a vector", full("[0.0, -20.0]", "20.0"), 48, "force[1].vector", "[x, y]"},
      {"fraction of a mode", geometry("modes = 2", "modes = 2.5"), 5, "rotor.modes",
       "a whole number"},
      {"unknown word", full("\"linear\"", "\"linaer\""), 22, "drive.kind",
       "did you mean \"linear\"?"},
      {"number for a word", full("\"event\"", "3"), 4, "run.integrator", "\"event\", \"verlet\""},
      {"word for a flag", modal_and("[mujoco]\nshadow = \"yes\"\n"), 12, "mujoco.shadow",
       "expected true or false, got \"yes\""},
      {"number for a flag", modal_and("[mujoco]\nshadow = 1\n"), 12, "mujoco.shadow",
       "expected true or false, got 1"},
      {"list of tables for a table", modal_and("[[gravity]]\nacceleration = [0, 0]\n"), 11,
       "gravity", "expected one table [gravity]"},
      {"table for a list of tables", modal_and("[force]\nkind = \"constant\"\n"), 11, "force",
       "expected a list of tables [[force]]"},
      {"value for a table", "run = 3\n" + std::string(kModalSample), 1, "run",
       "expected one table [run]"},
      {"numbers for a list of tables", "force = [1]\n" + std::string(kModalSample), 1, "force[0]",
       "expected a table [[force]]"},
  });
}

TEST(Refusal, NamesMissingKeys) {
  expect_refused({
      {"required", modal("radius = 0.05\n", ""), 6, "contact.radius",
       "missing: expected a length in m"},
      {"friction has no silent default", modal("friction = 0.15\n", ""), 6, "contact.friction",
       "missing"},
      {"of a kind", full("gain = 0.5\n", ""), 21, "drive.gain", "missing"},
      {"kind", full("kind = \"rotating\"\n", ""), 37, "force[0].kind",
       "one of \"rotating\", \"constant\""},
      {"of the geometry form",
       geometry_and("[contact]\nradius = 0.02\nclearance = 1e-3\n"
                    "friction = 0\nrestitution = 0\n"),
       10, "contact.station", "missing"},
      {"sections", "[rotor]\nlength = 1\nE = 1\nrho = 1\nmodes = 1\n", 1, "rotor.section",
       "missing"},
      {"modes and max_frequency", geometry("modes = 2\n", ""), 1, "rotor.modes", "`max_frequency`"},
      {"nu and G, with torsion", geometry_and("[rotor.torsion]\nmodes = 1\n"), 1, "rotor.nu",
       "or `G`"},
      {"rotor", "[run]\nend = 1\n", 0, "rotor", "missing"},
      {"form", "[rotor]\nspeed = 1\n", 1, "rotor", "no rotor is given"},
      {"inertia for a drive", full("inertia = 1e-3\n", ""), 9, "rotor.modal.inertia",
       "needs an inertia"},
  });
}

// One error instead of one for each key that is missing with the table.
TEST(Refusal, NamesAMissingRotorOnce) {
  for (const char* more : {"", "[rotor.torsion]\nmodes = 1\n"}) {
    const std::string text = std::string(
                                 "[run]\nend = 1\n[[rotor.section]]\nfrom = 0.0\nto = 0.6\n"
                                 "diameter = 0.02\n[[rotor.disc]]\nz = 0.3\nmass = 2.0\n"
                                 "Jt = 0.1\nJp = 0.1\n") +
                             more;
    const std::string said = test::message_of([&] { parse_scene(text, "made.toml", {}); });
    EXPECT_EQ(said,
              "made.toml:3: rotor: the table [rotor] is missing; it has at least length, E, rho "
              "and modes");
  }
}

TEST(Refusal, NamesImpossibleValues) {
  expect_refused({
      {"negative mass", modal("[2.0, 0.8]", "[2.0, -0.8]"), 4, "rotor.modal.mass[1]", "> 0"},
      {"zero mass", modal("[2.0, 0.8]", "[2.0, 0]"), 4, "rotor.modal.mass[1]", "> 0"},
      {"restitution over 1", modal("restitution = 0.5", "restitution = 1.01"), 10,
       "contact.restitution", "in [0, 1]"},
      {"no clearance", modal("\"0.5 mm\"", "0"), 8, "contact.clearance", "> 0"},
      {"nan", modal("0.15", "nan"), 9, "contact.friction", "not finite"},
      {"inf", modal("0.15", "inf"), 9, "contact.friction", "not finite"},
      {"-inf in a list", modal("0.8]", "-inf]"), 4, "rotor.modal.mass[1]", "not finite"},
      {"nan in a string", modal("0.15", "\"nan\""), 9, "contact.friction", "a pure number"},
      {"no modes", geometry("modes = 2", "modes = 0"), 5, "rotor.modes", "[1, 1000]"},
      {"modes past int", geometry("modes = 2", "modes = 4294967297"), 5, "rotor.modes",
       "[1, 1000]"},
      {"nu of -1", geometry("modes = 2", "modes = 2\nnu = -1"), 6, "rotor.nu", "(-1, 0.5]"},
      {"backwards in time", modal_and("[run]\nend = -1\n"), 12, "run.end", "> 0"},
      {"output beyond the end", modal_and("[run]\nend = 1\noutput_times = [2]\n"), 13,
       "run.output_times[0]", "run.end = 1 s"},
      {"step beyond the end", modal_and("[run]\nend = 1\nstep = 2\nintegrator = \"verlet\"\n"), 13,
       "run.step", "at most run.end"},
      {"rows without end", modal_and("[run]\nend = 1\noutput_step = 1e-12\n"), 13,
       "run.output_step", "at most 1e7 rows"},
      {"chirp without an end",
       modal_and("[[force]]\nkind = \"chirp\"\namplitude = 1\nfrequency = 1\nfrequency_end = 2\n"),
       11, "force[0]", "needs `off`"},
      {"pulse without an end", modal_and("[[force]]\nkind = \"pulse\"\nvector = [1, 0]\n"), 11,
       "force[0]", "needs `off`"},
      {"pulse in no time",
       modal_and("[[force]]\nkind = \"pulse\"\nvector = [1, 0]\non = 0.2\noff = 0.2\n"), 15,
       "force[0].off", "takes time"},
      {"a blade that comes back",
       modal_and("[[force]]\nkind = \"unbalance\"\nstatic_moment = 1e-5\noff = 0.2\n"), 14,
       "force[0].off", "kind"},
      {"a ramp of a pulse",
       modal_and("[[force]]\nkind = \"pulse\"\nvector = [1, 0]\noff = 0.2\nramp = 0.1\n"), 15,
       "force[0].ramp", "kind"},
      {"negative static moment",
       modal_and("[[force]]\nkind = \"unbalance\"\nstatic_moment = -1e-5\n"), 13,
       "force[0].static_moment", ">= 0"},
      {"off before on", full("off = 1e9", "off = 0.05"), 43, "force[0].off", "not be before `on`"},
      {"disc lighter than its unbalance",
       geometry_and("[[rotor.disc]]\nz = 0\nmass = 2\nJt = 1\nJp = 1e-4\neccentricity = 0.01\n"
                    "[drive]\nkind = \"free\"\n"),
       14, "rotor.disc[0].Jp", "eccentricity^2 = 0.0002 kg m^2"},
      {"a number beyond all machines", modal("\"50 Hz\"", "-1e308"), 2, "rotor.speed",
       "up to 1e+60, got -1e+308"},
      {"a quantity beyond all machines", modal("\"0.5 mm\"", "\"1e99 mm\""), 8, "contact.clearance",
       "up to 1e+60"},
      {"disc that is no body", geometry_and("[[rotor.disc]]\nz = 0\nmass = 1\nJt = 1\nJp = 3\n"),
       14, "rotor.disc[0].Jp", "Jp > 2 Jt"},
      {"bore over the shaft", geometry_and("inner_diameter = 0.02\n"), 10,
       "rotor.section[0].inner_diameter", "below the outer diameter"},
  });
}

TEST(Refusal, NamesWhatDoesNotFitTogether) {
  const std::string ring = "[stator]\nmass = 1\nstiffness = 1\n";
  const std::string table =
      "[actuator]\nkind = \"table\"\ntable_position = [-1e-3, -5e-4, 5e-4, 1e-3]\n";
  const std::string magnet =
      "[actuator]\nkind = \"electromagnet\"\nforce_constant = 1e-4\nbias_current = 3\n"
      "air_gap = \"5 mm\"\n";
  expect_refused({
      {"both forms", modal("[rotor.modal]", "length = 1\n[rotor.modal]"), 4, "rotor.modal",
       "by its modes and by its geometry"},
      {"key of the other form", modal_and("station = 0.2\n"), 11, "contact.station",
       "the geometry form"},
      {"shape in the geometry form",
       geometry_and("[magnetic_bearing]\nnegative_stiffness = 1\nstation = 0\nshape = [1, 1]\n"),
       13, "magnetic_bearing.shape", "the modal form"},
      {"key of another kind", full("gain = 0.5", "gain = 0.5\nbreakdown_slip = 1"), 24,
       "drive.breakdown_slip", "kind = \"kloss\""},
      {"lists of two lengths", modal("[2e5, 3e6]", "[2e5]"), 5, "rotor.modal.stiffness",
       "expected 2 value(s)"},
      {"short shape", full("shape = [1.0, 1.0]", "shape = [1.0]"), 45, "force[0].shape",
       "expected 2 value(s)"},
      {"short torsion list", full("drive_shape = [0.0]", "drive_shape = []"), 20,
       "rotor.torsion.drive_shape", "expected 1 value(s)"},
      {"short start", modal_and("[initial]\nvx = [1]\n"), 12, "initial.vx", "expected 2 value(s)"},
      {"long start", geometry_and("[initial]\nx = [0, 0, 0]\n"), 11, "initial.x",
       "expected 2 value(s)"},
      {"torsion without torsion", modal_and("[initial]\ntorsion = [1]\n"), 12, "initial.torsion",
       "needs [rotor.torsion]"},
      {"ring without ring", modal_and("[initial]\nstator = [0, 0]\n"), 12, "initial.stator",
       "needs [stator]"},
      {"actuator without ring", modal_and("[actuator]\n"), 11, "actuator", "needs [stator]"},
      {"limit of an ideal actuator on magnets", modal_and(ring + magnet + "force_limit = 100\n"),
       19, "actuator.force_limit", "kind = \"ideal\""},
      {"key of magnets on an ideal actuator", modal_and(ring + "[actuator]\nair_gap = 1\n"), 15,
       "actuator.air_gap", "kind = \"electromagnet\""},
      {"a magnet's current turned round", modal_and(ring + magnet + "current_limit = 4\n"), 19,
       "actuator.current_limit", "actuator.bias_current = 3"},
      {"rate of a current that follows at once",
       modal_and(ring + magnet + "current_rate_limit = 1\n"), 19, "actuator.current_rate_limit",
       "needs actuator.coil_lag"},
      {"voltage of a current that follows at once",
       modal_and(ring + magnet + "inductance = 1\nvoltage_limit = 1\n"), 20,
       "actuator.voltage_limit", "needs actuator.coil_lag"},
      {"voltage of a coil without inductance",
       modal_and(ring + magnet + "coil_lag = 1e-4\nvoltage_limit = 1\n"), 20,
       "actuator.voltage_limit", "needs actuator.inductance"},
      {"resistance without a voltage limit", modal_and(ring + magnet + "resistance = 1\n"), 19,
       "actuator.resistance", "needs actuator.voltage_limit"},
      {"table of three currents",
       modal_and(ring + table + "table_current = [-1, 0, 1]\ntable_force = [0]\n"), 17,
       "actuator.table_current", "four values or more"},
      {"table without the middle",
       modal_and(ring + table + "table_current = [0, 1, 2, 3]\ntable_force = [0]\n"), 17,
       "actuator.table_current", "from below 0 to above 0"},
      {"table with a hole",
       modal_and(ring + table + "table_current = [-2, -1, 1, 2]\ntable_force = [1, 2, 3]\n"), 18,
       "actuator.table_force", "expected 16 values"},
      {"controller without ring", modal_and("[controller]\nkind = \"passive\"\n"), 11, "controller",
       "needs [stator]"},
      {"sliding without contact", geometry_and(ring + "[controller]\nkind = \"sliding\"\n"), 13,
       "controller", "needs [contact]"},
      {"turning ring without contact", geometry_and(ring + "[stator.spin]\ninertia = 1\n"), 13,
       "stator.spin", "needs [contact]"},
      {"turning ring of no inertia", modal_and(ring + "[stator.spin]\ninertia = 0\n"), 15,
       "stator.spin.inertia", "> 0"},
      {"gap in the sections", geometry("from = 0.0", "from = 0.1"), 7, "rotor.section[0].from",
       "without gap"},
      {"sections too short", geometry("to = 0.6", "to = 0.5"), 8, "rotor.section[0].to",
       "cover 0 to"},
      {"section backwards", geometry("from = 0.0", "from = 0.7"), 8, "rotor.section[0].to",
       "beyond"},
      {"overlap", geometry_and("[[rotor.section]]\nfrom = 0.5\nto = 0.6\ndiameter = 0.1\n"), 11,
       "rotor.section[1].from", "overlap"},
      {"station off the shaft",
       geometry_and("[magnetic_bearing]\nnegative_stiffness = 1\nstation = 0.61\n"), 12,
       "magnetic_bearing.station", "not on the shaft"},
      {"magnets too weak for a free mode",
       modal("[2e5, 3e6]", "[2e5, 0]") +
           "[magnetic_bearing]\nnegative_stiffness = 2e5\n[magnetic_bearing.control]\n"
           "force_per_current = 100\nproportional = 1500\n",
       15, "magnetic_bearing.control.proportional", "50000 N/m too little to hold mode 2"},
      {"magnets too weak for a shaft that nothing holds",
       geometry_and("[magnetic_bearing]\nnegative_stiffness = 2e5\nstation = 0.1\n"
                    "[magnetic_bearing.control]\nforce_per_current = 100\nproportional = 2000\n"),
       15, "magnetic_bearing.control.proportional", "give more than 2000 A/m"},
      {"feedback without its bearing",
       modal_and("[magnetic_bearing.control]\nforce_per_current = 100\nproportional = 2000\n"), 11,
       "magnetic_bearing.negative_stiffness", "missing"},
      {"an integrator alone",
       modal("[2e5, 3e6]", "[2e5, 3e6]") +
           "[magnetic_bearing]\nnegative_stiffness = 0\n[magnetic_bearing.control]\n"
           "force_per_current = 100\nproportional = 0\nintegral = 5\n",
       16, "magnetic_bearing.control.integral", "needs magnetic_bearing.control.proportional"},
      {"feedback without a gain",
       modal_and("[magnetic_bearing]\nnegative_stiffness = 1\n[magnetic_bearing.control]\n"
                 "force_per_current = 100\n"),
       13, "magnetic_bearing.control.proportional", "missing"},
      {"magnets that push the wrong way",
       modal_and("[magnetic_bearing]\nnegative_stiffness = 1\n[magnetic_bearing.control]\n"
                 "force_per_current = -100\nproportional = 1\n"),
       14, "magnetic_bearing.control.force_per_current", "> 0"},
      {"failed before the start",
       modal_and("[magnetic_bearing]\nnegative_stiffness = 1\n[magnetic_bearing.control]\n"
                 "force_per_current = 100\nproportional = 1\nfails_at = -1\n"),
       16, "magnetic_bearing.control.fails_at", ">= 0"},
      {"bearing off the shaft", geometry_and("[[rotor.bearing]]\nz = 1\nstiffness = 1\n"), 11,
       "rotor.bearing[0].z", "not on the shaft"},
      {"modes and max_frequency", geometry("modes = 2", "modes = 2\nmax_frequency = 900"), 6,
       "rotor.max_frequency", "not both"},
      {"nu and G", geometry("modes = 2", "modes = 2\nnu = 0.3\nG = 8e10"), 7, "rotor.G",
       "not both"},
      {"table of one speed",
       full("\"linear\"\ngain = 0.5\nspeed = \"50 Hz\"",
            "\"table\"\ntable_speed = [1]\ntable_torque = [1]"),
       23, "drive.table_speed", "two speeds"},
      {"table out of order",
       full("\"linear\"\ngain = 0.5\nspeed = \"50 Hz\"",
            "\"table\"\ntable_speed = [1, 1]\ntable_torque = [1, 2]"),
       23, "drive.table_speed", "ascending"},
      {"table of two lengths",
       full("\"linear\"\ngain = 0.5\nspeed = \"50 Hz\"",
            "\"table\"\ntable_speed = [1, 2]\ntable_torque = [1]"),
       24, "drive.table_torque", "expected 2 value(s)"},
  });
}

// ---------------------------------------------------------------- depth of keys
// The limit protects the stack: it counts the dots of keys, whatever the values contain.

std::string times_over(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// A key of `dots` dots.
std::string deep_key(int dots) { return times_over("a.", dots) + "b"; }

bool toml_is_read(const std::string& text) {
  std::vector<Diagnostic> wrong;
  return parse_toml(text, "scene.toml", wrong).has_value();
}

TEST(KeyDepth, DotsOfValuesStringsAndCommentsDoNotCount) {
  const std::string times = "output_times = [" + times_over("0.0001, ", 1000) + "0.2]";
  const std::string table =
      "f = [" + times_over("[" + times_over("1.5, ", 40) + "1.5], ", 40) + "[0.5]]";
  const std::string text = times_over(".", 5000);
  for (const std::string& read :
       {times, table, "a = \"" + text + "\"", "a = '" + text + "'",
        "a = \"\"\"" + text + "\n" + text + "\"\"\"", "a = '''" + text + "\n" + text + "'''",
        "# " + text, "a.b = 1 # " + text, "a = [" + times_over("{b.c = 1.5}, ", 1500) + "]",
        "[x]\n" + times, deep_key(kDeepestKey) + " = 1", "[" + deep_key(kDeepestKey) + "]",
        "a.b.c = 1\n" + times_over("[[d.e.f]]\n", 1001)}) {
    EXPECT_EQ(line_of_too_deep_key(read), 0) << read.substr(0, 40);
    EXPECT_TRUE(toml_is_read(read)) << read.substr(0, 40);
  }
}

TEST(KeyDepth, DeepKeysAreRefusedWhereverTheyHide) {
  const std::string deep = deep_key(kDeepestKey + 1);
  const std::string half = deep_key(kDeepestKey / 2 + 1);
  for (const std::string& refused :
       {deep + " = 1", "[" + deep + "]", "[[" + deep + "]]", times_over("a . ", 1001) + "b = 1",
        "x = {" + deep + " = 1}", "x = [1.5, {" + deep + " = 1}]", half + " = {" + half + " = 1}",
        half + " = [0.5, {c = 1, " + half + " = 1}]", times_over("\"=\".", 1001) + "b = 1",
        times_over("'#'.", 1001) + "b = 1", "x = [\"\"\"\"\"\", {" + deep + " = 1}]",
        "x = [\"\"\"\n\"\"\", {" + deep + " = 1}]", "x = ['''a''''', {" + deep + " = 1}]",
        "x = [\"\\\"\", {" + deep + " = 1}]", "x = [\"\"\"\\\"\"\"\", {" + deep + " = 1}]",
        "x = [\n{" + half + " = [\n{" + half + " = 1}]}]"}) {
    EXPECT_EQ(line_of_too_deep_key("# first\n" + refused) > 1, true) << refused.substr(0, 40);
    EXPECT_FALSE(toml_is_read(refused)) << refused.substr(0, 40);
  }
}

TEST(KeyDepth, TheRefusalNamesTheLineAndWhatIsAccepted) {
  EXPECT_EQ(test::message_of([] {
              parse_scene("[run]\nend = 0.5\n" + deep_key(1001) + " = 1\n", "scene.toml");
            }),
            "scene.toml:3: a key has more than 1000 dots; shorten it");
}

}  // namespace
}  // namespace rotorub::scene
