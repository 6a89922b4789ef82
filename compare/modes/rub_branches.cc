#include "compare/modes/rub_branches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "compare/base/in_parallel.h"
#include "native_model/periodic/forcing.h"
#include "native_model/periodic/guesses.h"
#include "native_model/periodic/period_doubling.h"
#include "native_model/prepare/prepare.h"
#include "native_model/prepare/repeating_model.h"
#include "native_model/rotor/refusal.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub {
namespace {

using periodic::Branch, periodic::ContinuationParameters, periodic::PeriodicMotion;
using periodic::PointKind;

constexpr double kOfRange = 0.5;  // unit of the key in the arclength, relative to its range
constexpr int kLeastPoints = 10;  // of a branch in one direction

// The models of a study of one or two keys.
class Machines {
 public:
  explicit Machines(const SceneAt& scene_at) : scene_at_(&scene_at) {}

  scene::Scene scene(double value, double up) const { return (*scene_at_)(value, up); }
  // Without the start, which need not fit: a branch has its own.
  scene::Scene unstarted(double value, double up) const {
    scene::Scene own = scene(value, up);
    const double angle = own.initial.spin_angle;
    own.initial = {};
    own.initial.spin_angle = angle;
    for (scene::AuxiliaryBearing& at : own.auxiliary) {
      if (!at.stator) continue;
      at.stator->position.setZero();
      at.stator->velocity.setZero();
    }
    return own;
  }
  Model model(double value, double up) const {
    const scene::Scene own = unstarted(value, up);
    return repeating_model(own, prepare(own), prepare);
  }

 private:
  const SceneAt* scene_at_;
};

// The result of action(); empty if it refuses the scene.
template <class Action>
auto without_refusal(Action action) -> std::optional<decltype(action())> {
  try {
    return action();
  } catch (const scene::SceneError&) {
    return {};
  }
}

// The rubs to which runs settle at one value; `error` is set if the scene is refused there.
struct Found {
  PeriodicRubs rubs;
  std::optional<scene::SceneError> error;
};

Found found_at(const Machines& machines, double value, double up, const ShootingOptions& options) {
  try {
    try {
      return {lasting_rubs_by_shooting(machines.scene(value, up), options), {}};
    } catch (const scene::SceneError&) {  // its start may be refused
      return {lasting_rubs_by_shooting(machines.unstarted(value, up), options), {}};
    }
  } catch (const scene::SceneError& error) {
    return {{}, error};
  }
}

// The branches of one value of the second key.
class Diagram {
 public:
  Diagram(const Machines& machines, const MapAxis& across, double up, const BranchOptions& options)
      : machines_(&machines),
        key_(across.key),
        low_(across.values.front()),
        high_(across.values.back()),
        up_(up),
        options_(&options) {}

  void add(double value, const PeriodicRub& rub, const std::vector<std::string>& starts) {
    if (options_->interrupt && *options_->interrupt) return;
    const auto same = std::ranges::find_if(
        branches_, [&](const RubBranch& branch) { return lies_on(branch, value, rub); });
    if (same != branches_.end()) {
      for (const std::string& start : starts) {
        if (std::ranges::find(same->starts, start) == same->starts.end())
          same->starts.push_back(start);
      }
      return;
    }
    const Branch down = continued(value, rub, -1.0), up = continued(value, rub, 1.0);
    RubBranch branch{up_, value, starts, {}, down.end, up.end};
    for (std::size_t k = down.points.size(); k-- > 1;) {
      branch.points.push_back(described(down.points[k], rub.settled.order));
    }
    branch.points.push_back({value, PointKind::kRegular, rub});
    for (std::size_t k = 1; k < up.points.size(); ++k) {
      branch.points.push_back(described(up.points[k], rub.settled.order));
    }
    branches_.push_back(std::move(branch));
    add_doubled(branches_.size() - 1, options_->most_doublings);
    name_origins();
  }

