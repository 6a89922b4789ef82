// A user's controller: finding and loading it, its measurements, refusals, and the message if it
// fails.
#include "native_model/control/library.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "native_model/model/actuation.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/control/own_law.h"
#include "tests/support/native_run.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub {
namespace {

namespace fs = std::filesystem;
using test::expect_said;
using test::kLibraries;
using test::own_law_refusal;
using test::own_law_text;

// A scene in the folder of the libraries, as from a file there.
scene::Scene read(const std::string& library, const std::string& config = "",
                  const std::vector<std::string>& overrides = {}) {
  return test::own_law_scene(library, config, overrides);
}

TEST(Library, KeepsItsStateAndIsCalledOnceASample) {
  const Model m = prepare(read("faulty_controller.so"));
  ASSERT_NE(m.first().loop, nullptr);
  EXPECT_EQ(m.first().controller->state_size(), 3u);
  std::vector<double> memory(m.first().loop->memory_size(), 0.0);
  const State s = initial_state(m);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d u =
        control_sample(m, k * 5e-4, s.q.data(), s.v.data(), {0.0, 0.0}, memory.data());
    EXPECT_LT((u - Eigen::Vector2d(101.0 + k, k)).norm(), 1e-12) << "by way of the axes";
  }
}

TEST(Library, EveryIntegratorGivesTheSameCommands) {
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    scene::Scene s = read("faulty_controller.so");
    s.run.integrator = integrator;
    s.run.output_step = 1e-4;
    const Trajectory t = test::complete(run_native(s));
    const auto &x = t.column("control_x"), &y = t.column("control_y");
    for (std::size_t row = 1; row < 100; ++row) {
      if (row % 5 == 0) continue;  // at a sample before or after it
      EXPECT_NEAR(y[row], static_cast<double>(row / 5), 1e-12) << t.integrator << " " << row;
      EXPECT_NEAR(x[row], 101.0 + static_cast<double>(row / 5), 1e-12)
          << t.integrator << " " << row;
    }
  }
}

TEST(Library, RefusalsNameKeyAndReason) {
  expect_said(own_law_refusal(read("nowhere.so")),
              {"controller.library", "not found", "nowhere.so"});
  const test::TemporaryFolder folder;
  const fs::path none = folder.write("no_library.so", "not a library");
  expect_said(own_law_refusal(read(none.string())), {"controller.library", "no_library.so"});
  expect_said(own_law_refusal(read("other_abi_controller.so")),
              {"controller.library", "4711", "needs ABI 1"});
  expect_said(own_law_refusal(read("odd_controller.so")),
              {"controller.library", "neither ROTORUB_FORCE"});
  expect_said(own_law_refusal(read("current_controller.so")),
              {"controller.library", "commands currents"});
  expect_said(own_law_refusal(read("faulty_controller.so", "fault = \"huge\"")),
              {"controller.library", "state of"});
  expect_said(own_law_refusal(read("faulty_controller.so", "fault = \"create\"\nat = 2.5")),
              {"controller.config", "faulty refuses: it does not like the number 2.5"});
  expect_said(own_law_refusal(read("faulty_controller.so", "fault = \"throw in create\"")),
              {"controller.config", "thrown in create"});
  expect_said(own_law_refusal(read("../bin/../lib/faulty_controller.so")), {});
}

TEST(Library, IsRefusedWithoutASampleTimeAndConfigByOtherKinds) {
  const auto parse = [](const std::vector<std::string>& overrides) -> std::string {
    const auto wrong = test::refusals([&] {
      scene::parse_scene(own_law_text("faulty_controller.so", "gain = 1"), "own.toml", overrides);
    });
    return wrong.empty() ? "" : to_string(wrong.front());
  };
  EXPECT_EQ(parse({}), "");
  expect_said(parse({"controller.sample_time=0"}), {"controller.sample_time", "> 0"});
  expect_said(parse({"controller.config.gain=true"}),
              {"controller.config.gain", "finite number, or a text"});
  expect_said(parse({"controller.config.gain=nan"}), {"controller.config.gain", "finite"});
  EXPECT_EQ(parse({"controller.kind=passive"}), "") << "its config goes with its kind";
  expect_said(parse({"controller.kind=passive", "controller.config.gain=2"}),
              {"controller.config", "belongs to kind = \"library\""});
}

// With every integrator the run ends at the sample that failed, also at the first one, and the
// message has the name and the time.
TEST(Library, AFailureEndsTheRunWithNameAndTime) {
  const std::pair<std::string, const char*> faults[] = {{"step", "the encoder is lost"},
                                                        {"nan", "not finite"},
                                                        {"nan state", "state is not finite"},
                                                        {"throw", "thrown in step"},
                                                        {"throw a number", "threw"}};
  for (const auto& [fault, word] : faults) {
    for (const double at : {0.0, 0.004}) {
      for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
        scene::Scene s =
            read("faulty_controller.so", "fault = \"" + fault + "\"\nat = " + std::to_string(at));
        s.run.integrator = integrator;
        const Trajectory t = run_native(s);
        EXPECT_EQ(t.status, Status::kControllerFailed) << t.integrator;
        expect_said(t.message, {"faulty", at > 0.0 ? "0.004" : "0.000", word});
        EXPECT_NEAR(t.end, at, 1.1e-5) << t.integrator;
        for (const auto& column : t.series) {
          for (const double x : column.values) ASSERT_TRUE(std::isfinite(x)) << column.name;
        }
      }
    }
  }
  EXPECT_STREQ(to_string(Status::kControllerFailed), "controller_failed");
}

