// The plugin in a recent MuJoCo against MuJoCo 2.2.2, each in its own unmodified testspeed.
#include <gtest/gtest.h>

#include <cmath>

#include "mjcf/writer.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/today/testspeed.h"

namespace rotorub::test {
namespace {

struct Case {
  const char* scene;  // "own_model": the example that is written by hand
  const char* contact;
  double bound;  // m, largest difference of a coordinate (rad for the spin); 0: the same bits
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << " " << c.contact; }

std::string with(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// Without its motor the rotor of the example would not reach the ring, so it is thrown at it.
std::string own_model() {
  // Recent versions of testspeed read controls from the keyframe, that of 2.2.2 does not.
  return with(with(own_model_example(), "qvel=\"0 0 300", "qvel=\"1 0 300"), "320 0 0", "0 0 0");
}

std::string document_of(const Case& c, const MujocoVersion& target) {
  if (std::string(c.scene) == "own_model") return own_model();
  return mjcf(shipped(c.scene, {std::string("mujoco.contact=") + c.contact}), target);
}

constexpr MujocoVersion kOld{2, 2, 2};

// The mass matrix is summed in another order.
constexpr double kRoundOff = 1e-12;
// MuJoCo's solver ends elsewhere within its tolerance.
constexpr double kSolver = 1e-9;

class Versions : public TestspeedTest, public ::testing::WithParamInterface<Case> {
 protected:
  static constexpr int kSteps = 20000;
};

TEST_P(Versions, GiveTheSameRun) {
  const std::vector<double> now = last(document_of(GetParam(), built_for()), kSteps);
  const std::vector<double> then = last(document_of(GetParam(), kOld), kSteps, {.today = false});
  ASSERT_EQ(now.size(), then.size());
  double most = 0.0;
  for (std::size_t i = 0; i < 1 + now.size() / 2; ++i) {
    most = std::max(most, std::abs(now[i] - then[i]));
  }
  RecordProperty("difference", std::to_string(most * 1e12) + " pm");
  EXPECT_LE(most, GetParam().bound);
  EXPECT_NE(last(document_of(GetParam(), built_for()), kSteps, {.plugin = false}), now)
      << "the plugin did nothing";
}

TEST_P(Versions, ThreadsChangeNoBit) {
  const std::string document = document_of(GetParam(), built_for());
  const std::vector<double> one = last(document, kSteps);
  const auto two = run(document, kSteps, {.threads = 2});
  ASSERT_GE(two.size(), 2u);
  EXPECT_EQ(two[two.size() - 1], one);
  EXPECT_EQ(two[two.size() - 2], one);
  EXPECT_EQ(last(document, kSteps, {.engine_threads = 2}), one) << "MuJoCo's own pool";
}

INSTANTIATE_TEST_SUITE_P(
    Long, Versions,
    ::testing::Values(Case{"bench_ring", "rigid", 0.0}, Case{"bench_billiard", "rigid", 0.0},
                      Case{"bench_annular_rigid", "rigid", 0.0},
                      Case{"bench_annular_elastic", "rigid", 0.0}, Case{"bench_whip", "rigid", 0.0},
                      Case{"paper_sliding", "rigid", kRoundOff},
                      Case{"paper_magnetic", "rigid", kRoundOff},
                      Case{"own_model", "rigid", kRoundOff}, Case{"bench_ring", "coulomb", kSolver},
                      Case{"bench_annular_elastic", "coulomb", kSolver},
                      Case{"bench_whip", "coulomb", kSolver}));

class OtherVersion : public TestspeedTest {};

// A library that was built for another MuJoCo would read other structures.
TEST_F(OtherVersion, IsRefused) {
  const std::string document = document_of({"bench_ring", "rigid", 0.0}, built_for());
  run(document, 100, {.plugin_file = ROTORUB_SYSTEM_LIBS "/librotorub_mujoco.so"});
  EXPECT_NE(said_.find("built for MuJoCo 2.2.2, but the program has another version"),
            std::string::npos)
      << said_;
  EXPECT_NE(status_, 0);
}

}  // namespace
}  // namespace rotorub::test
