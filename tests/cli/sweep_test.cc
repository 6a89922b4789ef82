// rotorub sweep: its files, and that an interrupted sweep leaves no trace.
#include <chrono>
#include <random>
#include <thread>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

using namespace std::chrono_literals;

// bench_ring over friction and stiffness.
std::string study(int frictions, int stiffnesses, const std::string& run) {
  return "scene = \"" + shipped("bench_ring") +
         "\"\n[sample]\nkind = \"grid\"\n"
         "[[vary]]\nkey = \"contact.friction\"\nfrom = 0.05\nto = 0.3\ncount = " +
         std::to_string(frictions) + "\n[[vary]]\nkey = \"stator.stiffness\"\nvalues = [" +
         [&] {
           std::string list;
           for (int i = 0; i < stiffnesses; ++i) list += std::to_string(80000 + 1000 * i) + ",";
           return list;
         }() +
         "]\n[run]\n" + run;
}

std::int64_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(Sweep, LeavesTableDatabasePageAndStudy) {
  const Folder folder;
  const std::string text =
      study(3, 2, "integrator = \"verlet\"\nstep = \"100 us\"\nend = \"50 ms\"\n");
  folder.write("study.toml", text);
  const json summary = folder.json_of({"sweep", "study.toml", "-o", "out", "--json"});
  EXPECT_EQ(summary.at("points"), 6);
  EXPECT_EQ(summary.at("done"), 6);
  EXPECT_EQ(summary.at("status").at("ok"), 6);
  EXPECT_EQ(folder.files(),
            (std::vector<std::string>{"out/columns.json", "out/results.csv", "out/results.sqlite",
                                      "out/scene.toml", "out/study.toml", "out/sweep.html",
                                      "out/sweep.json", "study.toml"}));
  EXPECT_EQ(folder.text("out/study.toml"), text);
  EXPECT_EQ(lines(folder.text("out/results.csv")), 7);
  // The second run has nothing to do and changes nothing.
  const std::string table = folder.text("out/results.csv");
  folder.done({"sweep", "study.toml", "-o", "out", "-q"});
  EXPECT_EQ(folder.text("out/results.csv"), table);
}

// Values are sorted in ascending order.
TEST(Sweep, KeepsABifurcationDiagram) {
  const Folder folder;
  folder.write("study.toml",
               "scene = \"" + shipped("bench_annular_elastic") +
                   "\"\n[sample]\nkind = \"list\"\n[[vary]]\nkey = \"contact.friction\"\n"
                   "values = [0.2, 0.1]\n[run]\nintegrator = \"event\"\nend = \"0.2 s\"\n");
  folder.done({"sweep", "study.toml", "-o", "out", "--bifurcation", "-q"});
  const json diagram = json::parse(folder.text("out/bifurcation.json"));
  EXPECT_EQ(diagram.at("key").at("name"), "contact.friction");
  ASSERT_EQ(diagram.at("up").size(), 2u);
  EXPECT_EQ(diagram.at("up")[0].at("value"), 0.1);
  EXPECT_EQ(diagram.at("down")[0].at("value"), 0.2);
  EXPECT_EQ(diagram.at("up")[1].at("continued"), true);
  EXPECT_EQ(diagram.at("up")[1].at("period"), 1) << "an annular rub in step with its force";
  EXPECT_TRUE(
      contains(folder.text("out/sweep.html"), "\"bifurcation\":{\"branches\":null,\"down\":"));
}

TEST(Sweep, DrawsBranchesInItsBifurcationDiagram) {
  const Folder folder;
  folder.write("study.toml",
               "scene = \"" + shipped("bench_annular_elastic") +
                   "\"\n[sample]\nkind = \"list\"\n[[vary]]\nkey = \"contact.friction\"\n"
                   "values = [0.1, 0.12]\n[run]\nintegrator = \"event\"\nend = \"0.2 s\"\n");
  folder.done({"sweep", "study.toml", "-o", "out", "--bifurcation", "--branches", "-q"});
  const json branches = json::parse(folder.text("out/bifurcation.json")).at("branches");
  EXPECT_TRUE(branches.at("refused").is_null()) << branches.at("refused");
  EXPECT_FALSE(branches.at("lines").empty());
  EXPECT_TRUE(contains(folder.text("out/sweep.html"), "solid: stable, dashed: unstable"));
  folder.refuses({"sweep", "study.toml", "-o", "out", "--branches"});
}

