#include "compare/run_files/run_directory.h"

#include <gtest/gtest.h>

#include <fstream>

#include "compare/engine/engine.h"
#include "compare/run_files/summary.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub {
namespace {

class RunDirectory : public testing::Test {
 protected:
  RunDirectory() {
    scene_ = test::shipped("bench_ring", {"run.end=0.02"});
    run_ = native_engine(scene::Integrator::kVerlet)->run(scene_, {});
  }
  static void write(const std::filesystem::path& folder, const scene::Scene& scene,
                    const Trajectory& run) {
    write_run(folder, scene, run, summary_json(scene, run));
  }
  const test::TemporaryFolder own_;
  const std::filesystem::path folder_ = own_ / "run";
  scene::Scene scene_;
  Trajectory run_;
};

TEST_F(RunDirectory, ReadsBackTheSameBits) {
  write(folder_, scene_, run_);
  const StoredRun stored = read_run(folder_);
  EXPECT_EQ(stored.scene.name, scene_.name);
  EXPECT_EQ(scene::scene_hash(stored.scene), scene::scene_hash(scene_));
  ASSERT_EQ(stored.trajectory.series.size(), run_.series.size());
  for (std::size_t k = 0; k < run_.series.size(); ++k) {
    EXPECT_EQ(stored.trajectory.series[k].name, run_.series[k].name);
    EXPECT_EQ(stored.trajectory.series[k].values, run_.series[k].values);
  }
  ASSERT_EQ(stored.trajectory.impacts.size(), run_.impacts.size());
  ASSERT_FALSE(run_.impacts.empty());
  EXPECT_EQ(stored.trajectory.impacts[0].t, run_.impacts[0].t);
  EXPECT_EQ(stored.trajectory.engine, "native");
  EXPECT_EQ(stored.trajectory.step, run_.step);
}

// The page of a run says the same of the rub as the terminal, which the series alone do not
// contain.
TEST_F(RunDirectory, TheKeptResultHasTheAnswerOfTheRun) {
  write(folder_, scene_, run_);
  const auto answer_of = [](const result::Section& result) {
    std::string text = result::text_of(result);
    std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
    const std::size_t begin = text.find("rubs:");
    return text.substr(begin, text.find("meannormalforce") - begin);
  };
  const result::Section kept = kept_result(read_run(folder_).summary);
  EXPECT_EQ(answer_of(kept), answer_of(run_result(scene_, run_)));
  EXPECT_TRUE(answer_of(kept).starts_with("rubs:yes,from")) << answer_of(kept);
  EXPECT_TRUE(test::contains(result::text_of(kept), "impulse_total"));
  // An earlier version may have written fewer files.
  EXPECT_TRUE(result::text_of(kept_result({{"status", "ok"}})).empty());
}

// A page of an earlier run beside the series of this one would show another motion.
TEST_F(RunDirectory, RemovesWhatWasMadeOfAnEarlierRun) {
  write(folder_, scene_, run_);
  for (const char* file : {kRunPage, kLyapunovFile, "run.h5", "notes.txt"})
    std::ofstream(folder_ / file) << "of the first run";
  write(folder_, scene_, run_);
  for (const char* file : {kRunPage, kLyapunovFile, "run.h5"})
    EXPECT_FALSE(std::filesystem::exists(folder_ / file)) << file;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "notes.txt")) << "is the user's";
  // A folder without a run may have a page of that name.
  const auto page = own_.write(std::filesystem::path("other") / kRunPage, "mine");
  write(own_ / "other", scene_, run_);
  EXPECT_TRUE(std::filesystem::exists(page));
}

TEST_F(RunDirectory, NamesFileAndLineOfDamage) {
  write(folder_, scene_, run_);
  std::ofstream(folder_ / "series.csv", std::ios::app) << "1,2,nonsense\n";
  EXPECT_TRUE(test::contains(test::message_of([&] { read_run(folder_); }), "series.csv:"));
}

// The shadow belongs to the MuJoCo run of its own scene.
TEST_F(RunDirectory, TheShadowIsThatOfTheSameScene) {
  const auto scene_with = [](const char* friction) {
    return test::shipped("bench_ring", {"run.end=0.02", "mujoco.shadow=true", friction});
  };
  const scene::Scene own = scene_with("contact.friction=0.15"),
                     other = scene_with("contact.friction=0.2");
  Trajectory mujoco = run_;
  mujoco.engine = "mujoco";
  write(folder_, own, mujoco);
  EXPECT_FALSE(read_shadow(folder_, read_run(folder_))) << "there is none yet";
  write(folder_ / kShadowFolder, own, run_);
  const auto shadow = read_shadow(folder_, read_run(folder_));
  ASSERT_TRUE(shadow);
  EXPECT_EQ(shadow->trajectory.series[1].values, run_.series[1].values);
  write(folder_, other, mujoco);
  EXPECT_FALSE(read_shadow(folder_, read_run(folder_)));
  write(folder_, own, run_);
  EXPECT_FALSE(read_shadow(folder_, read_run(folder_))) << "a native run";
}

TEST_F(RunDirectory, AFolderWithoutARunIsRefused) {
  std::filesystem::create_directories(folder_);
  EXPECT_THROW(read_run(folder_), std::runtime_error);
}

}  // namespace
}  // namespace rotorub
