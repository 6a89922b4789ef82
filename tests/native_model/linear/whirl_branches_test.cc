#include "native_model/linear/campbell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/native_model/rotor/rotors.h"

namespace rotorub {
namespace {

// Each branch holds modes of the spectra, all of them, each once.
void expect_all_of_the_spectra(const WhirlSystem& system, const std::vector<double>& speeds,
                               const std::vector<WhirlBranch>& branches) {
  for (double speed : speeds) {
    std::vector<double> expected, found;
    for (const WhirlMode& mode : whirl_spectrum(system, speed).modes) {
      expected.push_back(mode.frequency);
    }
    for (const WhirlBranch& branch : branches) {
      for (std::size_t k = 0; k < branch.speed.size(); ++k) {
        if (branch.speed[k] == speed) found.push_back(branch.modes[k].frequency);
      }
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << speed;
  }
}

TEST(WhirlBranches, FollowEveryModeOfAShaft) {
  const WhirlSystem system = whirl_system(test::reference_rig());
  const std::vector<double> speeds = even_speeds(2000.0, 41);
  const std::vector<WhirlBranch> branches = whirl_branches(system, speeds);
  ASSERT_EQ(branches.size(), 6u) << "three modes, forward and backward";
  for (const WhirlBranch& branch : branches) {
    EXPECT_EQ(branch.speed, speeds);
    const bool forward = branch.modes.front().frequency > 0.0;
    for (const WhirlMode& mode : branch.modes) EXPECT_EQ(mode.frequency > 0.0, forward);
    const double first = std::abs(branch.modes.front().frequency);
    const double last = std::abs(branch.modes.back().frequency);
    EXPECT_TRUE(forward ? last >= first : last <= first);
  }
  expect_all_of_the_spectra(system, speeds, branches);
}

// Two uncoupled modes; the lower one has a disc that stiffens it until its forward whirl crosses
// that of the other. Each keeps to its own damping, which sorting by frequency would swap.
TEST(WhirlBranches, KeepToTheirModeWhereTwoCross) {
  scene::Scene s = test::jeffcott(1.0, 1e4, 1.0);
  s.rotor.modal->mass = {1.0, 1.0};
  s.rotor.modal->stiffness = {1e4, 4e4};   // 100 and 200 rad/s
  s.rotor.modal->damping = {2.0, 40.0};    // 1 % and 10 %
  s.rotor.modal->gyroscopic = {1.0, 0.0};  // crosses at Omega = 150 rad/s
  const WhirlSystem system = whirl_system(s);
  const std::vector<double> speeds = even_speeds(400.0, 101);
  const std::vector<WhirlBranch> branches = whirl_branches(system, speeds);
  ASSERT_EQ(branches.size(), 4u);
  for (const WhirlBranch& branch : branches) {
    ASSERT_EQ(branch.speed, speeds);
    const bool stiff = std::abs(std::abs(branch.modes.front().frequency) - 199.0) < 1.0;
    for (const WhirlMode& mode : branch.modes) {
      if (stiff) {
        EXPECT_NEAR(mode.damping_ratio, 0.1, 1e-12);
      } else {
        EXPECT_LT(mode.damping_ratio, 0.011);
      }
    }
  }
  expect_all_of_the_spectra(system, speeds, branches);
}

// Planes that differ: the sense may change along a branch, which goes on.
TEST(LongWhirlBranches, GoOnWhereTheSenseChanges) {
  const WhirlSystem system = whirl_system(test::anisotropic_rotor());
  const std::vector<double> speeds = even_speeds(500.0, 51);
  const std::vector<WhirlBranch> branches = whirl_branches(system, speeds);
  ASSERT_EQ(branches.size(), 6u);
  for (const WhirlBranch& branch : branches) EXPECT_EQ(branch.speed, speeds);
  expect_all_of_the_spectra(system, speeds, branches);
}

// Fewer coordinates, the same kept modes.
TEST(Condensed, KeepsTheKeptModes) {
  constexpr double kAccuracy = 1e-5, kSpeed = 600.0;
  const WhirlSystem whole = whirl_system(test::anisotropic_rotor());
  const WhirlSystem part = condensed(whole, kSpeed, kAccuracy);
  EXPECT_LT(part.size(), whole.size() / 2);
  EXPECT_EQ(part.kept, whole.kept);
  for (double speed : {0.0, 0.4 * kSpeed, kSpeed}) {
    const WhirlSpectrum expected = whirl_spectrum(whole, speed);
    const WhirlSpectrum found = whirl_spectrum(part, speed);
    ASSERT_EQ(found.modes.size(), expected.modes.size());
    for (std::size_t j = 0; j < found.modes.size(); ++j) {
      EXPECT_NEAR(found.modes[j].frequency / expected.modes[j].frequency, 1.0, kAccuracy);
      EXPECT_NEAR(found.modes[j].damping_ratio, expected.modes[j].damping_ratio, kAccuracy);
    }
  }
}

TEST(Condensed, LeavesASmallSystemAlone) {
  const WhirlSystem whole = whirl_system(test::jeffcott(2.0, 2e5, 40.0));
  EXPECT_EQ(condensed(whole, 100.0, 1e-5).size(), whole.size());
}

TEST(WhirlBranches, TellTheirProgressAndCanBeStopped) {
  const WhirlSystem system = whirl_system(test::jeffcott(2.0, 2e5, 40.0));
  std::vector<double> shares;
  whirl_branches(system, even_speeds(100.0, 4), [&](double share) { shares.push_back(share); });
  EXPECT_EQ(shares, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
  EXPECT_THROW(whirl_branches(system, even_speeds(100.0, 4),
                              [](double) { throw std::runtime_error("stop"); }),
               std::runtime_error);
}

}  // namespace
}  // namespace rotorub
