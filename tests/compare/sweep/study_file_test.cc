#include "compare/sweep/study_file.h"

#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

using test::contains;
using test::of_ring;
using test::sampled;
using test::StudyFolder;

TEST(Study, OfTheContract) {
  const StudyFolder folder;
  std::filesystem::copy_file(ROTORUB_MJCF_DIR "/bench_ring.toml",
                             folder.path() / "bench_ring.toml");
  const Study study = folder.study(R"(scene = "bench_ring.toml"
[sample]
kind = "grid"
[[vary]]
key = "contact.friction"
from = 0.05
to = 0.3
count = 40
[run]
integrator = "verlet"
)");
  EXPECT_EQ(study.scene, folder.path() / "bench_ring.toml");
  EXPECT_EQ(study.kind, SampleKind::kGrid);
  ASSERT_EQ(study.vary.size(), 1u);
  EXPECT_EQ(study.vary[0].key, "contact.friction");
  EXPECT_EQ(study.vary[0].count, 40);
  EXPECT_EQ(study.integrator, scene::Integrator::kVerlet);
  EXPECT_EQ(study.engine, EngineKind::kNative);
}

// [controller.config] accepts any name, with a number or a text.
TEST(Study, TakesTheNamesOfTheUsersLaw) {
  const StudyFolder folder;
  const Study study = folder.study(
      of_ring() + sampled("list", {{"controller.config.stiffness", "[1e5, 2e5]"},
                                   {"contact[0].controller.config.law", R"(["soft", "hard"])"}}));
  EXPECT_EQ(study.vary[0].values[1].number, 2e5);
  EXPECT_EQ(study.vary[1].values[1].text, "hard");
  EXPECT_EQ(study.vary[0].unit, "");
  const std::string range = "[[vary]]\nkey = \"controller.config.gain\"\nfrom = 0\nto = 1\n";
  EXPECT_EQ(folder.refusal(of_ring() + "[sample]\nkind = \"grid\"\n" + range + "count = 3\n"), "");
}

// The last part of such a key is the user's own, so only the rest can be misspelt.
TEST(Study, SuggestsTheTableOfAUsersOwnParameter) {
  const StudyFolder folder;
  for (const auto& [key, meant] :
       {std::pair("controller.confg.P", "controller.config.P"),
        std::pair("magnetic_controll.config.gain", "magnetic_control.config.gain")}) {
    EXPECT_TRUE(contains(folder.refusal(of_ring() + sampled("grid", {{key, "[1, 2]"}})),
                         std::string("did you mean `") + meant + "`?"));
  }
}

TEST(Study, QuantitiesAreInTheUnitOfTheirKey) {
  const StudyFolder folder;
  const Study study =
      folder.study(of_ring() + sampled("list", {{"force[0].amplitude", R"(["0.1 kN", 150])"},
                                                {"run.integrator", R"(["event", "paper"])"},
                                                {"stator.stiffness", "[[1e5, 2e5], 1e5]"}}));
  EXPECT_EQ(study.vary[0].values[0].number, 100.0);
  EXPECT_EQ(study.vary[0].values[0].text, "100");
  EXPECT_EQ(study.vary[0].unit, "N");
  EXPECT_EQ(study.vary[1].values[1].text, "paper");
  EXPECT_FALSE(study.vary[1].values[1].number);
  EXPECT_FALSE(study.vary[2].values[0].number);
}

TEST(Study, EverythingWrongAtOnceWithLines) {
  const StudyFolder folder;
  const std::string text = folder.refusal(of_ring() + R"([sample]
kind = "list"
runs = 3
[[vary]]
key = "contact.frictoin"
values = [0.1, 0.2]
[[vary]]
key = "rotor.speed"
values = ["40 Hz", "50 mm"]
[[vary]]
key = "run.integrator"
values = ["event"]
[run]
integrator = "verlet"
stp = 1
end = -1
)");
  for (const char* part :
       {"study.toml:4: sample.runs: belongs to kind",
        "study.toml:6: vary[0].key:", "did you mean `contact.friction`?",
        "study.toml:10: vary[1].values[1]:", "50 mm", "has 1 values, but", "run.integrator varies",
        "did you mean `step`?", "run.end: expected a time above 0"}) {
    EXPECT_TRUE(contains(text, part));
  }
}

