#include "compare/sweep/motion_branches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "native_model/scene/diagnostic.h"

namespace rotorub::sweep {
namespace {

// Some of the study's values, ascending, the first and the last among them.
std::vector<double> starts_of(const Sample& sample) {
  std::vector<double> all;
  for (std::int64_t k = 0; k < sample.size(); ++k) {
    if (const auto number = sample.at(k).front().number) all.push_back(*number);
  }
  std::ranges::sort(all);
  const auto [first, last] = std::ranges::unique(all);
  all.erase(first, last);
  if (all.size() <= kMostStarts) return all;
  std::vector<double> some;
  for (std::size_t k = 0; k < kMostStarts; ++k)
    some.push_back(all[k * (all.size() - 1) / (kMostStarts - 1)]);
  return some;
}

bool has_places(const RubBranch& branch) {
  return std::ranges::any_of(branch.points,
                             [](const RubOnBranch& at) { return !places_of(at.rub).empty(); });
}

std::string refusal_of(const RubBranches& found) {
  if (std::ranges::any_of(found.branches, has_places)) return "";
  if (!found.branches.empty()) return "no motion repeats after a whole number of turns";
  return found.without.empty() ? "no run settles to a periodic motion" : found.without.front().why;
}

}  // namespace

MotionBranches motion_branches(const PointScenes& scenes, const std::atomic<bool>* interrupt,
                               const std::function<void(double)>& progress) {
  const Vary& vary = scenes.study().vary.front();
  const std::vector<double> starts = starts_of(scenes.sample());
  MotionBranches all;
  if (vary.whole) {
    all.refused = "the key has whole numbers alone";
  } else if (starts.size() < 2) {
    all.refused = "the key has a single value";
  }
  if (!all.refused.empty()) return all;
  BranchOptions options;
  options.interrupt = interrupt;
  options.progress = progress;
  const SceneAt scene_at = [&](double value, double) { return scenes.with_value(value); };
  try {
    all.found = rub_branches(scene_at, {vary.key, vary.unit, starts}, {}, options);
    all.refused = refusal_of(all.found);
  } catch (const scene::SceneError& error) {
    all.refused = reason_of(error);
  }
  return all;
}

std::vector<std::complex<double>> places_of(const PeriodicRub& rub) {
  constexpr double kWhole = 1e-6;  // of a turn
  const periodic::PeriodicMotion& motion = rub.settled.motion;
  const double turns =
      std::abs(motion.turns != 0 ? static_cast<double>(motion.turns)
                                 : motion.period * rub.spin / (2.0 * std::numbers::pi));
  const bool is_whole = std::abs(turns - static_cast<double>(rub.passes.size())) <= kWhole;
  if (motion.frame != 0.0 || !is_whole) return {};
  std::vector<std::complex<double>> places;
  for (const KeyphasorPass& pass : rub.passes) places.emplace_back(pass.x, pass.y);
  return places;
}

}  // namespace rotorub::sweep
