// Bearings that couple the planes, depend on the speed or are off the line, against closed forms:
// the shaft is so stiff and its bearings so soft that it is a rigid body.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// Middle of 4 kg on two bearings of 1e4 N/m and 20 N s/m; 2.6e-7 of the deflection is the shaft's.
constexpr const char* kRigid = R"(
[run]
end = 0.2
output_step = 1e-2
[rotor]
speed = 100.0
length = 0.4
E = 2e13
rho = 1.0
modes = 2
[[rotor.section]]
from = 0.0
to = 0.4
diameter = 0.1
[[rotor.disc]]
z = 0.2
mass = 4.0
Jt = 0.05
Jp = 0.02
[[rotor.bearing]]
z = 0.0
stiffness = 1e4
damping = 20.0
[[rotor.bearing]]
z = 0.4
stiffness = 1e4
damping = 20.0
)";
constexpr double kStiff = 1e-6;  // what the shaft's own flexibility may change
constexpr double kRigidMass = 4.0 + 1.0 * 0.4 * 0.25 * 0.01 * M_PI, kTwoSprings = 2e4,
                 kTwoDashpots = 40.0;

scene::Scene rigid(const std::vector<std::string>& overrides) {
  return scene::parse_scene(kRigid, "rigid.toml", overrides);
}

std::vector<std::string> crossed(double cross, double damping_cross = 0.0) {
  std::vector<std::string> all;
  for (const char* bearing : {"rotor.bearing[0]", "rotor.bearing[1]"}) {
    const auto pair = [](double value) {
      return "=[" + std::to_string(value) + "," + std::to_string(-value) + "]";
    };
    all.push_back(bearing + (".cross_stiffness" + pair(0.5 * cross)));
    all.push_back(bearing + (".cross_damping" + pair(0.5 * damping_cross)));
  }
  return all;
}

// m s^2 + (c - i c_xy) s + k - i k_xy = 0, of x + i y with k_yx = -k_xy: both roots.
std::pair<Complex, Complex> translation(double cross, double damping_cross) {
  const Complex c(kTwoDashpots, -damping_cross), k(kTwoSprings, -cross);
  const Complex root = std::sqrt(c * c - 4.0 * kRigidMass * k);
  return {(-c + root) / (2.0 * kRigidMass), (-c - root) / (2.0 * kRigidMass)};
}

double nearest(const std::vector<Complex>& all, Complex to) {
  double least = 1e300;
  for (const Complex& s : all) least = std::min(least, std::abs(s - to) / std::abs(to));
  return least;
}

TEST(BearingFilm, CrossCoupledBearingsWhirlAsTheirClosedForm) {
  for (const double cross : {1500.0, 4000.0, -2500.0}) {
    const WhirlSystem system = whirl_system(rigid(crossed(cross, 7.0)));
    EXPECT_TRUE(system.isotropic);
    WhirlSystem both_planes = system;
    both_planes.isotropic = false;
    const auto [one, other] = translation(cross, 7.0);
    for (const Complex exact : {one, other}) {
      EXPECT_LT(nearest(whirl_eigenvalues(system, 100.0), exact), kStiff) << cross;
      // One eigenvalue of each complex pair stands for the whirl; its sign gives the direction.
      EXPECT_LT(nearest(whirl_eigenvalues(both_planes, 100.0), exact), kStiff) << cross;
    }
  }
}

// k_xy = c omega is the border, and beyond it the whirl is forward for k_xy > 0.
TEST(BearingFilm, TheBorderOfStability) {
  const double border = kTwoDashpots * std::sqrt(kTwoSprings / kRigidMass);
  for (const double share : {0.999, 1.001, -0.999, -1.001}) {
    const std::vector<Complex> all =
        whirl_eigenvalues(whirl_system(rigid(crossed(share * border))), 100.0);
    const Complex worst = *std::max_element(
        all.begin(), all.end(), [](Complex a, Complex b) { return a.real() < b.real(); });
    EXPECT_EQ(worst.real() > 0.0, std::abs(share) > 1.0) << share;
    EXPECT_EQ(worst.imag() > 0.0, share > 0.0) << share;
  }
}

