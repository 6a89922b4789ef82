// The map of periodic rubs of a pump on oil films under its weight, over friction and speed: runs
// from random starts end on its stable branches.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "compare/modes/rub_branches.h"
#include "native_model/model/dynamics.h"
#include "native_model/prepare/prepare.h"

namespace rotorub {
namespace {

scene::Variants pump(int modes) {
  const std::vector<std::string> overrides{fmt::format("rotor.modes={}", modes)};
  return scene::Variants(std::string(ROTORUB_MJCF_DIR) + "/examples/pump_films.toml", overrides);
}

double drawn(std::mt19937& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}

// Half of the starts lie anywhere within the clearance, the others on it, pressed outward; the
// velocities reach three times the speed of a synchronous whirl at the clearance.
State random_start(const Model& m, bool pressed, std::mt19937& random) {
  State state = initial_state(m);
  const AuxiliaryBearing& at = m.first();
  const double clearance = at.contact->clearance, fastest = 3.0 * m.speed * clearance;
  const Layout& l = m.layout;
  for (int i = 0; i < 2; ++i) {
    state.q[at.ring + i] = drawn(random, -0.3, 0.3) * clearance;
    state.v[at.ring + i] = drawn(random, -0.1, 0.1) * fastest;
  }
  for (int i = 1; i < l.modes; ++i) {
    state.q[l.x() + i] = drawn(random, -0.05, 0.05) * clearance;
    state.q[l.y() + i] = drawn(random, -0.05, 0.05) * clearance;
  }
  const double angle = drawn(random, 0.0, 2.0 * std::numbers::pi);
  const double reach = clearance * (pressed ? 1.0 : 0.999 * std::sqrt(drawn(random, 0.0, 1.0)));
  const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
  state.q[l.x()] = state.q[l.y()] = 0.0;
  const Eigen::Vector2d away = reach * direction - separation(m, state.q.data());
  state.q[l.x()] = away.x() / at.shape.x[0];
  state.q[l.y()] = away.y() / at.shape.y[0];
  Eigen::Vector2d speed(drawn(random, -1.0, 1.0), drawn(random, -1.0, 1.0));
  if (pressed && speed.dot(direction) < 0.0) speed = -speed;
  state.v[l.x()] = fastest * speed.x();
  state.v[l.y()] = fastest * speed.y();
  return state;
}

// rolling: backward, which has no period beside the unbalance.
struct Endings {
  int listed = 0, rolling = 0, all = 0;
  std::map<std::string, int> others;
};

bool rolls_backward(const Model& m, const std::optional<State>& state) {
  constexpr double kNoSlip = 1e-6;  // of the speed of the rotor's surface
  if (!state) return false;
  const ContactPoint p = contact_point(m, state->q.data(), state->v.data(), 0);
  const double surface = m.first().contact->radius * m.speed;
  return std::abs(p.slip) < kNoSlip * std::abs(surface) && p.whirl_speed() * m.speed < 0.0;
}

// Runs from random starts at random frictions and at each speed of the map.
Endings endings(const scene::Variants& scenes, const RubBranches& map, int starts) {
  constexpr double kDuration = 0.5;  // s, of the run until its first check
  Endings found;
  std::mt19937 random(1);
  for (int k = 0; k < starts; ++k) {
    const double up = map.up->values[static_cast<std::size_t>(k) % map.up->values.size()];
    const double friction = drawn(random, map.across.values.front(), map.across.values.back());
    const std::vector<std::string> changes{fmt::format("{}={}", map.across.key, friction),
                                           fmt::format("{}={}", map.up->key, up)};
    const Model model = prepare(scenes.scene(changes, false));
    periodic::SettlingParameters parameters;
    parameters.duration = kDuration;
    parameters.most_checks = 4;
    parameters.most_stretches = 400'000;
    const periodic::SettledMotion settled =
        periodic::settled_motion(model, random_start(model, k % 2 == 1, random), parameters);
    ++found.all;
    if (!settled.found() && rolls_backward(model, settled.last)) {
      ++found.rolling;
      continue;
    }
    if (!settled.found()) {
      ++found.others[fmt::format("{:.1f} Hz, friction {:.4f}: {}", up / (2.0 * std::numbers::pi),
                                 friction, settled.refusal)];
      continue;
    }
    const PeriodicRub rub = periodic_rub(model, settled);
    const bool is_listed = std::ranges::any_of(map.branches, [&](const RubBranch& branch) {
      return branch.up == up && lies_on(branch, friction, rub);
    });
    if (is_listed) {
      ++found.listed;
    } else {
      ++found.others[fmt::format("{:.1f} Hz, friction {:.4f}: {}, {} periods, {:.6g} N",
                                 up / (2.0 * std::numbers::pi), friction, rub.kind,
                                 rub.settled.order, rub.figures[0].mean_force)];
    }
  }
  return found;
}

MapAxis axis(const char* key, const char* unit, double from, double to, int count) {
  MapAxis made{key, unit, {}};
  for (int k = 0; k < count; ++k) made.values.push_back(from + (to - from) * k / (count - 1));
  return made;
}

constexpr double kHertz = 2.0 * std::numbers::pi;

TEST(PumpMap, RandomStartsEndOnIt) {
  const scene::Variants scenes = pump(1);
  const RubBranches map = rub_branches(scenes, axis(kFrictionKey, "", 0.1, 0.2, 2),
                                       axis(kSpeedKey, "rad/s", 58.0 * kHertz, 60.0 * kHertz, 2));
  EXPECT_GE(map.branches.size(), 2u);
  const Endings found = endings(scenes, map, 4);
  EXPECT_EQ(found.listed, found.all);
  for (const auto& [why, count] : found.others) ADD_FAILURE() << count << ": " << why;
}

// 186 starts end on a branch (at 45 Hz that of the free orbit, which does not touch), and 14 roll.
TEST(PumpMap, TwoHundredRandomStartsEndOnItNightly) {
  const scene::Variants scenes = pump(3);
  const RubBranches map = rub_branches(scenes, axis(kFrictionKey, "", 0.05, 0.3, 4),
                                       axis(kSpeedKey, "rad/s", 45.0 * kHertz, 75.0 * kHertz, 4));
  const Endings found = endings(scenes, map, 200);
  EXPECT_GE(found.listed + found.rolling, 198);
  EXPECT_GE(found.listed, 180);
  EXPECT_LE(found.rolling, 20);
  printf("%d on a branch, %d rolling\n", found.listed, found.rolling);
  for (const auto& [why, count] : found.others) printf("not listed: %d, %s\n", count, why.c_str());
}

}  // namespace
}  // namespace rotorub