  // Searches the motions of a neighbouring diagram here.
  void carry_over(const std::vector<RubBranch>& beside, const std::string& start) {
    for (const RubBranch& branch : beside) {
      const auto from = std::ranges::find(branch.points, branch.from, &RubOnBranch::value);
      // Branches of twice the period are found from the others.
      if (from == branch.points.end() || from->point == PointKind::kPeriodDoubling) continue;
      const PeriodicMotion& old = from->rub.settled.motion;
      const auto refusable = without_refusal([&] { return machines_->model(from->value, up_); });
      if (!refusable) continue;
      const Model& model = *refusable;
      const periodic::Forcing forcing = periodic::forcing_of(model);
      periodic::Guess guess{old.start, old.period, old.turns, old.held, old.frame != 0.0};
      if (forcing.period > 0.0 && !guess.turning) {
        guess.start.t *= from->rub.settled.order * forcing.period / guess.period;
        guess.period = from->rub.settled.order * forcing.period;
        const double first = std::max(forcing.settled, old.start.t);
        const double early = (first - guess.start.t) / forcing.period;
        guess.start.t += std::max(0.0, std::ceil(early)) * forcing.period;
      } else if (guess.turning) {
        guess.start.t *= std::abs(old.frame) * forcing.period / (2.0 * std::numbers::pi);
      }
      periodic::SettledMotion settled;
      settled.motion = periodic::find_periodic_motion(model, guess);
      settled.order = from->rub.settled.order;
      if (!settled.motion.found()) continue;
      const PeriodicRub rub = periodic_rub(model, std::move(settled));
      if (rub.kind == from->rub.kind) add(from->value, rub, {start});
    }
  }

  const std::vector<RubBranch>& branches() const { return branches_; }

 private:
  // Follows the branches of twice the period that begin on a branch, and then those on them.
  void add_doubled(std::size_t of, int deep) {
    for (std::size_t k = 0; deep > 0 && k < branches_[of].points.size(); ++k) {
      if (options_->interrupt && *options_->interrupt) return;
      const RubOnBranch& at = branches_[of].points[k];
      if (!begins_another(at) || begun_at(at)) continue;
      const PeriodicMotion& motion = at.rub.settled.motion;
      ContinuationParameters parameters = parameters_from(at.value, motion, 1.0);
      parameters.most_points = std::max(kLeastPoints, parameters.most_points / 2);
      const std::optional<Branch> found = without_refusal([&] {
        return periodic::continue_doubled([this](double x) { return machines_->model(x, up_); },
                                          {at.point, at.value, motion}, parameters);
      });
      if (!found || found->points.size() < 2) continue;
      RubBranch branch{up_,        at.value, {"a period doubling"}, {}, periodic::kAtDoubling,
                       found->end, {}};
      const int order = 2 * at.rub.settled.order;
      for (const periodic::BranchPoint& point : found->points)
        branch.points.push_back(described(point, order));
      branches_.push_back(std::move(branch));
      add_doubled(branches_.size() - 1, deep - 1);
    }
  }

  // True if a branch of twice the period begins there.
  static bool begins_another(const RubOnBranch& at) {
    return at.point == PointKind::kPeriodDoubling && periodic::flips(at.rub.settled.motion);
  }

  // A branch of twice the period that begins or ends at a period doubling; null if none is known.
  RubBranch* begun_at(const RubOnBranch& doubling) {
    constexpr double kSame = 1e-5;
    const double period = 2.0 * doubling.rub.settled.motion.period;
    const auto is_it = [&](const RubOnBranch& end) {
      return end.point == PointKind::kPeriodDoubling && !begins_another(end) &&
             std::abs(end.value - doubling.value) <= kSame * (high_ - low_) &&
             std::abs(end.rub.settled.motion.period - period) <= kSame * period;
    };
    const auto found = std::ranges::find_if(branches_, [&](const RubBranch& branch) {
      return is_it(branch.points.front()) || is_it(branch.points.back());
    });
    return found == branches_.end() ? nullptr : &*found;
  }

