#include "compare/engine/lyapunov.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "compare/engine/continued.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/scene.h"

namespace rotorub {
namespace {

// A scene's start as a vector of lengths: velocities are multiplied by `time`, angles by `length`.
struct StartVector {
  double time, length;

  template <class Each>
  void visit(scene::Scene& s, Each each) const {
    const auto list = [&](std::vector<double>& values, double unit) {
      for (double& value : values) each(value, unit);
    };
    list(s.initial.x, 1.0);
    list(s.initial.y, 1.0);
    list(s.initial.vx, time);
    list(s.initial.vy, time);
    list(s.initial.torsion, length);
    list(s.initial.torsion_speed, length * time);
    if (s.drive) {
      each(s.initial.spin_angle, length);
      each(s.rotor.speed, length * time);
    }
    for (scene::AuxiliaryBearing& at : s.auxiliary) {
      if (!at.stator) continue;
      for (int k = 0; k < 2; ++k) each(at.stator->position[k], 1.0);
      for (int k = 0; k < 2; ++k) each(at.stator->velocity[k], time);
    }
  }
  Eigen::VectorXd of(scene::Scene s) const {
    std::vector<double> all;
    visit(s, [&](double& value, double unit) { all.push_back(unit * value); });
    return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }
  scene::Scene moved(scene::Scene s, const Eigen::VectorXd& by) const {
    Eigen::Index k = 0;
    visit(s, [&](double& value, double unit) { value += by[k++] / unit; });
    return s;
  }
};

// The scene with every list of its start filled up to full length.
scene::Scene with_whole_start(scene::Scene s) {
  const Layout l = prepare(s).layout;
  for (std::vector<double>* list : {&s.initial.x, &s.initial.y, &s.initial.vx, &s.initial.vy})
    list->resize(static_cast<std::size_t>(l.modes), 0.0);
  for (std::vector<double>* list : {&s.initial.torsion, &s.initial.torsion_speed})
    list->resize(static_cast<std::size_t>(l.torsion), 0.0);
  return s;
}

}  // namespace

Lyapunov largest_lyapunov(const scene::Scene& start, const LyapunovParameters& p) {
  const std::string why = not_continued(start);
  if (!why.empty()) return {std::nullopt, why};
  if (start.initial.steady)
    return {std::nullopt, "the run starts on its steady orbit; give another start"};
  if (start.initial.rub != scene::StartingRub::kNone)
    return {std::nullopt, "the run starts on a rub; give another start"};
  const double size = smallest_clearance(start).value_or(1e-3), first = p.distance * size;
  const StartVector vector{p.stretch / (2.0 * std::numbers::pi), size};
  NativeOptions options;
  options.integrator = p.integrator;
  options.interrupt = p.interrupt;
  options.output_times = std::vector<double>{p.stretch};
  // Moves in the opposite direction if the first one leads into the ring.
  const auto beside = [&](const scene::Scene& s, bool either_way, const Eigen::VectorXd& by) {
    const scene::Scene there = vector.moved(s, by);
    if (!either_way) return there;
    try {
      prepare(there);
    } catch (const scene::SceneError&) {
      return vector.moved(s, -by);
    }
    return there;
  };
  const auto on = [&](const scene::Scene& s) -> std::optional<scene::Scene> {
    const Trajectory run = run_native(s, options);
    if (run.status != Status::kOk) return std::nullopt;
    return continued(s, s, run);
  };
  try {
    scene::Scene one = with_whole_start(start);
    one.run.end = p.stretch;
    one.run.output_times.clear();
    Eigen::VectorXd line = Eigen::VectorXd::Unit(vector.of(one).size(), 0);
    double sum = 0.0;
    for (int k = 0; k < p.settling + p.stretches; ++k) {
      auto other = on(beside(one, k == 0, first * line));
      auto next = on(one);
      if (!other || !next) return {std::nullopt, "a neighbouring run ended early"};
      line = vector.of(*other) - vector.of(*next);
      const double distance = line.norm();
      if (!(distance > 0.0)) return {std::nullopt, "the neighbouring runs become identical"};
      if (k >= p.settling) sum += std::log(distance / first);
      line /= distance;
      one = std::move(*next);
    }
    return {sum / (p.stretches * p.stretch), {}, p.stretch};
  } catch (const scene::SceneError& error) {
    return {std::nullopt, error.diagnostics().front().reason};
  }
}

Lyapunov lyapunov_after(const scene::Scene& scene, const Trajectory& run, LyapunovParameters p) {
  if (run.status != Status::kOk) return {std::nullopt, "the run ended early"};
  if (scene.rotor.speed == 0.0)
    return {std::nullopt, "the rotor is at rest, so there are no turns to follow"};
  const std::string why = not_continued(scene);
  if (!why.empty()) return {std::nullopt, why};
  const double turn = 2.0 * std::numbers::pi / std::abs(scene.rotor.speed);
  const double step = scene.run.step;
  const bool event = p.integrator.value_or(scene.run.integrator) == scene::Integrator::kEvent;
  p.stretch = event ? turn : step * std::max(1.0, std::round(turn / step));
  try {
    return largest_lyapunov(continued(scene, scene, run), p);
  } catch (const scene::SceneError& error) {
    return {std::nullopt, error.diagnostics().front().reason};
  }
}

}  // namespace rotorub
