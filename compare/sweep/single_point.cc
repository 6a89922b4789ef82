#include "compare/sweep/single_point.h"

#include <algorithm>
#include <stdexcept>

#include "compare/sweep/point_scene.h"

namespace rotorub::sweep {
namespace {

Figures figures_of(const Trajectory& t) {
  const Statistics& s = t.statistics;
  Figures f;
  f.end = t.end;
  f.steps = t.steps;
  if (s.first_touch >= 0.0) f.first_touch = s.first_touch;
  f.contact_fraction = t.contact_fraction();
  f.mean_force = t.mean_force();
  f.peak_force = s.peak_force;
  f.impulse_total = s.impulse_total;
  f.settled = settled(t);
  f.peak_impulse = 0.0;
  for (const Impact& impact : t.impacts) {
    f.impacts += counts(impact) ? 1 : 0;
    f.peak_impulse = std::max(*f.peak_impulse, impact.normal_impulse);
  }
  f.friction_work = s.friction_work;
  f.max_penetration = s.max_penetration;
  f.energy_residual = s.energy_residual();
  return f;
}

}  // namespace

std::unique_ptr<Engine> engine_of(const Study& study, const scene::Scene& scene) {
  if (study.engine == EngineKind::kMujoco) {
    return mujoco_engine(study.contact.value_or(scene.mujoco.contact));
  }
  return native_engine(study.integrator.value_or(scene.run.integrator));
}

PointResult refused(std::int64_t point, std::string reason) {
  PointResult result;
  result.point = point;
  result.status = kRefused;
  result.reason = std::move(reason);
  return result;
}

std::optional<PointResult> run_single(std::int64_t point, const scene::Scene& scene,
                                      const Engine& engine, const std::atomic<bool>& interrupt) {
  RunRequest request;
  request.interrupt = &interrupt;
  request.output_times.emplace();
  for (int row = 0; row < kSettledRows; ++row) {
    request.output_times->push_back(settled_row(scene.run.end, row));
  }
  try {
    const Trajectory trajectory = engine.run(scene, request);
    if (trajectory.status == Status::kInterrupted) return std::nullopt;
    PointResult result;
    result.point = point;
    result.status = to_string(trajectory.status);
    result.reason = trajectory.message;
    if (trajectory.status == Status::kOk) {
      result.reason.clear();
      result.figures = figures_of(trajectory);
    }
    return result;
  } catch (const scene::SceneError& error) {
    return refused(point, reason_of(error));
  } catch (const std::invalid_argument& error) {
    return refused(point, error.what());
  } catch (const std::runtime_error& error) {
    return refused(point, error.what());
  }
}

}  // namespace rotorub::sweep