// The run grows as the eigenvalue predicts, in its sense: run and spectrum have the same equations
// of motion.
TEST(BearingFilm, ARunWhirlsAsTheEigenvalue) {
  const double cross = 4000.0;
  const auto [forward, backward] = translation(cross, 7.0);
  scene::Scene s = rigid(crossed(cross, 7.0));
  Model m = prepare(s);
  // One mode moves the middle as a whole, the other turns about it.
  const int moves = std::abs(m.first().shape.x.size()) > 0 &&
                            m.stiffness[0] / m.mass[0] < m.stiffness[1] / m.mass[1]
                        ? 0
                        : 1;
  s.initial.x = s.initial.y = s.initial.vx = s.initial.vy = {0.0, 0.0};
  const auto at = static_cast<std::size_t>(moves);
  s.initial.x[at] = 1e-4;
  s.initial.vx[at] = (1e-4 * forward).real();
  s.initial.vy[at] = (1e-4 * forward).imag();
  for (const scene::Integrator integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = test::run_with(s, integrator);
    const std::string n = std::to_string(moves + 1);
    const Complex end(t.column("x_" + n).back(), t.column("y_" + n).back());
    const Complex exact = 1e-4 * std::exp(forward * 0.2);
    EXPECT_LT(std::abs(end - exact) / std::abs(exact), 20 * kStiff);
  }
}

constexpr const char* kTables =
    "={z=0.0,table_speed=[50.0,120.0,200.0],table_kxx=[8e3,1.1e4,1.5e4],table_kyy=[9e3,1e4,1.2e4],"
    "table_kxy=[1e3,2e3,1e3],table_kyx=[-1e3,-1.5e3,-2e3],table_cxx=[30.0,20.0,10.0],table_cxy=[1."
    "0,2.0,3.0]}";

// At a held speed it is the bearing with the coefficients of that speed.
TEST(BearingFilm, ATableAtASpeedIsItsCoefficientsThere) {
  const scene::Scene at_point =
      rigid({std::string("rotor.bearing[0]") + kTables, "rotor.speed=120.0"});
  const scene::Scene plain =
      rigid({"rotor.bearing[0].stiffness=[1.1e4,1e4]", "rotor.bearing[0].damping=20.0",
             "rotor.speed=120.0", "rotor.bearing[0].cross_stiffness=[2e3,-1.5e3]",
             "rotor.bearing[0].cross_damping=[2.0,0.0]"});
  EXPECT_EQ(whirl_eigenvalues(whirl_system(at_point), 120.0),
            whirl_eigenvalues(whirl_system(plain), 120.0));
  scene::Scene thrown[] = {at_point, plain};
  std::vector<Trajectory> runs;
  for (scene::Scene& s : thrown) {
    s.initial.x = {1e-4, 2e-5};
    s.initial.vy = {0.0, 0.01};
    runs.push_back(run_native(s));
  }
  for (const char* name : {"x_1", "y_1", "x_2", "y_2"}) {
    EXPECT_NEAR(runs[0].column(name).back(), runs[1].column(name).back(), 1e-13) << name;
  }
  // At another speed than that of the scene: the spectrum at 200 rad/s uses the coefficients of 200
  // rad/s.
  const scene::Scene faster =
      rigid({std::string("rotor.bearing[0]") + kTables, "rotor.speed=200.0"});
  const auto a = whirl_eigenvalues(whirl_system(at_point), 200.0),
             b = whirl_eigenvalues(whirl_system(faster), 200.0);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_LT(std::abs(a[k] - b[k]), kStiff * std::abs(b[k]));
}

// Each critical speed is one of the rotor whose springs are constant with the values of that speed.
TEST(BearingFilm, CriticalSpeedsAreTheirOwnSpringsOnes) {
  const std::string tables =
      "={z=0.0,table_speed=[20.0,60.0,90.0,150.0],table_kxx=[2e3,1e4,1.6e4,4e4]}";
  const std::vector<double> speeds =
      critical_speeds(whirl_system(rigid({"rotor.bearing[0]" + tables})));
  ASSERT_FALSE(speeds.empty());
  for (const double speed : speeds) {
    const scene::Scene there =
        rigid({"rotor.bearing[0]" + tables, "rotor.speed=" + std::to_string(speed)});
    const double k = there.rotor.geometry->bearings[0].stiffness.x();
    scene::Scene plain = rigid({});
    plain.rotor.geometry->bearings[0].stiffness = {k, k};
    double least = 1e300;
    for (const double other : critical_speeds(whirl_system(plain)))
      least = std::min(least, std::abs(other - speed));
    EXPECT_LT(least, 1e-5) << speed;
  }
  // Springs that stiffen as the square of the speed, or faster, leave no crossing, and none is
  // found.
  const std::vector<double> none =
      critical_speeds(whirl_system(rigid({"rotor.bearing[0]={z=0.0,table_speed=[10.0,20.0,40.0,80."
                                          "0,160.0],table_kxx=[1e4,4e4,1.6e5,6.4e5,2.56e6]}",
                                          "rotor.bearing[1]={z=0.4,table_speed=[10.0,20.0,40.0,80."
                                          "0,160.0],table_kxx=[1e4,4e4,1.6e5,6.4e5,2.56e6]}"})));
  for (const double speed : none) EXPECT_GT(speed, 160.0);
}

