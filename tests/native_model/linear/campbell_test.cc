#include "native_model/linear/campbell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "native_model/rotor/modal_rotor.h"
#include "tests/native_model/rotor/rotors.h"

namespace rotorub {
namespace {

using test::jeffcott;
using test::kBeam;
using test::kShaft;
using test::kTight;
using test::miss;
using test::pinned_shaft;
using test::scene_of;

constexpr double k4000Rpm = 4000.0 * std::numbers::pi / 30.0;

TEST(Campbell, RayleighShaft) {
  constexpr int kModes = 8;
  const WhirlSystem system = whirl_system(scene_of(pinned_shaft(kModes)));
  for (double speed : {0.0, 1.0, 500.0, 5e3, 1e5}) {
    const WhirlSpectrum spectrum = whirl_spectrum(system, speed);
    ASSERT_EQ(spectrum.modes.size(), 2u * kModes);
    for (int n = 1; n <= kModes; ++n) {
      EXPECT_LT(miss(spectrum, kShaft.forward(n, speed)), kBeam) << n << " at " << speed;
      EXPECT_LT(miss(spectrum, kShaft.backward(n, speed)), kBeam) << n << " at " << speed;
    }
  }
}

TEST(Campbell, FriswellRotorAt4000Rpm) {
  const WhirlSpectrum spectrum =
      whirl_spectrum(whirl_system(scene_of(oracle::friswell_rotor())), k4000Rpm);
  ASSERT_EQ(spectrum.modes.size(), oracle::kFriswellAt4000Rpm.size());
  for (std::size_t j = 0; j < spectrum.modes.size(); ++j) {
    const double digits = j == 5 ? 5e-3 : 5e-4;  // half a unit of the last digit printed
    EXPECT_NEAR(spectrum.modes[j].frequency, oracle::kFriswellAt4000Rpm[j], digits);
    EXPECT_NEAR(spectrum.modes[j].damping_ratio, 0.0, 1e-11);
  }
}

// The example in the documentation of another program (ROSS): within the effect of shear, and to
// all digits for elements without shear.
TEST(Campbell, RossExample) {
  const WhirlSystem system = whirl_system(scene_of(oracle::ross_rotor(6)));
  const auto rising = [&](double speed) {
    std::vector<double> all;
    for (const auto& mode : whirl_spectrum(system, speed).modes)
      all.push_back(std::abs(mode.frequency));
    std::sort(all.begin(), all.end());
    return all;
  };
  const std::vector<double> at_rest = rising(0.0), turning = rising(100.0);
  for (std::size_t j = 0; j < oracle::kRossAtRest.size(); ++j) {
    const double shear = at_rest[j] / oracle::kRossAtRest[j] - 1.0;
    EXPECT_NEAR(shear, j == 0 ? 5.5e-4 : 6.0e-4, 0.5e-4) << j;
  }
  for (std::size_t j = 0; j < oracle::kUnshearedRossAtRest.size(); ++j) {
    EXPECT_NEAR(at_rest[j] / oracle::kUnshearedRossAtRest[j], 1.0, 2e-8) << j;
    EXPECT_NEAR(turning[j] / oracle::kUnshearedRossAt100[j], 1.0, 2e-8) << j;
  }
}

// The reduced model of a run misses whirl at speed by what the modes left out would add; with more
// modes it goes to the untruncated figures from one side.
TEST(Campbell, ReducedModelConvergesToTheUntruncatedShaft) {
  const double exact =
      whirl_spectrum(whirl_system(scene_of(oracle::friswell_rotor())), k4000Rpm).modes[5].frequency;
  double last = std::numeric_limits<double>::infinity();
  for (int kept : {3, 6, 12, 24}) {
    scene::RotorGeometry g = oracle::friswell_rotor();
    g.modes = kept;
    const ModalRotor rotor = modal_rotor(scene_of(g));
    scene::Scene reduced;
    reduced.rotor.modal.emplace();
    reduced.rotor.modal->mass.assign(rotor.x.mass.begin(), rotor.x.mass.end());
    reduced.rotor.modal->stiffness.assign(rotor.x.stiffness.begin(), rotor.x.stiffness.end());
    WhirlSystem system = whirl_system(reduced);
    const Eigen::VectorXd scale = rotor.x.mass.cwiseSqrt().cwiseInverse();
    system.gyroscopic = scale.asDiagonal() * rotor.gyroscopic * scale.asDiagonal();
    system.gyroscopic = (0.5 * (system.gyroscopic + system.gyroscopic.transpose())).eval();
    const double error =
        std::abs(whirl_spectrum(system, k4000Rpm).modes[5].frequency / exact - 1.0);
    EXPECT_LT(error, 0.7 * last) << kept << " modes";
    last = error;
  }
  EXPECT_LT(last, 1e-3);
}

// One mode in each plane with gyroscopic coupling: (w_x^2 - w^2)(w_y^2 - w^2) = (Omega g w / m)^2.
TEST(Campbell, AnisotropicJeffcottWithGyroscopicTerm) {
  scene::Scene s = jeffcott(2.0, 2e5, 0.0);
  s.rotor.modal->stiffness_y = {1.2e5};
  s.rotor.modal->gyroscopic = {0.8};
  const double speed = 200.0, a = 1e5, b = 0.6e5, c = std::pow(speed * 0.4, 2);
  const double p = 0.5 * (a + b + c);
  const double root = std::sqrt(p * p - a * b);
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(s), speed);
  ASSERT_EQ(spectrum.modes.size(), 2u);
  EXPECT_NEAR(spectrum.modes[0].frequency / -std::sqrt(p - root), 1.0, kTight);
  EXPECT_NEAR(spectrum.modes[1].frequency / std::sqrt(p + root), 1.0, kTight);
}

TEST(Campbell, OverdampedModesHaveNoFrequency) {
  for (bool anisotropic : {false, true}) {
    scene::Scene s = jeffcott(1.0, 100.0, 101.0);  // s = -1 and -100
    if (anisotropic) s.rotor.modal->stiffness_y = {400.0};
    for (const WhirlMode& mode : whirl_spectrum(whirl_system(s), 0.0).modes) {
      EXPECT_EQ(mode.frequency, 0.0);
      EXPECT_NEAR(mode.damping_ratio, 1.0, kTight);
    }
  }
}

// A dashpot of the bearing damps the modes by the deflection they have there: c u^2 / (2 m omega).
TEST(Campbell, BearingDampers) {
  scene::Scene s = scene_of(oracle::friswell_rotor());
  constexpr double kDamping = 10.0;  // N s/m, weak: of first order
  for (scene::ShaftBearing& b : s.rotor.geometry->bearings) b.damping = {kDamping, kDamping};
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(s), 0.0);
  const ModalRotor rotor = modal_rotor(s);
  for (int n = 0; n < 3; ++n) {
    double at_bearings = 0.0;
    for (const StationDamper& d : rotor.bearing_dampers) at_bearings += d.shape.x[n] * d.shape.x[n];
    const double expected =
        kDamping * at_bearings / (2.0 * std::sqrt(rotor.x.mass[n] * rotor.x.stiffness[n]));
    EXPECT_NEAR(spectrum.modes[static_cast<std::size_t>(2 * n)].damping_ratio / expected, 1.0,
                1e-4);
  }
}

