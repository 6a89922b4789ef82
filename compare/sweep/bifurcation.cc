#include "compare/sweep/bifurcation.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "compare/base/in_parallel.h"
#include "compare/engine/continued.h"
#include "compare/engine/lyapunov.h"
#include "compare/metrics/orbit.h"
#include "compare/metrics/rows.h"
#include "compare/sweep/point_run.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub::sweep {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

// The scene of a value and its run, from which the next value continues.
struct Before {
  scene::Scene scene;
  Trajectory run;
};

double turn_of(const scene::Scene& scene) { return kWholeTurn / std::abs(scene.rotor.speed); }

Trajectory run_of(const Study& study, const scene::Scene& scene, double turn,
                  const std::atomic<bool>* interrupt) {
  const double end = scene.run.end, part = std::min(0.5 * end, (Bifurcation::kTurns + 0.5) * turn);
  RunRequest request;
  request.interrupt = interrupt;
  request.output_times = {{end - part, end}};
  return engine_of(study, scene)->run(scene, request);
}

class Branch {
 public:
  Branch(const PointScenes& scenes, bool follows, bool exponents,
         const std::atomic<bool>* interrupt)
      : scenes_(scenes), follows_(follows), exponents_(exponents), interrupt_(interrupt) {}

  BranchPoint at(std::int64_t point) {
    BranchPoint out{point, {}};
    const auto refused = refusal_of([&] {
      const scene::Scene own = scenes_.at(point);
      if (own.rotor.speed == 0.0) throw std::runtime_error("a rotor at rest has no turns");
      out.continued = follows_ && before_ && continue_at(own, out);
      if (!out.continued) step(own, out);
    });
    out.refused = refused.value_or("");
    return out;
  }

 private:
  // False if this value cannot start where the previous one ended, because of a smaller ring or
  // other modes.
  bool continue_at(const scene::Scene& own, BranchPoint& out) {
    try {
      step(continued(own, before_->scene, before_->run), out);
      return true;
    } catch (const scene::SceneError&) {
      out.places.clear();
      return false;
    }
  }
  void step(const scene::Scene& scene, BranchPoint& out) {
    const double turn = turn_of(scene);
    Trajectory run = run_of(scenes_.study(), scene, turn, interrupt_);
    if (run.status != Status::kOk)
      throw std::runtime_error(run.message.empty() ? to_string(run.status) : run.message);
    out.places = poincare_points(run, run.column("t").front());
    out.period = section_period(out.places);
    before_ = Before{scene, std::move(run)};
    if (!exponents_) return;
    LyapunovParameters parameters;
    parameters.integrator = scenes_.study().integrator;
    parameters.interrupt = interrupt_;
    out.exponent = lyapunov_after(before_->scene, before_->run, parameters).exponent;
  }

  const PointScenes& scenes_;
  bool follows_, exponents_;
  const std::atomic<bool>* interrupt_;
  std::optional<Before> before_;
};

// The reason for the first value with a valid scene.
std::string reason_not_continued(const PointScenes& scenes) {
  for (std::int64_t point = 0; point < scenes.sample().size(); ++point) {
    try {
      return not_continued(scenes.at(point));
    } catch (const scene::SceneError&) {  // try the next one
    }
  }
  return {};
}

}  // namespace

std::string no_bifurcation(const Study& study) {
  if (study.vary.size() != 1) return "a bifurcation diagram is over one [[vary]] alone";
  if (study.engine != EngineKind::kNative) return "a bifurcation diagram is of native runs alone";
  if (!study.vary.front().has_numbers()) return "a bifurcation diagram is over numbers alone";
  return {};
}

std::optional<Bifurcation> bifurcation(const PointScenes& scenes,
                                       const std::atomic<bool>* interrupt,
                                       const std::function<void(double)>& progress) {
  std::vector<std::int64_t> order(static_cast<std::size_t>(scenes.sample().size()));
  std::iota(order.begin(), order.end(), std::int64_t{0});
  const auto value = [&](std::int64_t point) {
    return scenes.sample().at(point).front().number.value_or(0.0);
  };
  std::ranges::sort(order, {}, value);
  Bifurcation out;
  out.not_continued = reason_not_continued(scenes);
  const bool follows = out.not_continued.empty();
  std::mutex mutex;
  std::size_t done = 0;
  const double all = 2.0 * static_cast<double>(order.size());
  in_parallel(2, 0, interrupt, {}, [&](std::size_t k) {
    Branch branch(scenes, follows, follows && k == 0, interrupt);
    auto& points = k == 0 ? out.up : out.down;
    std::vector<std::int64_t> own = order;
    if (k == 1) std::ranges::reverse(own);
    for (const std::int64_t point : own) {
      if (interrupt && *interrupt) return;
      points.push_back(branch.at(point));
      const std::lock_guard<std::mutex> lock(mutex);
      if (progress) progress(static_cast<double>(++done) / all);
    }
  });
  if (interrupt && *interrupt) return std::nullopt;
  return out;
}

}  // namespace rotorub::sweep
