// Three parts of a machine at a time, by the fixed-step schemes against `event` (pairs_test.cc has
// any two).
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/native_model/hard/orders.h"

namespace rotorub::test {
namespace {

// Mass and gyroscopics are both off the diagonal here: the velocity must be turned with the coupled
// mass. The reference shaft, one disc of 20 mm eccentricity at a quarter, the spin free.
constexpr const char* kUnbalancedGyroscope = R"(
[run]
end = 0.010
step = 1e-5
output_step = 1e-3
[rotor]
speed = 314.0
length = 0.60
E = 2.1e11
nu = 0.3
rho = 7850.0
modes = 2
damping_ratio = 0.01
[[rotor.section]]
from = 0.0
to = 0.60
diameter = 0.018
[[rotor.disc]]
z = 0.15
mass = 2.0
Jt = 1.8e-3
Jp = 3.6e-3
eccentricity = 20e-3
[[rotor.bearing]]
z = 0.03
stiffness = 2e7
[[rotor.bearing]]
z = 0.57
stiffness = 2e7
[drive]
kind = "free"
inertia = 2e-3
)";

void expect_second_order(const scene::Scene& scene) {
  const Trajectory exact = run_event(scene);
  ASSERT_EQ(exact.status, Status::kOk) << exact.message;
  Table verlet;
  verlet.judge("verlet", converge(scene, Integrator::kVerlet, exact), kVerletOrder);
  EXPECT_FALSE(verlet.short_of_order) << verlet.text;
}

TEST(LongTriple, GyroscopicsUnbalanceAndFreeSpin) {
  expect_second_order(scene::parse_scene(kUnbalancedGyroscope, "triple.toml"));
}

TEST(LongTriple, GyroscopicsUnbalanceAndFreeSpinInTheRing) {
  scene::Scene scene = scene::parse_scene(kUnbalancedGyroscope, "triple.toml");
  scene.first().contact = scene::Contact{};
  scene.first().contact->station = 0.24;
  scene.first().contact->radius = 0.02;
  scene.first().contact->clearance = 2e-3;
  scene.first().contact->friction = 0.2;
  scene.first().contact->restitution = 0.4;
  scene.first().stator = scene::Stator{{1.5, 1.5}, {300.0, 300.0}, {2e5, 2e5}};
  expect_second_order(scene);
}

// Where spin and bending share a mass matrix that turns, with every other part; slow enough for an
// eccentricity that couples them tightly.
std::vector<Pair> coupled(const std::string& drive) {
  Part unbalance, driven;
  std::vector<Pair> out;
  for (const Part& part : pair_parts()) {
    if (part.name == "unbalance") unbalance = part;
    if (part.name == drive) driven = part;
  }
  unbalance.name = "coupled";
  unbalance.geometry = {"rotor.disc[0].eccentricity=4e-3", "rotor.disc[0].phase=0.7",
                        "rotor.speed=150.0"};
  for (const Part& part : pair_parts()) {
    if (part.group == "drive" || part.name == "unbalance" || part.geometry.empty()) continue;
    out.push_back({Form::kGeometry, {unbalance, driven, part}});
  }
  return out;
}

TEST(LongTriple, UnbalanceOnAFreeSpinByVerlet) {
  expect_order(coupled("free_spin"), Integrator::kVerlet, kVerletOrder);
}
TEST(LongTriple, UnbalanceOnAMotorByVerlet) {
  expect_order(coupled("kloss_drive"), Integrator::kVerlet, kVerletOrder);
}

}  // namespace
}  // namespace rotorub::test
