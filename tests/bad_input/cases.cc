#include "tests/bad_input/cases.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

#include "tests/bad_input/files.h"
#include "tests/bad_input/mutations.h"

namespace rotorub::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

struct Shipped {
  std::vector<std::string> names, texts;
};

const Shipped& shipped() {
  static const Shipped all = [] {
    Shipped found;
    for (const char* folder : {"", "hard"}) {
      for (const auto& entry : fs::directory_iterator(fs::path(ROTORUB_MJCF_DIR) / folder)) {
        if (entry.path().extension() == ".toml") found.names.push_back(entry.path().string());
      }
    }
    std::sort(found.names.begin(), found.names.end());
    for (const std::string& name : found.names) found.texts.push_back(text_of(name));
    return found;
  }();
  return all;
}

constexpr const char* kScene = "scene.toml";
// The run is limited to a few hundred impacts, because the input is under test, not the run.
const Words kShort{"--end", "3ms"};

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// A command on a shipped scene.
Command of_scene(Random& random) {
  static const std::vector<Command> all{
      {Words{"run", kScene, "-o", "out"} + kShort, {0, 2, 3}, kScene},
      {Words{"run", kScene, "-o", "out", "--integrator", "event"} + kShort, {0, 2, 3}, kScene},
      {Words{"run", kScene, "-o", "out", "--integrator", "verlet"} + kShort, {0, 2, 3}, kScene},
      {Words{"run", kScene, "-o", "out", "--integrator", "verlet", "--json"} + kShort,
       {0, 2, 3},
       kScene},
      {Words{"run", kScene, "-o", "out", "--integrator", "euler"} + kShort, {0, 2, 3}, kScene},
      {Words{"run", kScene, "-o", "out", "--engine", "mujoco"} + kShort, {0, 2, 3}, kScene},
      {Words{"run", kScene, "-o", "out", "--engine", "mujoco", "--contact", "cone"} + kShort,
       {0, 2, 3},
       kScene},
      {Words{"run", kScene, "-o", "out", "--engine", "mujoco", "--contact", "coulomb", "--json"} +
           kShort,
       {0, 2, 3},
       kScene},
      {{"modes", kScene}, {0, 2, 3}, kScene},
      {{"modes", kScene, "--json"}, {0, 2, 3}, kScene},
      {{"mjcf", kScene}, {0, 2}, kScene},
      {{"mjcf", kScene, "-o", "scene.xml"}, {0, 2}, kScene},
      {{"check", kScene, "--set", "run.end=1e-3"}, {0, 1, 2, 3}, kScene},
      {{"check", kScene, "--set", "run.end=1e-3", "--json"}, {0, 1, 2, 3}, kScene},
  };
  return random.of(all);
}

// Every value of a scene can be given on the command line.
Case of_override(Random& random, const fs::path& folder) {
  constexpr std::array kKeys{"run.end",           "run.step",           "run.output_step",
                             "rotor.speed",       "rotor.modal.mass",   "rotor.modal.stiffness",
                             "contact.clearance", "contact.friction",   "contact.restitution",
                             "contact",           "stator.mass",        "stator",
                             "controller.kind",   "force[0].frequency", "force[7]",
                             "initial.x",         "gravity.vector",     "rotor"};
  const std::string& text = random.of(shipped().texts);
  write(folder / kScene, text);
  std::string set = std::string(random.of(kKeys)) + "=" + odd_value(random);
  if (random.below(10) == 0) set = odd_value(random);
  Words words{"run", kScene, "-o", "out", "--set", set};
  if (!set.starts_with("run.end")) words = words + kShort;
  return {{words, {0, 2, 3}, "--set"}, set};
}

Case of_study(Random& random, const fs::path& folder) {
  static const std::string study =
      "scene = \"scene.toml\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = "
      "\"contact.friction\"\nfrom = 0.05\nto = 0.3\n"
      "count = 3\n[[vary]]\nkey = \"rotor.speed\"\nvalues = [\"20 Hz\", 200.0]\n[run]\nintegrator "
      "= \"verlet\"\n";
  write(folder / kScene, random.of(shipped().texts));
  std::string what;
  write(folder / "study.toml", mutated(study, {}, random, what));
  return {{{"sweep", "study.toml", "-o", "out", "--jobs", "1", "--set", "run.end=1e-3"},
           {0, 2, 3},
           ".toml"},
          what};
}

// The files of a run, damaged as by an editor.
Case of_run_folder(Random& random, const fs::path& folder) {
  constexpr std::array kFiles{"series.csv",    "impacts.csv",  "events.csv",
                              "keyphasor.csv", "summary.json", "scene.toml"};
  static const std::string& ring = shipped().texts[0];
  write(folder / kScene, ring);
  bounded_run(folder, {ROTORUB_BINARY, "run", kScene, "-o", "kept", "--end", "2ms", "--quiet"});
  const std::string file = random.of(kFiles);
  std::string what = file + ": ";
  write(folder / "kept" / file, mutated(text_of(folder / "kept" / file), {}, random, what));
  return {{{"plot", "kept", "-o", "plot.html"}, {0, 2}, "kept"}, what};
}

Case of_mutated_scene(Random& random, const fs::path& folder) {
  const std::size_t k = random.below(shipped().texts.size());
  std::string what;
  write(folder / kScene, mutated(shipped().texts[k], shipped().texts, random, what));
  const Command command = of_scene(random);
  return {command, fs::path(shipped().names[k]).filename().string() + ": " + what};
}

}  // namespace

Case make_case(std::uint64_t number, const fs::path& folder) {
  Random random(number);
  const std::size_t kind = random.below(20);
  if (kind == 0) return of_run_folder(random, folder);
  if (kind == 1) return of_study(random, folder);
  if (kind == 2) return of_override(random, folder);
  return of_mutated_scene(random, folder);
}

}  // namespace rotorub::test
