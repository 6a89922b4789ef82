#include "compare/sweep/point_run.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "compare/base/in_parallel.h"
#include "compare/sweep/ensemble_points.h"
#include "compare/sweep/sample.h"

namespace rotorub::sweep {
namespace {

constexpr std::int64_t kEnsemblePoints = 32;  // of a batch: whole groups on every instruction set

// Whether points may run side by side, by the integrators that have ensembles.
bool may_share_registers(const Study& study) {
  return study.engine == EngineKind::kNative && !study.all_figures;
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
      result.figures = totals(trajectory);
      result.figures->settled = settled(trajectory);
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

std::vector<PointResult> run_batch(const Study& study, const std::vector<std::int64_t>& points,
                                   const SceneOfPoint& scene_at,
                                   const std::atomic<bool>& interrupt) {
  std::vector<PointResult> out;
  std::vector<PointScene> together;
  for (const std::int64_t point : points) {
    if (interrupt) return {};
    try {
      PointScene made{point, scene_at(point)};
      const auto integrator = study.integrator.value_or(made.scene.run.integrator);
      if (may_share_registers(study) && has_ensemble(integrator)) {
        together.push_back(std::move(made));
      } else if (auto result =
                     run_single(point, made.scene, *engine_of(study, made.scene), interrupt)) {
        out.push_back(std::move(*result));
      }
    } catch (const scene::SceneError& error) {
      out.push_back(refused(point, reason_of(error)));
    }
  }
  for (PointResult& result : run_ensembles(together, interrupt)) out.push_back(std::move(result));
  return out;
}

std::int64_t batch_size(const Study& study) {
  // Where each point says its integrator, any of them may be one with ensembles.
  const bool together =
      may_share_registers(study) && (!study.integrator || has_ensemble(*study.integrator));
  return together ? kEnsemblePoints : 1;
}

std::vector<PointResult> run_points(const Study& study, std::int64_t count,
                                    const SceneOfPoint& scene_at,
                                    const std::atomic<bool>& interrupt) {
  std::vector<PointResult> all(static_cast<std::size_t>(count));
  for (PointResult& result : all) result.status.clear();
  const std::int64_t size = batch_size(study);
  in_parallel(
      static_cast<std::size_t>((count + size - 1) / size), 0, &interrupt, {}, [&](std::size_t k) {
        const std::int64_t begin = static_cast<std::int64_t>(k) * size;
        std::vector<std::int64_t> points(static_cast<std::size_t>(std::min(size, count - begin)));
        std::iota(points.begin(), points.end(), begin);
        for (PointResult& result : run_batch(study, points, scene_at, interrupt)) {
          all[static_cast<std::size_t>(result.point)] = std::move(result);
        }
      });
  return all;
}

}  // namespace rotorub::sweep