  void name_origins() {
    for (std::size_t k = 0; k < branches_.size(); ++k) {
      for (const RubOnBranch& at : branches_[k].points) {
        RubBranch* begun = begins_another(at) ? begun_at(at) : nullptr;
        if (begun && !begun->origin) begun->origin = {k, at.value};
      }
    }
  }

  Branch continued(double value, const PeriodicRub& rub, double direction) const {
    if (key_.ends_with("sample_time") || key_.ends_with(".delay")) {
      Branch none;
      none.end = "a control acts in whole samples, so its motions do not change smoothly";
      return none;
    }
    try {
      return periodic::continue_branch([this](double at) { return machines_->model(at, up_); },
                                       value, rub.settled.motion,
                                       parameters_from(value, rub.settled.motion, direction));
    } catch (const scene::SceneError& error) {
      Branch none;
      none.end = "the scene is refused beside this value: " + error.diagnostics().front().reason;
      return none;
    }
  }

  ContinuationParameters parameters_from(double value, const PeriodicMotion& motion,
                                         double direction) const {
    ContinuationParameters parameters;
    parameters.lowest = low_;
    parameters.highest = high_;
    parameters.scale = kOfRange * (high_ - low_);
    parameters.direction = direction;
    parameters.least_step = 1e-4;
    parameters.most_points = most_points(value, motion);
    return parameters;
  }

  int most_points(double value, const PeriodicMotion& motion) const {
    constexpr std::int64_t kOfDirection = 8;
    const Model model = machines_->model(value, up_);
    const periodic::ReturnMap map(model, {}, motion.frame != 0.0);
    const auto stretches = static_cast<std::int64_t>(
        map.at(motion.start, motion.period, motion.turns).motion.stretches.size());
    const std::int64_t of_point = kOfDirection * (stretches + 1) * map.essential().size();
    return static_cast<int>(std::clamp<std::int64_t>(options_->most_stretches / of_point,
                                                     kLeastPoints, options_->most_points));
  }

  RubOnBranch described(const periodic::BranchPoint& point, int order) const {
    const Model model = machines_->model(point.parameter, up_);
    periodic::SettledMotion settled;
    settled.motion = point.motion;
    settled.order = order;
    return {point.parameter, point.kind, periodic_rub(model, std::move(settled))};
  }

  const Machines* machines_;
  std::string key_;
  double low_, high_, up_;
  const BranchOptions* options_;
  std::vector<RubBranch> branches_;
};

}  // namespace

bool lies_on(const RubBranch& branch, double value, const PeriodicRub& rub) {
  constexpr double kNear = 0.02, kBeside = 0.05;
  constexpr double kAngle = 1e-6;  // rad, round-off of the angle around the ring in one period
  const periodic::ContactFigures& f = rub.figures[rub.contact];
  const auto is_between = [](double x, double a, double b, double least = 0.0) {
    const double slack = kNear * std::max(std::abs(a), std::abs(b)) + least;
    return x >= std::min(a, b) - slack && x <= std::max(a, b) + slack;
  };
  for (std::size_t k = 0; k + 1 < branch.points.size(); ++k) {
    const RubOnBranch &a = branch.points[k], &b = branch.points[k + 1];
    // A branch ends next to the end of the range.
    const double beside = kBeside * std::abs(b.value - a.value);
    if (value < std::min(a.value, b.value) - beside || value > std::max(a.value, b.value) + beside)
      continue;
    if (a.rub.settled.order != rub.settled.order || a.rub.contact != rub.contact) continue;
    const bool is_stable = a.rub.settled.motion.stable || b.rub.settled.motion.stable;
    if (rub.settled.motion.stable && !is_stable) continue;
    const periodic::ContactFigures &fa = a.rub.figures[rub.contact],
                                   &fb = b.rub.figures[rub.contact];
    if (is_between(f.mean_force, fa.mean_force, fb.mean_force) &&
        is_between(f.amplitude, fa.amplitude, fb.amplitude) &&
        is_between(f.whirl, fa.whirl, fb.whirl, kAngle / rub.settled.motion.period) &&
        is_between(rub.settled.motion.period, a.rub.settled.motion.period,
                   b.rub.settled.motion.period)) {
      return true;
    }
  }
  return false;
}

