// The line on standard error that says how many points rotorub sweep runs and how long they take.
#include <regex>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

// Six points.
class SweepPlan : public testing::Test {
 protected:
  SweepPlan() {
    std::ofstream(folder.path() / "study.toml")
        << "scene = \"" << shipped("bench_ring")
        << "\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = \"contact.friction\"\nvalues = [0.1, "
           "0.2, 0.3]\n[[vary]]\nkey = \"stator.stiffness\"\nvalues = [1e5, 2e5]\n"
           "[run]\nintegrator = \"event\"\nend = \"1 ms\"\n";
  }
  // Standard error of a sweep into out/.
  std::string said(const std::vector<std::string>& more = {}) const {
    return folder.done(with(words, more)).err;
  }

  const std::vector<std::string> words{"sweep", "study.toml", "-o", "out", "--jobs", "2"};
  Folder folder;
};

// True if this is the line of these points; the time depends on the machine.
testing::AssertionResult is_line(const std::string& said, const std::string& points,
                                 const std::string& after = "") {
  const std::regex line("rotorub sweep: " + points +
                        " will take (less than 1 s|about [0-9]+ (s|min)) with 2 jobs" + after +
                        "\n");
  return std::regex_match(said, line) ? testing::AssertionSuccess()
                                      : testing::AssertionFailure() << said;
}

TEST_F(SweepPlan, StandsBesideTheJson) {
  const Outcome done = folder.done(with(words, {"--json"}));
  EXPECT_TRUE(is_line(done.err, "6 points"));
  EXPECT_EQ(json::parse(done.out).at("done"), 6);
}

TEST_F(SweepPlan, IsNotForAQuietSweep) {
  EXPECT_EQ(said({"--quiet"}), "");
  EXPECT_EQ(said({"-q"}), "") << "nor where nothing is left";
}

TEST_F(SweepPlan, HasThePointsOfAShard) {
  EXPECT_TRUE(is_line(said({"--shard", "1/4"}), "2 points of shard 1/4"));
  EXPECT_TRUE(is_line(said({"--shard", "4/4"}), "1 point of shard 4/4"));
  EXPECT_EQ(said({"--shard", "4/4"}),
            "rotorub sweep: nothing is left to run; results of 1 point of shard 4/4 are stored\n");
}

TEST_F(SweepPlan, HasThePointsThatAreLeft) {
  said({"--shard", "1/3", "-q"});
  // The results of the whole then have the points of the shard and no others.
  const Outcome merged = folder.run(with(words, {"--merge", "out"}));
  EXPECT_EQ(merged.code, 3);
  EXPECT_TRUE(merged.err.starts_with("rotorub sweep: 4 of 6 points are missing in ")) << merged.err;
  EXPECT_TRUE(is_line(said(), "4 of 6 points", "; the others are done"));
  EXPECT_EQ(said(), "rotorub sweep: nothing is left to run; results of 6 points are stored\n");
}

}  // namespace
}  // namespace rotorub::test