// Such names fit neither behind `key =` nor on one line of the results.
TEST(Study, TablesAndBrokenLinesAreNoValues) {
  const StudyFolder folder;
  for (const char* values : {"[{a = 1}, 0.1]", "[[{a = 1}]]", "[1979-05-27]", "[\"a\\nb\"]"}) {
    for (const char* key : {"controller.kind", "initial.x", "stator"})
      EXPECT_TRUE(contains(folder.refusal(of_ring() + sampled("grid", {{key, values}})),
                           "study.toml:6: vary[0].values: values[0]: expected a "));
  }
}

// The table counts as the one that was meant, so it is not reported as missing.
TEST(Study, ReportsAMisspeltTableOnce) {
  const StudyFolder folder;
  const std::string vary = "key = \"contact.friction\"\nvalues = [0.1]\n";
  for (const auto& [text, said] :
       {std::pair(of_ring() + "[sample]\nkind = \"grid\"\n[[varry]]\n" + vary,
                  "study.toml:4: varry: unknown key, did you mean `vary`?"),
        std::pair(of_ring() + "[sampel]\nkind = \"grid\"\n[[vary]]\n" + vary,
                  "study.toml:2: sampel: unknown key, did you mean `sample`?")}) {
    const std::string refusal = folder.refusal(text);
    EXPECT_TRUE(contains(refusal, said));
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
  }
}

// Each case has one mistake.
TEST(Study, Refused) {
  const StudyFolder folder;
  const std::string grid = of_ring() + "[sample]\nkind = \"grid\"\n[[vary]]\n";
  const std::string friction = grid + "key = \"contact.friction\"\n";
  const struct {
    std::string text, says;
  } cases[] = {
      {"", "scene: missing"},
      {of_ring(), "sample.kind: is missing"},
      {of_ring() + "[sample]\nkind = \"gird\"\n",
       "did you mean `grid`? Choose from grid, latin_hypercube, list"},
      {of_ring() + "[sample]\nkind = \"grid\"\n", "vary: missing"},
      {friction, "vary[0].from: missing"},
      {friction + "from = 0\nto = 1\n", "vary[0].count: missing"},
      {friction + "from = 0\nto = 1\ncount = 0\n", "whole number in [1,"},
      {friction + "from = 0\nto = 1\ncount = 3\nspacing = \"log\"\n", "above 0"},
      {friction + "from = 0\nto = nan\ncount = 3\n", "not finite"},
      {friction + "values = []\n", "at least one value"},
      {friction + "values = [1]\ncount = 1\n", "together with `values`"},
      {grid + "key = \"run.integrator\"\nfrom = 0\nto = 1\ncount = 2\n", "values: missing"},
      {friction + "values = [1]\n[[vary]]\nkey = \"contact.friction\"\nvalues = [2]\n", "twice"},
      {friction + "values = [1]\nalso = [\"no.key\"]\n", "not a key of a scene"},
      {of_ring() + "[sample]\nkind = \"latin_hypercube\"\n[[vary]]\nkey = \"contact.friction\"\n"
                   "from = 0\nto = 1\n",
       "sample.runs: missing"},
      {friction + "from = 0\nto = 1\ncount = 100000\n[[vary]]\nkey = \"rotor.speed\"\nfrom = 1\n"
                  "to = 2\ncount = 100000\n",
       "1e+10 points"},
      {friction + "values = [1]\n[run]\nengine = \"native\"\ncontact = \"cone\"\n",
       "run.contact: belongs to engine"},
      {friction + "values = [1]\n[run]\nengine = \"mujoco\"\nintegrator = \"event\"\n",
       "run.integrator: belongs to engine"},
  };
  for (const auto& c : cases) {
    EXPECT_TRUE(contains(folder.refusal(c.text), c.says));
  }
}

}  // namespace
}  // namespace rotorub::sweep