RubBranches rub_branches(const scene::Variants& scenes, const MapAxis& across,
                         const std::optional<MapAxis>& up, const BranchOptions& options) {
  const double speed = scenes.scene({}, false).rotor.speed;
  const SceneAt scene_at = [&](double value, double of_up) {
    std::vector<std::string> changes{fmt::format("{}={}", across.key, value)};
    if (up) changes.push_back(fmt::format("{}={}", up->key, of_up));
    scene::Scene scene = scenes.scene(changes, false);
    if (across.key != kSpeedKey && (!up || up->key != kSpeedKey)) return scene;
    for (scene::Force& force : scene.forces) force.frequency *= scene.rotor.speed / speed;
    return scene;
  };
  return rub_branches(scene_at, across, up, options);
}

RubBranches rub_branches(const SceneAt& scene_at, const MapAxis& across,
                         const std::optional<MapAxis>& up, const BranchOptions& options) {
  constexpr double kOfSearch = 0.5;  // share of the progress
  const Machines machines(scene_at);
  const std::vector<double> ups = up ? up->values : std::vector<double>{0.0};
  const std::size_t columns = across.values.size();
  const auto part = [&](double from) -> std::function<void(double)> {
    return [&options, from](double share) {
      if (options.progress) options.progress(from + kOfSearch * share);
    };
  };
  ShootingOptions shooting = options.shooting;
  shooting.interrupt = options.interrupt;
  std::vector<Found> found(columns * ups.size());
  in_parallel(found.size(), 0, options.interrupt, part(0.0), [&](std::size_t k) {
    found[k] = found_at(machines, across.values[k % columns], ups[k / columns], shooting);
  });
  RubBranches all{across, up, {}, {}, {}, {}};
  std::vector<Diagram> diagrams;
  for (const double value : ups) diagrams.emplace_back(machines, across, value, options);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double value = across.values[k % columns], of = ups[k / columns];
    PeriodicRubs& rubs = found[k].rubs;
    if (!rubs.refused.empty()) rubs.without.push_back({"any start", rubs.refused});
    if (found[k].error)
      rubs.without.push_back(
          {"any start", scene::to_string(found[k].error->diagnostics().front())});
    for (const UnsettledStart& start : rubs.without)
      all.without.push_back({value, of, start.start, start.why});
    if (all.contacts.empty()) all.contacts = rubs.contacts;
    if (!rubs.sampling.empty()) {
      all.sampling =
          "Sampled controls have the nearest sample times that divide the period of the loads, "
          "and sensors without noise and resolution.";
    }
  }
  if (std::ranges::all_of(found, [](const Found& at) { return at.error.has_value(); }))
    throw *found.front().error;
  in_parallel(diagrams.size(), 0, options.interrupt, part(kOfSearch), [&](std::size_t u) {
    for (std::size_t k = 0; k < columns; ++k) {
      for (const PeriodicRub& rub : found[u * columns + k].rubs.rubs)
        diagrams[u].add(across.values[k], rub, rub.starts);
    }
  });
  for (std::size_t u = 1; u < ups.size(); ++u)
    diagrams[u].carry_over(diagrams[u - 1].branches(), "the branch at the value below");
  for (std::size_t u = ups.size(); u-- > 1;)
    diagrams[u - 1].carry_over(diagrams[u].branches(), "the branch at the value above");
  for (const Diagram& diagram : diagrams) {
    const std::size_t before = all.branches.size();
    std::ranges::copy(diagram.branches(), std::back_inserter(all.branches));
    for (std::size_t k = before; k < all.branches.size(); ++k) {
      if (all.branches[k].origin) all.branches[k].origin->branch += before;
    }
  }
  return all;
}

}  // namespace rotorub
