#include "compare/sweep/store.h"

#include "compare/sweep/folder.h"
#include "compare/sweep/shard.h"
#include "native_model/scene/reader.h"
#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

using test::of_ring;
using test::StudyFolder;

class StoreTest : public testing::Test {
 protected:
  StoreTest()
      : study(folder.study(of_ring() +
                           test::sampled("grid", {{"contact.friction", "[0.1, 0.2, 0.3]"}}))),
        sample(study) {}

  Store open(const std::string& name, const Shard& shard = {}) {
    return {folder.path() / name, study, {"h", sample.size()}, shard};
  }
  static PointResult result(std::int64_t point, double force) {
    PointResult r;
    r.point = point;
    r.figures.emplace().mean_force = force;
    return r;
  }
  std::string csv(Store& store) {
    write_csv(store, folder.path() / "results.csv");
    return scene::file_text(folder.path() / "results.csv");
  }

  StudyFolder folder;
  Study study;
  Sample sample;
};

TEST_F(StoreTest, RowsComeInTheOrderOfTheStudyToTheLastBit) {
  Store store = open("results.sqlite");
  const double third = 1.0 / 3.0;
  PointResult failed;
  failed.point = 2;
  failed.status = "diverged";
  failed.reason = "a \"comma\", and more";
  store.add(std::vector{failed}, sample);
  store.add(std::vector{result(1, third), result(0, 1e-300)}, sample);
  const std::string text = csv(store);
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "point,contact.friction,status,reason,end,steps,first_touch,impacts,contact_fraction,"
            "mean_force,peak_force,impulse_total,attractor,contact_share,whirl_frequency,"
            "spin_speed,peak_impulse,friction_work,max_penetration,energy_residual,"
            "forward_passes,backward_passes,whirl_time,hard_impacts,lasting_fraction");
  EXPECT_NE(text.find("\n0,0.1,ok,,0,0,,0,0,1e-300,"), std::string::npos) << text;
  EXPECT_NE(text.find(",0.3333333333333333,"), std::string::npos);
  EXPECT_NE(text.find("\n2,0.3,diverged,\"a \"\"comma\"\", and more\",,,"), std::string::npos);
}

TEST_F(StoreTest, APointIsThereOnce) {
  Store store = open("results.sqlite");
  store.add(std::vector{result(0, 1.0)}, sample);
  EXPECT_THROW(store.add(std::vector{result(1, 1.0), result(0, 1.0)}, sample), DatabaseError);
  EXPECT_EQ(store.count(), 1);  // the transaction is whole or not at all
  EXPECT_EQ(store.done(), (std::vector<bool>{true, false, false}));
}

TEST_F(StoreTest, OneProcessAtATime) {
  const Store first = open("results.sqlite");
  try {
    open("results.sqlite");
    FAIL() << "a second one must not come in";
  } catch (const DatabaseError& error) {
    EXPECT_TRUE(error.busy);
  }
}

TEST_F(StoreTest, ShardsMergeIntoTheWhole) {
  const Shard one{1, 2}, two{2, 2};
  open(one.file(), one).add(std::vector{result(0, 1.0), result(2, 3.0)}, sample);
  open(two.file(), two).add(std::vector{result(1, 2.0)}, sample);
  std::string merged, whole;
  {
    Store store = open("results.sqlite");
    for (const auto& file : result_files(folder.path())) {
      if (file.filename() != "results.sqlite") store.merge(file);
    }
    store.merge(folder.path() / one.file());  // twice is as once
    EXPECT_EQ(store.count(), 3);
    merged = csv(store);
  }
  Store store = open("whole.sqlite");
  store.add(std::vector{result(0, 1.0), result(1, 2.0), result(2, 3.0)}, sample);
  EXPECT_EQ(csv(store), merged);
}

TEST_F(StoreTest, ADifferingPointIsNotMerged) {
  open("results.1-of-2.sqlite").add(std::vector{result(0, 1.0)}, sample);
  Store store = open("results.sqlite");
  store.add(std::vector{result(0, 1.5)}, sample);
  EXPECT_THROW(store.merge(folder.path() / "results.1-of-2.sqlite"), StoreMismatch);
  EXPECT_THROW(store.merge(folder.path() / "nothing.sqlite"), DatabaseError);
}

TEST_F(StoreTest, WhatIsNoDatabaseIsRefused) {
  folder.write("results.sqlite", "this is not a database, but long enough to be taken for one\n");
  EXPECT_THROW(open("results.sqlite"), DatabaseError);
}

