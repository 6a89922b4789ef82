// rotorub optimise: its files, and its message if it finds nothing.
#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

std::string study(const std::string& goal) {
  return "scene = \"" + shipped("bench_ring") +
         "\"\n[[vary]]\nkey = \"stator.damping\"\nfrom = 20\nto = 2000\nspacing = \"log\"\n"
         "[run]\nintegrator = \"verlet\"\nstep = \"50 us\"\nend = \"0.1 s\"\n[optimise]\n" +
         goal;
}

TEST(Optimise, LeavesTheBestSceneAndItsWay) {
  const Folder folder;
  folder.write("study.toml", study("minimise = \"peak_impulse\"\nevaluations = 12\n"));
  const json found = folder.json_of({"optimise", "study.toml", "-o", "out", "--json"});
  EXPECT_EQ(folder.files(),
            (std::vector<std::string>{"out/best.toml", "out/columns.json", "out/evaluations.csv",
                                      "out/optimum.html", "out/optimum.json", "out/study.toml",
                                      "study.toml"}));
  EXPECT_LE(found.at("evaluations"), 12);
  EXPECT_EQ(found, folder.json_in("out/optimum.json"));
  // The best scene gives the best figure.
  folder.done({"run", "out/best.toml", "--integrator", "verlet", "-o", "best", "-q"});
  double largest = 0.0;
  std::istringstream impacts(folder.text("best/impacts.csv"));
  std::string line;
  std::getline(impacts, line);
  while (std::getline(impacts, line))
    largest = std::max(largest, std::stod(line.substr(line.find(',') + 1)));
  EXPECT_DOUBLE_EQ(largest, found.at("best").at("figure").get<double>());
  EXPECT_TRUE(contains(folder.text("out/optimum.html"), "Which values of "));
  // A second run gives the same bytes.
  const std::string way = folder.text("out/evaluations.csv");
  folder.done({"optimise", "study.toml", "-o", "again", "-q"});
  EXPECT_EQ(folder.text("again/evaluations.csv"), way);
}

TEST(Optimise, SaysWhereThereIsNothing) {
  const Folder folder;
  folder.write("study.toml", study("minimise = \"peak_impulse\"\nevaluations = 5\n"
                                   "[[optimise.constraint]]\nfigure = \"impacts\"\nmax = -1\n"));
  const Outcome none = folder.run({"optimise", "study.toml", "-o", "out"});
  EXPECT_EQ(none.code, 3);
  EXPECT_TRUE(contains(none.out, "none of them meets the constraints; the nearest, evaluation "));
  EXPECT_FALSE(folder.has("out/best.toml"));
  folder.write("study.toml", study("minimise = \"peak_impulse\"\n"));
  folder.refuses({"optimise", "study.toml", "--set", "stator.damping=100"},
                 {"varies in the study"});
}

// A study for both commands: the sweep ignores the goal, and its stored points stay valid.
TEST(Optimise, AStudyMayBeASweepToo) {
  const Folder folder;
  const std::string text = study("minimise = \"peak_impulse\"\nevaluations = 3\n");
  const std::size_t spacing = text.find("spacing");
  folder.write("study.toml", text.substr(0, spacing) + "count = 3\n" + text.substr(spacing) +
                                 "[sample]\nkind = \"grid\"\n");
  folder.done({"sweep", "study.toml", "-o", "map", "-q"});
  folder.done({"optimise", "study.toml", "-o", "out", "-q"});
  folder.write("study.toml", text);
  folder.refuses({"sweep", "study.toml", "-o", "none"}, {"sample.kind: is missing"});
}

}  // namespace
}  // namespace rotorub::test