// ------------------------------------------------------------------ where it may come from

class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    setenv(name, value.c_str(), 1);
  }
  ~Environment() { unsetenv(name_); }

 private:
  const char* name_;
};

TEST(LibraryPath, AModelDoesNotLoadCodeByItself) {
  scene::Scene s = read((kLibraries / "faulty_controller.so").string());
  s.folder.reset();  // it came in an MJCF
  expect_said(own_law_refusal(s), {"controller.library", "ROTORUB_CONTROLLER_PATH"});
  const Environment path("ROTORUB_CONTROLLER_PATH", "/nowhere");
  EXPECT_EQ(own_law_refusal(s), "") << "absolute, and the variable is set";
}

TEST(LibraryPath, IsLookedUpInTheFoldersOfTheVariable) {
  scene::Scene s = read("faulty_controller.so");
  s.folder.reset();
  const Environment path("ROTORUB_CONTROLLER_PATH", "/nowhere:" + kLibraries.string());
  EXPECT_EQ(library_path(s, libraries_of(s).front()), kLibraries / "faulty_controller.so");
  s.first().controller->library = "nowhere.so";
  expect_said(own_law_refusal(s),
              {"not found", "/nowhere/nowhere.so", (kLibraries / "nowhere.so").string()});
}

TEST(LibraryPath, OfASceneIsBesideIt) {
  const test::TemporaryFolder folder;
  fs::copy_file(kLibraries / "faulty_controller.so", folder / "mine.so");
  EXPECT_EQ(own_law_refusal(scene::read_scene(folder.write("own.toml", own_law_text("mine.so")))),
            "");
}

// ------------------------------------------------------------------ what may be opened
class LibraryGate : public testing::Test {
 protected:
  LibraryGate() { set_scene_libraries(SceneLibraries::kAsked); }
  ~LibraryGate() override { set_scene_libraries(SceneLibraries::kAllowed); }
};

TEST_F(LibraryGate, LibrariesOfScenesNeedPermission) {
  for (const std::string& library :
       {std::string("current_controller.so"), (kLibraries / "current_controller.so").string(),
        "../" + kLibraries.filename().string() + "/current_controller.so"}) {
    expect_said(own_law_refusal(read(library)),
                {"controller.library", "current_controller.so is not opened", "--allow-library",
                 "ROTORUB_CONTROLLER_PATH"});
  }
}

TEST_F(LibraryGate, OneFileMayBeAllowed) {
  allow_library(kLibraries / "recording_controller.so");
  EXPECT_EQ(own_law_refusal(read("recording_controller.so")), "");
  EXPECT_EQ(
      own_law_refusal(read("../" + kLibraries.filename().string() + "/recording_controller.so")),
      "");
  EXPECT_NE(own_law_refusal(read("current_controller.so")), "");
}

TEST_F(LibraryGate, AFolderMayBeAllowed) {
  const Environment path("ROTORUB_CONTROLLER_PATH", "/nowhere:" + kLibraries.string() + "/");
  EXPECT_EQ(own_law_refusal(read("faulty_controller.so")), "");
  scene::Scene elsewhere = read("faulty_controller.so");
  const test::TemporaryFolder folder;
  elsewhere.folder = folder.path();
  EXPECT_EQ(own_law_refusal(elsewhere), "") << "found there too";
  const fs::path below = folder / "gate" / "below";
  fs::create_directories(below);
  fs::copy_file(kLibraries / "faulty_controller.so", below / "mine.so");
  scene::Scene above = read("below/../below/mine.so");
  above.folder = below.parent_path().string();
  EXPECT_NE(own_law_refusal(above), "") << "not in that folder";
  const Environment whole("ROTORUB_CONTROLLER_PATH", below.parent_path().string());
  EXPECT_EQ(own_law_refusal(above), "") << "below it";
}

TEST_F(LibraryGate, ShowingASceneOpensNoLibrary) {
  set_scene_libraries(SceneLibraries::kLeftOut);
  EXPECT_EQ(own_law_refusal(read("nowhere.so")), "");
}

// ------------------------------------------------------------------ the examples

TEST(OwnController, RefusesAWordThatItDoesNotKnow) {
  expect_said(own_law_refusal(read("own_controller.so", "stifness = 1")),
              {"controller.config", "stifness", "give the numbers"});
  expect_said(own_law_refusal(read("own_controller.so", "", {"controller.sensors.rotor=false"})),
              {"positions"});
}

}  // namespace
}  // namespace rotorub
