#include "compare/sweep/point_run.h"

#include <stdexcept>
#include <utility>

#include "compare/base/in_parallel.h"
#include "compare/metrics/rows.h"
#include "compare/sweep/sample.h"

namespace rotorub::sweep {
std::unique_ptr<Engine> engine_of(const Study& study, const scene::Scene& scene) {
  if (study.engine == EngineKind::kMujoco) {
    return mujoco_engine(study.contact.value_or(scene.mujoco.contact));
  }
  return native_engine(study.integrator.value_or(scene.run.integrator));
}

std::optional<std::string> refusal_of(const std::function<void()>& work) {
  try {
    work();
    return std::nullopt;
  } catch (const scene::SceneError& error) {
    return reason_of(error);
  } catch (const std::invalid_argument& error) {
    return error.what();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

std::optional<PointResult> run_point(const Study& study, std::int64_t point,
                                     const SceneOfPoint& scene_at,
                                     const std::atomic<bool>& interrupt) {
  if (interrupt) return std::nullopt;
  PointResult result;
  result.point = point;
  bool interrupted = false;
  const auto refused = refusal_of([&] {
    const scene::Scene scene = scene_at(point);
    RunRequest request;
    request.interrupt = &interrupt;
    // Rows that show where the run has settled.
    constexpr std::size_t kSettledRows = 41;
    const double end = scene.run.end;
    request.output_times = even_times((1.0 - kSettledShare) * end, end, kSettledRows);
    request.output_times->back() = end;
    const Trajectory trajectory = engine_of(study, scene)->run(scene, request);
    interrupted = trajectory.status == Status::kInterrupted;
    result.status = to_string(trajectory.status);
    if (trajectory.status != Status::kOk) {
      result.reason = trajectory.message;
      return;
    }
    result.figures = totals(trajectory);
    result.figures->settled = settled(trajectory);
  });
  if (interrupted) return std::nullopt;
  if (refused) {
    result.status = kRefused;
    result.reason = *refused;
    result.figures.reset();
  }
  return result;
}

std::vector<PointResult> run_points(const Study& study, std::int64_t count,
                                    const SceneOfPoint& scene_at,
                                    const std::atomic<bool>& interrupt) {
  std::vector<PointResult> all(static_cast<std::size_t>(count));
  for (PointResult& result : all) result.status.clear();
  in_parallel(all.size(), 0, &interrupt, {}, [&](std::size_t k) {
    auto result = run_point(study, static_cast<std::int64_t>(k), scene_at, interrupt);
    if (result) all[k] = std::move(*result);
  });
  return all;
}

}  // namespace rotorub::sweep
