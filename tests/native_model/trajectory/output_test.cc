// The files of a run: headers word for word, numbers that read back to the same bits, files that
// are complete or absent.
#include "native_model/trajectory/output.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <limits>
#include <sstream>

#include "native_model/trajectory/recorder.h"
#include "tests/support/jeffcott.h"
#include "tests/support/machine.h"
#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

class OutputTest : public ::testing::Test {
 protected:
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }
  std::string series_header(const Model& m) {
    write_series(Recorder(m, {}).finish({0.0}), folder_ / "series.csv");
    return split(content(folder_ / "series.csv"), '\n').front();
  }
  const test::TemporaryFolder folder_;
};

// The temporary file has an unpredictable name and did not exist before.
TEST_F(OutputTest, IsWrittenAsideUnderANameOfItsOwn) {
  const fs::path first = part_of(folder_ / "a.csv"), second = part_of(folder_ / "a.csv");
  EXPECT_NE(first, second);
  EXPECT_TRUE(
      first.filename().string().starts_with("a.csv.part-" + std::to_string(::getpid()) + "-"));
  for (const fs::path& part : {first, second}) EXPECT_TRUE(fs::is_regular_file(part)) << part;
}

// As the contract has it.
const std::string kCommon =
    "t,rotor_x,rotor_y,rotor_vx,rotor_vy,stator_x,stator_y,stator_vx,stator_vy,spin_angle,"
    "spin_speed,gap,gap_rate,slip,normal_force,friction_force,mode";

TEST_F(OutputTest, SeriesHeaderIsTheContracts) {
  EXPECT_EQ(series_header(prepare(test::make_scene({}))), kCommon + ",x_1,y_1,vx_1,vy_1");
  EXPECT_EQ(series_header(prepare(test::machine_scene(true))),
            kCommon +
                ",x_1,x_2,y_1,y_2,vx_1,vx_2,vy_1,vy_2,torsion_1,torsion_2,torsion_speed_1,"
                "torsion_speed_2,motor_torque")
      << "a passive bearing has no command";
  EXPECT_EQ(series_header(prepare(test::machine_scene(false))),
            kCommon +
                ",x_1,x_2,y_1,y_2,vx_1,vx_2,vy_1,vy_2,torsion_1,torsion_2,torsion_speed_1,"
                "torsion_speed_2")
      << "without a drive there is no motor";
  scene::Scene s = test::make_scene({});
  test::add_ring(s, 1.0, 0.0, 1e5);
  s.first().controller = scene::Controller{};
  s.first().controller->kind = scene::ControllerKind::kSliding;
  EXPECT_EQ(series_header(prepare(s)),
            kCommon + ",x_1,y_1,vx_1,vy_1,control_x,control_y,control_s,control_layer")
      << "what the law shows of itself";
  s.first().actuator = scene::Actuator{.kind = scene::ActuatorKind::kElectromagnet,
                                       .force_constant = 1e-4,
                                       .bias_current = 3.0,
                                       .air_gap = 5e-3,
                                       .coil_lag = 1e-4};
  EXPECT_EQ(
      series_header(prepare(s)),
      kCommon +
          ",x_1,y_1,vx_1,vy_1,control_x,control_y,current_1,current_2,control_s,control_layer");
}

TEST_F(OutputTest, SeriesReadsBackToTheSameBits) {
  Trajectory t;
  const std::vector<double> values{0.1,    1.0 / 3.0,    -2.036936721118e-3,
                                   1e-300, 123456789.25, 5e-324,
                                   0.0,    -0.0,         std::numeric_limits<double>::max()};
  t.series = {{"t", "s", values},
              {"mode", "", std::vector<double>(values.size(), 2.0)},
              {"gap", "m", {values.rbegin(), values.rend()}}};
  write_series(t, folder_ / "series.csv");
  const std::vector<std::string> lines = split(content(folder_ / "series.csv"), '\n');
  ASSERT_EQ(lines.size(), values.size() + 1);
  EXPECT_EQ(lines[0], "t,mode,gap");
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::vector<std::string> row = split(lines[k + 1], ',');
    ASSERT_EQ(row.size(), 3u);
    EXPECT_EQ(std::strtod(row[0].c_str(), nullptr), values[k]) << row[0];
    EXPECT_EQ(row[1], "stick");
    EXPECT_EQ(std::strtod(row[2].c_str(), nullptr), values[values.size() - 1 - k]);
  }
  EXPECT_EQ(content(folder_ / "series.csv").find(' '), std::string::npos);
}

