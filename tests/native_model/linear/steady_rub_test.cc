// Lasting rubs of any number of modes: one mode against the closed forms, several put into the
// model's own right-hand side, which shares no code with them.
#include "native_model/linear/steady_rub.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "native_model/linear/rub_map.h"
#include "native_model/linear/rub_system.h"
#include "native_model/model/dynamics.h"
#include "native_model/oracles/annular_rub.h"
#include "native_model/rotor/refusal.h"
#include "tests/native_model/hard/rules.h"
#include "tests/native_model/linear/rubs.h"
#include "tests/support/said.h"
#include "tests/support/whip.h"

namespace rotorub::rub {
namespace {

constexpr double kSpeed = 100.0 * std::numbers::pi;

// ---------------------------------------------------------------- one mode
TEST(SteadyRub, ForcedIsTheClosedForm) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int rigid = 0, elastic = 0, none = 0;
  for (int k = 0; k < 400; ++k) {
    const double mass = 1.0 + unit(random), damping = 100.0 * unit(random);
    const double stiffness = 1e5 + 2e5 * unit(random), load = 400.0 * unit(random);
    const double mu = unit(random), frequency = 600.0 * unit(random);
    scene::Scene s = test::make_scene({mass, damping, stiffness, 0.5e-3, 0.05, mu, 0.0, kSpeed});
    test::add_rotating_force(s, load, frequency, 6.0 * unit(random));
    const oracle::Support rotor{mass, damping, stiffness};
    const bool has_ring = k % 2 == 0;
    const oracle::Support ring{0.5 + unit(random), 10.0 + 400.0 * unit(random), 3e5 * unit(random)};
    if (has_ring) test::add_ring(s, ring.mass, ring.damping, ring.stiffness);
    const auto exact = has_ring ? oracle::annular_rub(rotor, ring, 0.5e-3, mu, load, frequency)
                                : oracle::annular_rub(rotor, 0.5e-3, mu, load, frequency);
    const RubSystem system = rub_system(s);
    const std::vector<SteadyRub> rubs = forced_rubs(system, rotating_loads(system).front());
    ASSERT_EQ(!rubs.empty(), exact.has_value()) << k;
    if (!exact) {
      ++none;
      continue;
    }
    ++(has_ring ? elastic : rigid);
    const SteadyRub& rub = rubs.front();
    EXPECT_NEAR(rub.normal_force, exact->force, 1e-9 * (exact->force + load)) << k;
    // The closed form's load points along x at t = 0, the scene's along its phase.
    const Complex turned = std::polar(1.0, rub.direction - s.forces[0].phase);
    const double size = std::abs(exact->rotor);
    EXPECT_LT(std::abs(turned * rub.rotor[0] - exact->rotor), 1e-8 * size) << k;
    EXPECT_LT(std::abs(turned * rub.ring - exact->stator), 1e-8 * size) << k;
  }
  EXPECT_GT(rigid, 50);
  EXPECT_GT(elastic, 50);
  EXPECT_GT(none, 50);
}

TEST(SteadyRub, ShippedRubsAreFound) {
  for (const auto& [name, force] :
       {std::pair{"bench_annular_elastic", 121.7020404}, std::pair{"bench_ring", 121.7020407}}) {
    const RubSystem system = rub_system(test::shipped(name));
    const auto rubs = forced_rubs(system, rotating_loads(system).front());
    ASSERT_EQ(rubs.size(), 1U) << name;
    EXPECT_NEAR(rubs[0].normal_force, force, 1e-6) << name;
  }
}

TEST(SteadyRub, WhipsOfBlack) {
  const scene::Scene scene = test::shipped("bench_whip");
  const BackwardCompliance backward(rub_system(scene));
  const std::vector<SteadyRub> whips = backward.whips(0.2);
  ASSERT_EQ(whips.size(), 3U);
  EXPECT_NEAR(whips[0].whirl, -380.947, 5e-4);
  EXPECT_NEAR(whips[1].whirl, -501.9257, 5e-5);
  EXPECT_NEAR(whips[1].normal_force, 244.8444, 5e-5);
  EXPECT_NEAR(whips[2].whirl, -1465.431, 5e-4);
  EXPECT_NEAR(whips[1].friction, 0.2, 1e-12);
  const auto ranges = backward.rolling_ranges(0.2);
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_NEAR(ranges[0].first, 380.947, 5e-4);
  EXPECT_NEAR(ranges[0].second, 501.926, 5e-4);
  EXPECT_NEAR(ranges[1].first, 1465.431, 5e-4);
  EXPECT_TRUE(std::isinf(ranges[1].second));
  const auto rolling = backward.rolling(0.2);
  ASSERT_TRUE(rolling);
  EXPECT_NEAR(rolling->whirl, -31415.9265, 1e-4);
  EXPECT_LT(std::abs(rolling->friction), 0.2);
  EXPECT_EQ(rolling->slip, 0.0);

  scene::Scene soft = scene;
  soft.first().stator->stiffness.setConstant(1e5);
  const std::vector<double> edges = BackwardCompliance(rub_system(soft)).edges(0.15);
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_NEAR(edges[0], 1019.199, 5e-4);
}

// No zero is missed, however sharp the resonances: the closed form's polynomial has all of them.
TEST(SteadyRub, EdgesAreThoseOfTheClosedForm) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::size_t several = 0;
  for (int k = 0; k < 100; ++k) {
    const double light = std::pow(10.0, -4.0 * unit(random));
    scene::Scene s = test::make_scene({1.0 + unit(random), 100.0 * light, 1e5 + 1e6 * unit(random),
                                       0.5e-3, 0.05, 0.1, 0.0, kSpeed});
    test::add_ring(s, 0.5 + unit(random), 300.0 * light * unit(random), 1e5 + 3e6 * unit(random));
    const double mu = 0.02 + 0.5 * unit(random);
    const auto exact = test::whip_of(s).slipping_whips(mu);
    const auto found = BackwardCompliance(rub_system(s)).edges(mu);
    ASSERT_EQ(found.size(), exact.size()) << k;
    several += exact.size() > 1 ? 1 : 0;
    for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_NEAR(found[i], exact[i], 1e-8 * exact[i]);
  }
  EXPECT_GT(several, 20U);
}

