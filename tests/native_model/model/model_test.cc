// The model of a scene: its start, and the refusals that need the modes.
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include "native_model/model/dynamics.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/rotor/rotors.h"
#include "tests/support/jeffcott.h"
#include "tests/support/machine.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;

void expect_refusal(const scene::Scene& scene, const std::string& key, const std::string& says) {
  const scene::Diagnostic d = test::refusal(scene);
  EXPECT_EQ(d.file, scene.name + ".toml");
  EXPECT_EQ(d.line, 0);
  EXPECT_EQ(d.key, key);
  EXPECT_NE(d.reason.find(says), std::string::npos) << d.reason;
  EXPECT_TRUE(d.reason.find("; ") != std::string::npos ||
              d.reason.find("expected") != std::string::npos)
      << "must say what to do: " << d.reason;
}

TEST(Model, InitialStateIsTheScenes) {
  scene::Scene s = test::machine_scene(true);
  s.initial = {.x = {1e-4, -2e-4},
               .y = {3e-5, 0.0},
               .vx = {0.1, 0.2},
               .vy = {0.3, 0.4},
               .spin_angle = 0.7,
               .torsion = {0.01, 0.02},
               .torsion_speed = {1.5, -2.5}};
  s.first().stator->position = {1e-5, -3e-5};
  s.first().stator->velocity = {0.02, 0.03};
  const State state = initial_state(prepare(s));
  Eigen::VectorXd q(9), v(9);
  q << 1e-4, -2e-4, 3e-5, 0.0, 0.7, 0.01, 0.02, 1e-5, -3e-5;
  v << 0.1, 0.2, 0.3, 0.4, 310.0, 1.5, -2.5, 0.02, 0.03;
  EXPECT_EQ(state.t, 0.0);
  EXPECT_EQ(state.q, q);
  EXPECT_EQ(state.v, v);
}

TEST(ModelRefusal, AStartOutsideTheRing) {
  scene::Scene s = test::reference_rig();
  s.initial.x = {3e-4, 0.0, 0.0};
  s.initial.y = {0.0, 3e-4, 0.0};
  EXPECT_NO_THROW(prepare(s));
  s.initial.y = {0.0, 5e-4, 0.0};
  expect_refusal(s, "initial.x", "outside the ring, 0.000583095 m");
  s.initial.x.clear();
  s.initial.y = {-6e-4, 0.0, 0.0};
  expect_refusal(s, "initial.y", "outside the ring");
  s.initial.y.clear();
  test::add_ring(s, 1.0, 0.0, 0.0);
  s.first().stator->position = {0.0, 6e-4};
  expect_refusal(s, "initial.stator", "outside the ring");
  s.first().stator->position = {0.0, 5e-4};
  EXPECT_NO_THROW(prepare(s)) << "on the ring is meant";
}

TEST(ModelRefusal, AModeWithANodeAtTheContactMovesNothingThere) {
  // The rig is symmetric about 0.3 m: the second mode has its node there.
  scene::Scene s = test::reference_rig();
  s.first().contact->station = 0.3;
  s.initial.x = {0.0, 1e-3, 0.0};
  const Model m = prepare(s);
  EXPECT_EQ(m.first().shape.x, Eigen::Vector3d(1.0, 0.0, 1.0));
  EXPECT_EQ(contact_point(m, m.q0.data(), m.v0.data()).gap, 0.5e-3);
  s.initial.x = {1e-3, 0.0, 0.0};
  expect_refusal(s, "initial.x", "outside the ring, 0.001 m");
}

TEST(ModelRefusal, MoreCoordinatesThanAStepHolds) {
  scene::Scene s = make_scene({});
  const auto modes = [&](std::size_t n) {
    s.rotor.modal->mass.assign(n, 1.0);
    s.rotor.modal->stiffness.assign(n, 1e5);
    s.rotor.modal->damping.assign(n, 0.0);
  };
  modes(kMaxCoordinates / 2);
  EXPECT_EQ(prepare(s).nq(), kMaxCoordinates);
  test::add_ring(s, 1.0, 0.0, 0.0);
  expect_refusal(s, "rotor.modal.mass", "514 coordinates");
  s.first().stator.reset();
  modes(kMaxCoordinates / 2 + 1);
  expect_refusal(s, "rotor.modal.mass", "the limit is 512");
  scene::Scene rig = test::reference_rig();
  rig.rotor.geometry->modes = 257;
  expect_refusal(rig, "rotor.modes", "514 coordinates");
}

