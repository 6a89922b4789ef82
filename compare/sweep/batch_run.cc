#include "compare/sweep/batch_run.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "compare/base/in_parallel.h"
#include "compare/sweep/ensemble_points.h"
#include "compare/sweep/point_scene.h"
#include "compare/sweep/single_point.h"

namespace rotorub::sweep {
namespace {

constexpr std::int64_t kEnsemblePoints = 32;  // of a batch: whole groups on every instruction set

}  // namespace

BatchRun::BatchRun(const Study& study, SceneOfPoint scene_at, const std::atomic<bool>& interrupt)
    : study_(study), scene_at_(std::move(scene_at)), interrupt_(interrupt) {}

std::vector<PointResult> BatchRun::run(const std::vector<std::int64_t>& points) const {
  std::vector<PointResult> out;
  std::map<scene::Integrator, std::vector<PointScene>> together;
  for (const std::int64_t point : points) {
    if (interrupt_) return {};
    try {
      PointScene made{point, scene_at_(point)};
      const auto integrator = study_.integrator.value_or(made.scene.run.integrator);
      const bool alike = made.scene.auxiliary.size() == 1;  // lanes have one contact
      if (study_.engine == EngineKind::kNative && has_ensemble(integrator) && alike) {
        together[integrator].push_back(std::move(made));
      } else if (auto result =
                     run_single(point, made.scene, *engine_of(study_, made.scene), interrupt_)) {
        out.push_back(std::move(*result));
      }
    } catch (const scene::SceneError& error) {
      out.push_back(refused(point, reason_of(error)));
    }
  }
  for (const auto& [integrator, members] : together) {
    for (PointResult& result : run_ensembles(members, integrator, interrupt_)) {
      out.push_back(std::move(result));
    }
  }
  return out;
}

std::int64_t batch_size(const Study& study) {
  // Where each point says its integrator, any of them may be one with ensembles.
  const bool together =
      study.engine == EngineKind::kNative && (!study.integrator || has_ensemble(*study.integrator));
  return together ? kEnsemblePoints : 1;
}

std::vector<PointResult> run_points(const Study& study, std::int64_t count,
                                    const SceneOfPoint& scene_at,
                                    const std::atomic<bool>& interrupt) {
  std::vector<PointResult> all(static_cast<std::size_t>(count));
  for (PointResult& result : all) result.status.clear();
  const BatchRun batch(study, scene_at, interrupt);
  const std::int64_t size = batch_size(study);
  in_parallel(
      static_cast<std::size_t>((count + size - 1) / size), &interrupt, {}, [&](std::size_t k) {
        const std::int64_t begin = static_cast<std::int64_t>(k) * size;
        std::vector<std::int64_t> points(static_cast<std::size_t>(std::min(size, count - begin)));
        std::iota(points.begin(), points.end(), begin);
        for (PointResult& result : batch.run(points)) {
          all[static_cast<std::size_t>(result.point)] = std::move(result);
        }
      });
  return all;
}

}  // namespace rotorub::sweep