// ---------------------------------------------------------------- the fold, where a pair of whips
// is born Least friction of bench_whip's backward contact, and where: the digits are those of the
// polynomial's double root.
constexpr double kFold = 0.15510962126429, kFoldWhirl = 437.194917;

TEST(SteadyRub, APairOfWhipsCloseTogetherIsFound) {
  for (const double turn : {1.0, -1.0}) {
    scene::Scene scene = test::shipped("bench_whip");
    scene.rotor.speed *= turn;
    const BackwardCompliance backward(rub_system(scene));
    const std::vector<SteadyRub> whips = backward.whips(0.1552);
    ASSERT_EQ(whips.size(), 3U) << turn;
    EXPECT_NEAR(turn * whips[0].whirl, -434.245, 5e-4);
    EXPECT_NEAR(turn * whips[1].whirl, -440.16338, 5e-6);
    EXPECT_NEAR(whips[1].normal_force, 120.2154, 5e-5);
    EXPECT_EQ(backward.rolling_ranges(0.1552).size(), 2U);
  }
}

// Slightly above the fold there are two, below none, at the fold one.
TEST(SteadyRub, TheFoldIsWhereThePairIsBorn) {
  const BackwardCompliance backward(rub_system(test::shipped("bench_whip")));
  for (const double hair : {1e-3, 1e-6, 1e-9, 1e-11}) {
    const auto above = backward.whips(kFold * (1.0 + hair));
    ASSERT_EQ(above.size(), 3U) << hair;
    EXPECT_LT(-above[0].whirl, kFoldWhirl);
    EXPECT_GT(-above[1].whirl, kFoldWhirl);
    EXPECT_NEAR(-0.5 * (above[0].whirl + above[1].whirl), kFoldWhirl, 1e-5 + 20.0 * hair)
        << "their mean moves with the excess";
    EXPECT_EQ(backward.whips(kFold * (1.0 - hair)).size(), 1U) << hair;
    EXPECT_EQ(backward.rolling_ranges(kFold * (1.0 - hair)).size(), 1U) << hair;
  }
  const auto fold = backward.whips(kFold);
  ASSERT_EQ(fold.size(), 2U);
  EXPECT_NEAR(-fold[0].whirl, kFoldWhirl, 1e-5)
      << "where a minimum is flat: to the root of round-off";
}

