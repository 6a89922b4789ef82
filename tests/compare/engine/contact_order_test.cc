// Lengths that an engine takes from the clearances: they must not depend on the order of the
// contacts.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/engine/engine.h"
#include "compare/engine/lyapunov.h"
#include "compare/engine/mujoco_record.h"
#include "compare/figures/figure.h"
#include "compare/metrics/metrics.h"
#include "native_model/prepare/prepare.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

// A rotor of one mode in two rings at one place.
scene::Scene in_two_rings(const Jeffcott& in_the_first, double clearance, double radius) {
  scene::Scene s = make_scene(in_the_first);
  s.auxiliary.push_back(s.first());
  s.auxiliary[1].contact->clearance = clearance;
  s.auxiliary[1].contact->radius = radius;
  return s;
}

scene::Scene in_the_other_order(scene::Scene s) {
  std::swap(s.auxiliary[0], s.auxiliary[1]);
  return s;
}

TEST(ContactOrder, DoesNotMatterForTwins) {
  constexpr double kNarrow = 0.1e-3;  // m
  const scene::Scene scene = in_two_rings({.stiffness = 2e5, .clearance = 0.5e-3}, kNarrow, 0.05);
  const double moved = perturbed(scene, 3).initial.x.front();
  EXPECT_EQ(moved, perturbed(in_the_other_order(scene), 3).initial.x.front());
  EXPECT_EQ(moved, 3.0 * (std::nextafter(kNarrow, 1.0) - kNarrow));
}

// A start off the other one by a tenth of the wide clearance would lie outside the narrow ring.
TEST(ContactOrder, DoesNotMatterForAnExponent) {
  const scene::Scene scene =
      in_two_rings({.mass = 2.0, .damping = 24.0, .stiffness = 2e5, .speed = 200.0}, 0.1, 0.5);
  LyapunovParameters parameters;
  parameters.stretch = 0.03;
  parameters.distance = 0.1;
  parameters.integrator = scene::Integrator::kEvent;
  for (const scene::Scene& s : {scene, in_the_other_order(scene)}) {
    const Lyapunov found = largest_lyapunov(s, parameters);
    ASSERT_TRUE(found.exponent) << found.refused;
    EXPECT_NEAR(*found.exponent, -6.0, 0.3) << "-d / 2 m";
  }
}

// The rotor rubs in the narrow ring all the time, and never touches the wide one.
TEST(ContactOrder, DoesNotMatterForTheFigures) {
  scene::Scene scene = in_two_rings(
      {.damping = 24.0, .stiffness = 2e5, .friction = 0.05, .speed = 200.0}, 0.1e-3, 0.06);
  add_rotating_force(scene, 60.0, 200.0);
  scene.run.end = 0.5;
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    nlohmann::json first;
    for (const scene::Scene& s : {scene, in_the_other_order(scene)}) {
      const Trajectory run = run_with(s, integrator, 1e-5);
      ASSERT_EQ(run.status, Status::kOk) << run.message;
      const Metrics found = metrics(run, contact_facts(s));
      EXPECT_EQ(found.settled.attractor, Attractor::kSynchronousRub);
      const nlohmann::json figures = metrics_json(found).flatten();
      if (first.is_null()) first = figures;
      for (const auto& [path, value] : figures.items()) {
        const nlohmann::json& there = first.at(path);
        if (is_timing(path.substr(1))) continue;
        if (value.is_number_float() && std::isfinite(value.get<double>())) {
          ASSERT_TRUE(there.is_number()) << path;
          EXPECT_NEAR(value.get<double>(), there.get<double>(),
                      1e-9 + 1e-6 * std::abs(value.get<double>()))
              << path;
        } else {
          EXPECT_EQ(value.dump(), there.dump()) << path;
        }
      }
    }
  }
}

// The thin ring loses the rotor at a depth of its radius, 5 mm, and not at that of the other ring.
TEST(ContactOrder, DoesNotMatterForTheDepthOfASoftRing) {
  const scene::Scene scene = in_two_rings({.clearance = 0.5e-3, .radius = 5e-3}, 0.5e-3, 0.05);
  for (const scene::Scene& s : {scene, in_the_other_order(scene)}) {
    const Model model = prepare(s);
    const MujocoRecord record(model, false, 1e-5, {}, 2e-4);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq());
    q[0] = 5.4e-3;
    EXPECT_FALSE(record.lost(q.data()));
    q[0] = 5.6e-3;
    EXPECT_TRUE(record.lost(q.data()));
  }
}

}  // namespace
}  // namespace rotorub::test