TEST_F(OutputTest, NumbersAreTheShortestThatReadBack) {
  Trajectory t;
  t.series = {{"t", "s", {0.0003, 0.1, 0.1 + 0.2, 1e-9, 2.5e7, -0.0, 12345.0}}};
  write_series(t, folder_ / "series.csv");
  EXPECT_EQ(content(folder_ / "series.csv"),
            "t\n0.0003\n0.1\n0.30000000000000004\n1e-09\n2.5e+07\n0\n12345\n");
}

TEST_F(OutputTest, ImpactsAndEvents) {
  Trajectory t;
  t.impacts = {{0.25, 2.0, -0.5, -1.0, 0.5, 15.0, 14.0, -0.125}};
  t.events = {{0.25, EventKind::kImpact},
              {0.5, EventKind::kSlide},
              {0.75, EventKind::kStick},
              {1.0, EventKind::kLiftOff}};
  write_impacts(t, folder_ / "impacts.csv");
  write_events(t, folder_ / "events.csv");
  EXPECT_EQ(content(folder_ / "impacts.csv"),
            "t,normal_impulse,friction_impulse,gap_rate_before,gap_rate_after,slip_before,"
            "slip_after,energy_change\n0.25,2,-0.5,-1,0.5,15,14,-0.125\n");
  t.keyphasor = {{0.5, 0.25, -0.125, 314.0}};
  write_keyphasor(t, folder_ / "keyphasor.csv");
  EXPECT_EQ(content(folder_ / "keyphasor.csv"),
            "t,rotor_x,rotor_y,spin_speed\n0.5,0.25,-0.125,314\n");
  EXPECT_EQ(content(folder_ / "events.csv"),
            "t,event\n0.25,impact\n0.5,slide\n0.75,stick\n1,lift_off\n");
}

TEST_F(OutputTest, NothingHappenedIsAHeaderAlone) {
  write_impacts({}, folder_ / "impacts.csv");
  write_events({}, folder_ / "events.csv");
  EXPECT_EQ(split(content(folder_ / "impacts.csv"), '\n').size(), 1u);
  EXPECT_EQ(content(folder_ / "events.csv"), "t,event\n");
  EXPECT_EQ(files(), 2u) << "and nothing is left aside";
}

// The message of the failure to write `file`; empty if it is written.
std::string failure(const fs::path& file, const std::string& text) {
  return test::message_of<std::runtime_error>([&] { write_whole(file, text); });
}

TEST_F(OutputTest, AFolderThatIsNotThereIsMade) {
  write_whole(folder_ / "absent" / "below" / "a.txt", "text");
  EXPECT_EQ(content(folder_ / "absent" / "below" / "a.txt"), "text");
}

TEST_F(OutputTest, AFolderThatCannotBeMadeIsSaid) {
  write_whole(folder_ / "file", "text");
  const fs::path file = folder_ / "file" / "below" / "a.txt";
  EXPECT_EQ(failure(file, "text"), "cannot open " + file.string() + ": Not a directory");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputTest, ATargetThatCannotBeReplacedLeavesNothingAside) {
  fs::create_directories(folder_ / "a.txt" / "inside");
  EXPECT_TRUE(
      test::contains(failure(folder_ / "a.txt", "text"), {"cannot write", "Is a directory"}));
  EXPECT_EQ(files(), 1u);
  EXPECT_TRUE(fs::exists(folder_ / "a.txt" / "inside"));
}

TEST_F(OutputTest, AFullDiskKeepsTheOldFileAndNoHalfOfTheNew) {
  write_whole(folder_ / "a.txt", "old");
  // A limit on the size of files simulates a full disk.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string said = failure(folder_ / "a.txt", std::string(100000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(said.find("cannot write"), std::string::npos) << said;
  EXPECT_NE(said.find("File too large"), std::string::npos) << said;
  EXPECT_EQ(content(folder_ / "a.txt"), "old");
  EXPECT_EQ(files(), 1u);
}

// Renaming a file over a device would remove the device. (The device is a link, so that a mistake
// costs only the link.)
TEST_F(OutputTest, ADeviceIsWrittenAndNotReplaced) {
  fs::create_symlink("/dev/full", folder_ / "full");
  const std::string said = failure(folder_ / "full", "text");
  EXPECT_NE(said.find("No space left on device"), std::string::npos) << said;
  EXPECT_TRUE(fs::is_symlink(folder_ / "full"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  fs::create_symlink("/dev/null", folder_ / "null");
  EXPECT_EQ(failure(folder_ / "null", "text"), "");
  EXPECT_TRUE(fs::is_symlink(folder_ / "null"));
}

TEST_F(OutputTest, ALinkStaysOne) {
  write_whole(folder_ / "a.txt", "first");
  fs::create_symlink("a.txt", folder_ / "link");
  write_whole(folder_ / "link", "second");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(content(folder_ / "a.txt"), "second");
}

}  // namespace
}  // namespace rotorub