// Folds of any rotor on any ring, with light damping or not, found as the least friction of the
// closed form.
TEST(SteadyRub, NoFoldIsMissed) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int folds = 0;
  for (int k = 0; k < 200; ++k) {
    const double light = std::pow(10.0, -3.0 * unit(random));
    scene::Scene s = test::make_scene({1.0 + unit(random), 100.0 * light, 1e5 + 1e6 * unit(random),
                                       0.5e-3, 0.05, 0.1, 0.0, kSpeed});
    test::add_ring(s, 0.5 + unit(random), 300.0 * light * unit(random), 1e5 + 3e6 * unit(random));
    const oracle::ElasticWhip whip = test::whip_of(s);
    const BackwardCompliance backward(rub_system(s));
    const auto asked = [&](double nu) { return whip.friction_asked(nu); };
    for (double nu = 100.0; nu < 5000.0; nu *= 1.0005) {
      double low = nu / 1.0005, high = nu * 1.0005;
      if (!(asked(nu) < asked(low) && asked(nu) < asked(high))) continue;
      for (int cut = 0; cut < 60; ++cut) {  // thirds
        const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
        (asked(a) < asked(b) ? high : low) = asked(a) < asked(b) ? b : a;
      }
      const double fold = asked(0.5 * (low + high));
      ++folds;
      for (const double hair : {1e-4, 1e-8}) {
        const auto above = backward.edges(fold * (1.0 + hair)),
                   below = backward.edges(fold * (1.0 - hair));
        EXPECT_EQ(above.size(), below.size() + 2) << k << ' ' << nu << ' ' << hair;
        EXPECT_EQ(above.size(), whip.slipping_whips(fold * (1.0 + 1e-4)).size()) << k << ' ' << nu;
      }
    }
  }
  EXPECT_GT(folds, 50);
}

// ---------------------------------------------------------------- several modes
// M q'' = f + J^T (contact) with q'' = -nu^2 q, at t = 0; and the gap is closed.
void expect_motion(const scene::Scene& scene, const SteadyRub& rub) {
  const Model model = prepare(test::started_on(scene, rub));
  const Eigen::VectorXd &q = model.q0, &v = model.v0;
  const ContactPoint p = contact_point(model, q.data(), v.data());
  EXPECT_NEAR(p.gap, 0.0, 1e-10 * q.norm());
  EXPECT_NEAR(p.gap_rate, 0.0, 1e-10 * v.norm());
  EXPECT_NEAR(p.whirl_speed(), rub.whirl * scene.first().contact->clearance, 1e-10 * v.norm());
  EXPECT_GT(rub.normal_force, 0.0);
  Eigen::VectorXd f(model.nq());
  unactuated_force(model, 0.0, q.data(), v.data(), f.data());
  add_contact_load(model,
                   contact_load(p.e_r, scene.first().contact->radius, rub.normal_force,
                                -rub.friction * rub.normal_force),
                   f.data());
  const Eigen::VectorXd inertia = -rub.whirl * rub.whirl * model.mass.cwiseProduct(q);
  EXPECT_LT((inertia - f).norm(), 1e-9 * inertia.norm());
}

TEST(SteadyRub, OfThreeModesMovesAsTheModelSays) {
  for (const bool elastic : {true, false}) {
    for (const double turn : {1.0, -1.0}) {
      SCOPED_TRACE(elastic ? "elastic ring" : "rigid ring");
      SCOPED_TRACE(turn);
      scene::Scene scene = test::three_modes(elastic);
      scene.rotor.speed *= turn;
      scene.forces[0].frequency *= turn;
      const RubSystem system = rub_system(scene);
      const auto loads = rotating_loads(system);
      ASSERT_EQ(loads.size(), 1U);
      const auto forced = forced_rubs(system, loads.front());
      ASSERT_FALSE(forced.empty());
      for (const SteadyRub& rub : forced) expect_motion(scene, rub);
      scene::Scene quiet = scene;
      quiet.forces.clear();
      const BackwardCompliance backward(system);
      const auto whips = backward.whips(scene.first().contact->friction.coefficient);
      ASSERT_FALSE(whips.empty());
      for (const SteadyRub& whip : whips) {
        EXPECT_LT(whip.whirl * turn, 0.0) << "against the spin";
        expect_motion(quiet, whip);
      }
      const auto rolling = backward.rolling(scene.first().contact->friction.coefficient);
      ASSERT_TRUE(rolling);
      expect_motion(quiet, *rolling);
    }
  }
}

