// rotorub sweep --slurm on a real Slurm of one node.

#include "tests/cli/slurm_cluster.h"

namespace rotorub::test {
namespace {

// 1600 points of bench_ring with the event integrator: seconds for each of four shards.
std::string study() {
  return "scene = \"" + shipped("bench_ring") + R"("
[sample]
kind = "latin_hypercube"
runs = 1600
seed = 1
[[vary]]
key = "contact.friction"
from = 0.05
to = 0.3
[[vary]]
key = "rotor.speed"
from = "40 Hz"
to = "60 Hz"
[run]
integrator = "event"
)";
}

TEST(LongSlurm, ATaskThatIsKilledAndSubmittedAgainLeavesTheSameTable) {
  if (const std::string program = SlurmCluster::missing(); !program.empty()) {
    GTEST_SKIP() << program << " is missing: Debian packages slurm-wlm and munge";
  }
  const Folder folder;
  folder.write("study.toml", study());
  folder.done({"sweep", "study.toml", "-o", "whole", "-q"});

  const SlurmCluster slurm;
  const std::vector<std::string> submit{"sweep",   "study.toml", "-o",     "out", "--slurm",
                                        "--tasks", "4",          "--jobs", "1",   "--json"};
  const json job = folder.json_of(submit, slurm.surroundings());
  EXPECT_EQ(job.at("tasks"), json({1, 2, 3, 4}));

  // Task 3 has begun; SIGKILL ends everything that it runs.
  const std::string file = "out/results.3-of-4.sqlite";
  slurm.wait_until("file of shard 3", [&] { return folder.has(file); });
  slurm.command("scancel --full --signal=KILL " + job.at("job").get<std::string>() + "_3");
  slurm.wait_for_all_jobs();
  const std::vector<std::string> merge{"sweep", "study.toml", "-o", "out", "--merge", "out", "-q"};
  EXPECT_EQ(folder.run(merge).code, 3) << "task 3 was to be killed before it was done";

  // After the second submission only this task runs.
  const Outcome second = folder.done(submit, slurm.surroundings());
  EXPECT_EQ(json::parse(second.out).at("tasks"), json({3}));
  slurm.wait_for_all_jobs();
  const Outcome merged = folder.done(merge);
  EXPECT_EQ(folder.text("out/results.csv"), folder.text("whole/results.csv"));
  for (const char* log : {"out/slurm-1.log", "out/slurm-3.log"}) {
    EXPECT_TRUE(contains(folder.text(log), "shard ")) << log;
  }

  // Everything is done, so nothing is submitted.
  const Outcome third = folder.done({"sweep", "study.toml", "-o", "out", "--slurm", "--tasks", "4"},
                                    slurm.surroundings());
  EXPECT_TRUE(contains(third.out, "every shard is done"));
  // Another number of tasks would divide the points differently.
  folder.refuses({"sweep", "study.toml", "-o", "out", "--slurm", "--tasks", "3"});
}

TEST(Slurm, WithoutSbatchTheScriptIsThereAndTheReasonIsSaid) {
  const Folder folder;
  folder.write("study.toml", study());
  Surroundings bare;
  bare.environment.emplace_back("PATH", "/nonexistent");
  const Outcome outcome = folder.run({"sweep", "study.toml", "-o", "out", "--slurm"}, bare);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(contains(outcome.err, "sbatch is not found"));
  EXPECT_TRUE(folder.has("out/sweep.sbatch"));
}

}  // namespace
}  // namespace rotorub::test