TEST(Campbell, MagneticBearingSoftensTheRotor) {
  scene::Scene s = jeffcott(2.0, 2e5, 0.0);
  s.magnetic_bearings.emplace_back().negative_stiffness = 0.5e5;
  const WhirlSystem system = whirl_system(s);
  EXPECT_NEAR(whirl_spectrum(system, 10.0).modes[1].frequency, std::sqrt(0.75e5), 1e-6);
  EXPECT_FALSE(stability_threshold(system));

  // Stronger than the shaft: the rotor falls to one side without turning.
  s.magnetic_bearings[0].negative_stiffness = 2.1e5;
  const std::optional<double> threshold = stability_threshold(whirl_system(s));
  ASSERT_TRUE(threshold);
  EXPECT_EQ(*threshold, 0.0);
}

// At the station of a bearing it is the same as a bearing that much softer.
TEST(Campbell, MagneticBearingInGeometryForm) {
  scene::Scene magnetic = scene_of(oracle::friswell_rotor());
  magnetic.magnetic_bearings.emplace_back().station = 1.5;
  magnetic.magnetic_bearings[0].negative_stiffness = 0.4e6;
  scene::Scene soft = scene_of(oracle::friswell_rotor());
  soft.rotor.geometry->bearings[1].stiffness = {0.6e6, 0.6e6};
  const WhirlSystem system = whirl_system(magnetic);
  EXPECT_TRUE(system.isotropic);
  const WhirlSpectrum expected = whirl_spectrum(whirl_system(soft), k4000Rpm);
  const WhirlSpectrum found = whirl_spectrum(system, k4000Rpm);
  for (std::size_t j = 0; j < expected.modes.size(); ++j) {
    EXPECT_NEAR(found.modes[j].frequency / expected.modes[j].frequency, 1.0, kBeam) << j;
  }
}

// ---------------------------------------------------------------- branches
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

TEST(Condensed, DoesNotChangeASmallSystem) {
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