TEST(SteadyRub, TheShaftOfTheRigRubsWithForceAndUnbalanceTogether) {
  const scene::Scene rig = test::shipped("paper_passive");
  const RubSystem system = rub_system(rig);
  const auto loads = rotating_loads(system);
  ASSERT_EQ(loads.size(), 1U) << "the unbalance keeps step with the force";
  scene::Scene held = rig;
  held.drive.reset();
  held.rotor.torsion.reset();
  held.forces[0].on = -1.0;
  held.initial.steady = false;
  for (const SteadyRub& rub : forced_rubs(system, loads.front())) expect_motion(held, rub);
  const RubSystem faster = at_speed(system, 2.0 * system.speed);
  const auto quicker = rotating_loads(faster);
  ASSERT_EQ(quicker.size(), 1U);
  EXPECT_EQ(quicker[0].frequency, 2.0 * system.speed);
}

// ---------------------------------------------------------------- what exists, what is refused
TEST(RubPoint, FreeOrbitWithinTheClearance) {
  scene::Scene s =
      test::make_scene({.mass = 2.0, .damping = 40.0, .stiffness = 2e5, .speed = kSpeed});
  test::add_rotating_force(s, 1.0, kSpeed);
  const RubPoint point = RubStudy(rub_system(s)).at(0.1);
  const double exact = 1.0 / std::abs(Complex(2e5 - 2.0 * kSpeed * kSpeed, 40.0 * kSpeed));
  ASSERT_TRUE(point.orbit);
  EXPECT_NEAR(*point.orbit, exact, 1e-12 * exact);
  EXPECT_TRUE(point.attractors() & kFreeOrbit);
  EXPECT_FALSE(point.leading(RubKind::kForced)) << "1 N does not reach the ring";
  test::add_rotating_force(s, 1.0, 2.0 * kSpeed);
  EXPECT_FALSE(RubStudy(rub_system(s)).at(0.1).orbit) << "two frequencies draw no circle";
}

TEST(RubSystem, RefusesWhatDoesNotTurn) {
  const auto reason = [](const scene::Scene& s) {
    return test::message_of<scene::SceneError>([&] { rub_system(s); });
  };
  const scene::Scene good = test::three_modes(true);
  EXPECT_EQ(reason(good), "");
  EXPECT_TRUE(test::contains(reason(test::shipped("paper_sliding")), "controller.kind"));
  const std::pair<const char*, void (*)(scene::Scene&)> changes[] = {
      {"stator.stiffness", [](scene::Scene& s) { s.first().stator->stiffness.y() *= 1.1; }},
      {"rotor.modal",
       [](scene::Scene& s) {
         s.rotor.modal->stiffness_y = {2.1e5, 3e6, 1.1e7};
       }},
      {"force[1].kind",
       [](scene::Scene& s) {
         test::add_constant_force(s, {0.0, -20.0});
       }},
      {"gravity",
       [](scene::Scene& s) {
         s.gravity = scene::Gravity{{0.0, -9.81}, {}};
       }},
      {"stator",
       [](scene::Scene& s) {
         s.first().stator->spin = {1e-4, 0.0, 0.0};
         s.first().stator->spin->dry_drag = 0.1;
       }},
      {"contact.friction",
       [](scene::Scene& s) {
         s.first().stator->spin = {1e-4, 0.0, 0.0};
         s.first().contact->friction = test::falling();
       }},
      {"contact", [](scene::Scene& s) { s.first().contact.reset(); }}};
  for (const auto& [key, change] : changes) {
    scene::Scene s = good;
    change(s);
    EXPECT_TRUE(test::contains(reason(s), key));
  }
}

}  // namespace
}  // namespace rotorub::rub