TEST(ModelRefusal, ListsThatDoNotFitTheModesOfAFrequencyBound) {
  scene::Scene s = test::reference_rig();
  s.rotor.geometry->modes.reset();
  s.rotor.geometry->max_frequency = 3000.0;  // two modes, near 57 and 394 Hz
  s.initial.x = {1e-4, 0.0};
  EXPECT_EQ(prepare(s).layout.modes, 2);
  s.initial.x = {1e-4, 0.0, 0.0};
  expect_refusal(s, "initial.x", "expected 2 value(s), one for each bending mode, got 3");
  s.initial.x.clear();
  s.initial.torsion_speed = {1.0};
  expect_refusal(s, "initial.torsion_speed", "expected 0 value(s)");
}

// Less inertia about the shaft than the eccentric mass takes with it: M(phi) is indefinite, and the
// spin gains energy from nothing.
TEST(ModelRefusal, ASpinWithoutTheInertiaOfItsUnbalance) {
  scene::Scene s = test::reference_rig();
  s.rotor.geometry->discs[0].Jp = 0.0;
  s.rotor.geometry->discs[0].eccentricity = 0.01;
  EXPECT_NO_THROW(prepare(s)) << "the spin is held";
  s.drive = scene::Drive{};
  expect_refusal(s, "rotor.disc", "not positive definite");
  s.drive->inertia = 2e-4;  // m e^2
  EXPECT_NO_THROW(prepare(s));
  s.drive->inertia = 0.0;
  s.rotor.geometry->discs[0].Jp = 2e-4;
  EXPECT_NO_THROW(prepare(s));
}

TEST(ModelRefusal, MatricesThatCannotBeSolved) {
  scene::Scene s = test::reference_rig();
  for (scene::ShaftSection& section : s.rotor.geometry->sections) section.diameter = 1e-200;
  const scene::Diagnostic d = test::refusal(s);
  EXPECT_EQ(d.key, "rotor");
  EXPECT_NE(d.reason.find("orders of magnitude"), std::string::npos) << d.reason;
}

TEST(ModelRefusal, ReachesAUserWhoWroteToml) {
  const std::string text = R"([rotor]
speed = 0.0
length = 0.6
E = 2.1e11
rho = 7850.0
modes = 2
[[rotor.section]]
from = 0.0
to = 0.6
diameter = 0.018
[[rotor.bearing]]
z = 0.0
stiffness = 1e7
[[rotor.bearing]]
z = 0.6
stiffness = 1e7
[contact]
station = 0.2
radius = 0.02
clearance = "0.5 mm"
friction = 0.1
restitution = 0.5
[initial]
x = [0.6e-3, 0.1e-3]
)";
  const scene::Scene s = scene::parse_scene(text, "folder/shaft.toml");
  EXPECT_EQ(to_string(test::refusal(s)),
            "folder/shaft.toml:24: initial.x: the rotor starts outside the ring, 0.0007 m from its "
            "centre; start it at most contact.clearance = 0.0005 m");
}

// The gap is measured from the ring's centre, which may lie off the line of the shaft.
TEST(Model, MayStartInsideAnOffsetRing) {
  const auto scene = [](const std::string& x) {
    return scene::parse_scene(
        "[rotor.modal]\nmass = [2.0]\nstiffness = [1e5]\n[contact]\nradius = 0.02\n"
        "clearance = 5e-4\nfriction = 0.1\nrestitution = 0.5\noffset = [1e-3, 0]\n"
        "[initial]\nx = [" +
            x + "]\n",
        "offset.toml");
  };
  EXPECT_NO_THROW(prepare(scene("1.2e-3")));
  EXPECT_EQ(test::refusal(scene("0.4e-3")).key, "initial.x");
}

}  // namespace
}  // namespace rotorub