// The run of a point equals the run of its scene, and the page links to it.
TEST(Sweep, KeepsTheRunOfAPoint) {
  const Folder folder;
  folder.write("study.toml", study(3, 2, "integrator = \"event\"\nend = \"20 ms\"\n"));
  folder.done({"sweep", "study.toml", "-o", "out", "-q"});
  const auto kept = [&] {
    const std::string page = folder.text("out/sweep.html");
    const std::size_t at = page.find("\"kept\":");
    return page.substr(at, page.find('}', at) + 1 - at);
  };
  EXPECT_EQ(kept(), "\"kept\":{}");
  EXPECT_TRUE(contains(folder.text("out/sweep.html"), "rotorub sweep 'study.toml' -o 'out'"));
  const json said = folder.json_of(
      {"sweep", "study.toml", "-o", "out", "--point", "4", "--point", "1", "--json"});
  EXPECT_EQ(said.at("points")[0].at("folder"), "out/point-4");
  EXPECT_EQ(said.at("points")[1].at("status"), "ok");
  EXPECT_EQ(kept(), "\"kept\":{\"1\":\"point-1/plot.html\",\"4\":\"point-4/plot.html\"}");
  EXPECT_TRUE(folder.has("out/point-4/plot.html"));
  folder.done({"run", "out/point-4/scene.toml", "-o", "again", "-q"});
  EXPECT_EQ(folder.text("again/series.csv"), folder.text("out/point-4/series.csv"));
  folder.refuses({"sweep", "study.toml", "-o", "out", "--point", "6"}, {"expected 0 to 5"});
}

TEST(Sweep, TakesPointsFromAFile) {
  const Folder folder;
  folder.write(
      "points.csv",
      "# of two machines\nname;friction;clearance [um]\n\nfirst;0.1;450\nsecond;0.2;510\n");
  const std::string text = "scene = \"" + shipped("bench_ring") +
                           "\"\n[sample]\nkind = \"list\"\nfile = \"points.csv\"\n"
                           "[[vary]]\nkey = \"contact.friction\"\ncolumn = \"friction\"\n"
                           "[[vary]]\nkey = \"contact.clearance\"\ncolumn = \"clearance\"\n"
                           "[run]\nend = \"5 ms\"\n";
  folder.write("study.toml", text);
  folder.done({"sweep", "study.toml", "-o", "out", "-q"});
  const std::string table = folder.text("out/results.csv");
  EXPECT_TRUE(contains(table, "\n1,0.2,0.00051"));
  EXPECT_TRUE(folder.has("out/points.csv"));
  // Other points make another study.
  folder.write("points.csv", "friction,clearance\n0.1,5e-4\n0.3,5e-4\n");
  folder.refuses({"sweep", "study.toml", "-o", "out", "-q"});
  folder.write("points.csv", "friction,clearance\n0.1,5e-4\n0.3,much\n0.1\n");
  const std::vector<std::string> bad{"sweep", "study.toml", "-o", "bad"};
  folder.refuses(bad, {"the line has 1 fields, but the header has 2"});
  folder.write("points.csv", "mu,clearance\n0.1,5e-4\n0.3,much\n");
  folder.refuses(bad, {"no column `friction`; choose from mu, clearance", "points.csv:3:"});
}

TEST(Sweep, DoesNotDependOnTheThreads) {
  const Folder folder;
  for (const char* run :
       {"integrator = \"event\"\nend = \"20 ms\"\n", "integrator = \"verlet\"\nend = \"20 ms\"\n",
        "engine = \"mujoco\"\ncontact = \"rigid\"\nend = \"20 ms\"\n",
        "engine = \"mujoco\"\ncontact = \"cone\"\nend = \"20 ms\"\n"}) {
    folder.write("study.toml", study(6, 2, run));
    folder.done({"sweep", "study.toml", "-o", "one", "--jobs", "1", "-q"});
    folder.done({"sweep", "study.toml", "-o", "many", "--jobs", "3", "-q"});
    EXPECT_EQ(folder.text("one/results.csv"), folder.text("many/results.csv")) << run;
    std::filesystem::remove_all(folder.path() / "one");
    std::filesystem::remove_all(folder.path() / "many");
  }
}