// Springs that rise with the speed, k = m (2 c Omega - c^2 + e^2) of both bearings together, make c
// - e and c + e critical.
TEST(BearingFilm, TwoCriticalSpeedsCloseTogetherAreFound) {
  constexpr double kMiddle = 122.0;
  for (const double e : {20.0, 2.0}) {
    const auto stiffness = [e](double speed) {
      return std::to_string(0.5 * kRigidMass * (2.0 * kMiddle * speed - kMiddle * kMiddle + e * e));
    };
    const std::string table =
        "table_speed=[70.0,190.0],table_kxx=[" + stiffness(70.0) + "," + stiffness(190.0) + "]}";
    const std::vector<double> found = critical_speeds(whirl_system(
        rigid({"rotor.bearing[0]={z=0.0," + table, "rotor.bearing[1]={z=0.4," + table})));
    for (const double exact : {kMiddle - e, kMiddle + e}) {
      double least = 1e300;
      for (const double speed : found) least = std::min(least, std::abs(speed - exact));
      EXPECT_LT(least, 0.01) << exact;
    }
  }
}

// If both bearings are off by the same offset, the rotor rests there; if one is, the middle of the
// rotor by half of it, in addition to the sag.
TEST(BearingFilm, BearingsOffTheLineCarryTheRotorThere) {
  for (const bool film : {false, true}) {
    std::vector<std::string> overrides{
        "rotor.bearing[0].offset=[\"30 um\",\"-20 um\"]",
        "rotor.bearing[1].offset=[\"30 um\",\"-20 um\"]", "initial.steady=true",
        "contact={station=0.2,radius=0.05,clearance=1e-3,friction=0.1,restitution=0.5}"};
    if (film) {
      const std::vector<std::string> cross = crossed(1500.0);
      overrides.insert(overrides.end(), cross.begin(), cross.end());
    }
    const Model both = prepare(rigid(overrides));
    const Eigen::Vector2d place = rotor_point(both, both.q0.data());
    EXPECT_LT((place - Eigen::Vector2d(30e-6, -20e-6)).norm(), kStiff * 36e-6);
    overrides[1] = "rotor.bearing[1].offset=[0.0,0.0]";
    const Model one = prepare(rigid(overrides));
    const Eigen::Vector2d middle = rotor_point(one, one.q0.data());
    if (film) continue;  // the film turns the force of one bearing against that of the other
    EXPECT_LT((middle - Eigen::Vector2d(15e-6, -10e-6)).norm(), kStiff * 36e-6);
  }
  // At rest there and without loads, the run stays.
  scene::Scene s = rigid({"rotor.bearing[0].offset=[3e-5,0.0]", "initial.steady=true",
                          "gravity={acceleration=[0.0,-9.81]}"});
  const Trajectory t = run_native(s);
  const auto& x = t.column("x_1");
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  EXPECT_LT(*high - *low, 1e-15);
}

std::string refusal(const std::vector<std::string>& overrides) {
  return test::message_of<scene::SceneError>([&] { rigid(overrides); });
}

TEST(BearingFilm, SlipsAreRefusedByName) {
  const auto expect = [](const std::string& bearing, const std::string& key,
                         const std::string& why) {
    EXPECT_TRUE(test::contains(refusal({"rotor.bearing[0]=" + bearing}), {key, why}));
  };
  expect("{z=0.0}", "rotor.bearing[0].stiffness", "missing: expected a stiffness in N/m");
  expect("{z=0.0,table_speed=[1.0,2.0]}", "rotor.bearing[0].table_kxx", "missing");
  expect("{z=0.0,stiffness=1e4,table_kxy=[1.0,2.0]}", "rotor.bearing[0].table_kxy",
         "needs `table_speed`");
  expect("{z=0.0,stiffness=1e4,table_speed=[1.0,2.0],table_kxx=[1.0,2.0]}",
         "rotor.bearing[0].stiffness", "remove one of them");
  expect("{z=0.0,table_speed=[2.0,1.0],table_kxx=[1.0,2.0]}", "rotor.bearing[0].table_speed",
         "ascending");
  expect("{z=0.0,table_speed=[1.0],table_kxx=[1.0]}", "rotor.bearing[0].table_speed",
         "two speeds or more");
  expect("{z=0.0,table_speed=[1.0,2.0],table_kxx=[1.0,2.0,3.0]}", "rotor.bearing[0].table_kxx",
         "expected 2 value(s)");
  EXPECT_TRUE(test::contains(
      refusal({"rotor.bearing[0].cross_stiffness=[1.0,0.0]", "mujoco.rotor=\"segments\""}),
      "cross_stiffness"));
}

}  // namespace
}  // namespace rotorub