TEST(Shard, IsIOfN) {
  EXPECT_EQ(parse_shard("2/4").number, 2);
  EXPECT_EQ(parse_shard("2/4").file(), "results.2-of-4.sqlite");
  EXPECT_EQ(parse_shard("1/1").file(), "results.sqlite");
  for (const char* text : {"", "2", "0/4", "5/4", "1/0", "a/b", "1/2/3", "-1/2", "1/99999"}) {
    EXPECT_THROW(parse_shard(text), std::invalid_argument) << text;
  }
}

// Every point belongs to one shard, and the shards' numbers of points say how many.
TEST(Shard, CoverAllPointsOnce) {
  for (const std::int64_t points : {1, 31, 32, 33, 100, 1000}) {
    for (const int count : {1, 2, 3, 7, 50}) {
      std::int64_t all = 0;
      for (int number = 1; number <= count; ++number) {
        const Shard shard{number, count};
        std::int64_t mine = 0;
        for (std::int64_t point = number - 1; point < points; point += count) ++mine;
        EXPECT_EQ(mine, shard.points_of(points)) << points << " " << number << "/" << count;
        all += mine;
      }
      EXPECT_EQ(all, points);
    }
  }
}

// A path with a line break adds no command to the script, neither in the commands nor in the
// comments.
TEST(SlurmScript, KeepsAPathOnItsLine) {
  sweep::SlurmJob job;
  job.program = "/usr/bin/rotorub";
  job.study = "/tmp/a\ntouch owned\n/it's\\.toml";
  job.folder = "/tmp/out\r\nrm x";
  const std::string script = sweep::slurm_script(job);
  for (const char* command : {"\ntouch owned", "\nrm x"})
    EXPECT_EQ(script.find(command), std::string::npos) << script;
  EXPECT_NE(script.find(R"($'/tmp/a\x0atouch owned\x0a/it\'s\\.toml')"), std::string::npos)
      << script;
}

TEST(Slurm, TheScriptQuotesWhatTheUserNamed) {
  SlurmJob job;
  job.program = "/opt/a b/rotorub";
  job.study = "/data/it's.toml";
  job.folder = "/data/$HOME";
  job.tasks = 4;
  job.jobs = 2;
  job.overrides = {"contact.friction=0.1"};
  const std::string script = slurm_script(job);
  for (const char* part :
       {"#!/bin/bash\n", "#SBATCH --array=1-4\n", "#SBATCH --cpus-per-task=2\n",
        "exec '/opt/a b/rotorub' sweep '/data/it'\\''s.toml'", "-o '/data/$HOME'",
        "--shard \"$SLURM_ARRAY_TASK_ID/4\" --jobs 2", "--set 'contact.friction=0.1'"}) {
    EXPECT_NE(script.find(part), std::string::npos) << part << "\n" << script;
  }
}

// Results may come from anywhere: a view of that name could run for ever.
TEST_F(StoreTest, RefusesWhatIsBesideItsTables) {
  const std::string endless =
      "CREATE VIEW late AS WITH RECURSIVE n(k) AS (SELECT 1 UNION ALL SELECT k + 1 FROM n) "
      "SELECT k FROM n";
  for (const std::string& foreign :
       {endless,
        std::string("CREATE TRIGGER again AFTER INSERT ON points BEGIN DELETE FROM meta; END"),
        std::string("CREATE TABLE other (x)")}) {
    std::filesystem::remove(folder.path() / "results.sqlite");
    open("results.sqlite");
    Database(folder.path() / "results.sqlite", Database::Mode::kWrite).execute(foreign);
    EXPECT_THROW(open("results.sqlite"), StoreMismatch) << foreign;
    Store whole = open("whole.sqlite");
    EXPECT_THROW(whole.merge(folder.path() / "results.sqlite"), StoreMismatch) << foreign;
    std::filesystem::remove(folder.path() / "whole.sqlite");
  }
}

TEST_F(StoreTest, RefusesAPointThatTheStudyHasNot) {
  open("results.sqlite");
  Database(folder.path() / "results.sqlite", Database::Mode::kWrite)
      .execute("INSERT INTO points (point, status, reason) VALUES (-1, 'ok', '')");
  Store store = open("results.sqlite");
  EXPECT_THROW(store.done(), StoreMismatch);
}

}  // namespace
}  // namespace rotorub::sweep