TEST(Sweep, FailuresAreRows) {
  const Folder folder;
  folder.write(
      "study.toml",
      "scene = \"" + shipped("bench_ring") +
          "\"\n[sample]\nkind = \"list\"\n[[vary]]\nkey = \"contact.friction\"\nvalues = [0.1, -1, "
          "0.1]\n[[vary]]\nkey = \"run.step\"\nvalues = [1e-5, 1e-5, 0.02]\n[run]\nintegrator = "
          "\"paper\"\nend = \"40 ms\"\n");
  const Outcome outcome = folder.done({"sweep", "study.toml", "-o", "out"});
  EXPECT_TRUE(contains(outcome.out, "3 points: 1 ok, 1 refused, 1 step_too_large"));
  const std::string table = folder.text("out/results.csv");
  EXPECT_TRUE(contains(table, "refused,\"contact.friction: out of range"));
  EXPECT_FALSE(contains(table, "nan"));
}

TEST(Sweep, ASceneThatIsNotThereIsTheStudysMistake) {
  const Folder folder;
  folder.write("study.toml",
               "scene = \"nowhere.toml\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = "
               "\"run.end\"\nvalues = [1]\n");
  folder.refuses({"sweep", "study.toml", "-o", "out"},
                 {"study.toml:1: scene: nowhere.toml: cannot be read: No such file"});
}

TEST(Sweep, AnotherStudyInTheSameFolderIsRefused) {
  const Folder folder;
  const std::string run = "integrator = \"verlet\"\nend = \"10 ms\"\n";
  folder.write("study.toml", study(2, 1, run));
  folder.done({"sweep", "study.toml", "-o", "out", "-q"});
  const std::string table = folder.text("out/results.csv");
  folder.write("study.toml", study(3, 1, run));
  folder.refuses({"sweep", "study.toml", "-o", "out"}, {"another study"});
  EXPECT_EQ(folder.text("out/results.csv"), table);
  folder.write("study.toml", study(2, 1, run));
  folder.refuses({"sweep", "study.toml", "-o", "out", "--set", "run.step=1e-4"});
}

// The notes about old words name the study, its values or its scene, as those of run and compare
// do.
TEST(Sweep, NotesOldWords) {
  const Folder folder;
  const auto told = [&](const std::string& vary, const std::string& run, const std::string& set) {
    folder.write("study.toml", "scene = \"" + shipped("bench_drop") +
                                   "\"\n[sample]\nkind = \"grid\"\n[[vary]]\n" + vary +
                                   "\n[run]\nend = 1e-3\n" + run);
    std::filesystem::remove_all(folder / "out");
    return folder.done({"sweep", "study.toml", "-o", "out", "--set", set}).err;
  };
  const std::string friction = "key = \"contact.friction\"\nvalues = [0.1]";
  const std::string set = "contact.restitution=0.4";
  EXPECT_TRUE(
      contains(told(friction, "integrator = \"paper\"", set), "note: run.integrator: \"paper\""));
  EXPECT_TRUE(contains(told("key = \"run.integrator\"\nvalues = [\"event\", \"literal\"]", "", set),
                       "note: vary[0].values[1]: \"literal\""));
  EXPECT_TRUE(
      contains(told(friction, "", "run.integrator=paper"), "bench_drop.toml: run.integrator: "));
  EXPECT_FALSE(contains(told(friction, "", set), "note: "));
}

TEST(Sweep, UsageErrors) {
  const Folder folder;
  folder.write("study.toml", study(2, 1, "end = \"10 ms\"\n"));
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"nothing.toml"},
                                                {"study.toml", "--shard", "3/2"},
                                                {"study.toml", "--jobs", "0"},
                                                {"study.toml", "--shard", "1/2", "--slurm"},
                                                {"study.toml", "--merge", "nowhere"},
                                                {"study.toml", "--tasks", "3"},
                                                {"study.toml", "--bifurcation"},
                                                {"study.toml", "--bifurcation", "--shard", "1/2"},
                                                {"study.toml", "--set", "contact.friction=0.2"},
                                                {"study.toml", "--set", "contact.x=1"}}) {
    folder.refuses(with(with({"sweep"}, wrong), {"-o", "out"}));
    EXPECT_FALSE(folder.has("out/results.csv")) << wrong.back();
  }
}

TEST(Sweep, InterruptedItSaysSoAndGoesOn) {
  const Folder folder;
  folder.write("study.toml", study(60, 10, "integrator = \"event\"\n"));
  Program program(folder.path(), {"sweep", "study.toml", "-o", "out", "-q"});
  while (!folder.has("out/results.sqlite")) std::this_thread::sleep_for(10ms);
  std::this_thread::sleep_for(200ms);
  program.interrupt();
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_FALSE(folder.has("out/results.csv"));
  folder.done({"sweep", "study.toml", "-o", "out", "-q"});
  EXPECT_EQ(lines(folder.text("out/results.csv")), 601);
}

// Ten times, at times that depend on the machine and the generator.
void expect_no_trace_of_kills(const std::string& text, const std::vector<std::string>& how) {
  const Folder folder;
  folder.write("study.toml", text);
  folder.done({"sweep", "study.toml", "-o", "whole", "-q"});
  const std::string whole = folder.text("whole/results.csv");
  std::mt19937 random(20260101);
  const std::vector<std::string> arguments =
      with({"sweep", "study.toml", "-o", "killed", "-q"}, how);
  int kills = 0;
  for (; kills < 10; ++kills) {
    Program program(folder.path(), arguments);
    std::this_thread::sleep_for(std::chrono::milliseconds(
        std::uniform_int_distribution<int>(kills == 0 ? 1 : 30, 250)(random)));
    if (program.kill_and_wait().code == 0) break;  // it was done before
  }
  EXPECT_GE(kills, 3) << "too quick to be killed: take more points";
  folder.done({"sweep", "study.toml", "-o", "killed", "-q"});
  EXPECT_EQ(folder.text("killed/results.csv"), whole);
  for (const std::string& file : folder.files()) {
    EXPECT_FALSE(contains(file, ".part"));
    EXPECT_FALSE(contains(file, "journal"));
  }
}

TEST(LongSweep, KilledTenTimesItLeavesTheSameTable) {
  expect_no_trace_of_kills(study(50, 20, "integrator = \"event\"\n"), {"--jobs", "1"});
}

TEST(LongSweep, ShardsOfWhichOneIsKilledAndRunAgainMergeIntoTheSameTable) {
  const Folder folder;
  folder.write("study.toml", study(20, 20, "integrator = \"event\"\n"));
  folder.done({"sweep", "study.toml", "-o", "whole", "-q"});
  const auto shard = [](int number) {
    return std::vector<std::string>{"sweep", "study.toml", "-o",
                                    "out",   "-q",         "--jobs",
                                    "1",     "--shard",    std::to_string(number) + "/4"};
  };
  {
    Program victim(folder.path(), shard(3));
    std::this_thread::sleep_for(150ms);
    EXPECT_EQ(victim.kill_and_wait().code, 128 + SIGKILL);
  }
  for (const int number : {1, 2, 4}) folder.done(shard(number));
  const std::vector<std::string> merge{"sweep", "study.toml", "-o", "out", "--merge", "out", "-q"};
  const Outcome early = folder.run(merge);
  EXPECT_EQ(early.code, 3);
  EXPECT_TRUE(contains(early.err, "missing"));
  EXPECT_FALSE(folder.has("out/results.csv"));
  folder.done(shard(3));
  folder.done(merge);
  EXPECT_EQ(folder.text("out/results.csv"), folder.text("whole/results.csv"));
}

}  // namespace
}  // namespace rotorub::test
