#include "compare/sweep/ensemble_points.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "compare/engine/engine.h"
#include "compare/sweep/point_run.h"
#include "compare/sweep/sample.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/stepping/ensemble.h"
#include "native_model/stepping/lane_model.h"
#include "native_model/system/model_checks.h"
#include "native_model/trajectory/range_check.h"

namespace rotorub::sweep {
namespace {

// Points that are run at once.
struct Group {
  double step = 0.0, end = 0.0;  // s
  std::vector<const PointScene*> points;
  std::vector<Model> models;

  bool takes(const PointScene& point, const Model& model) const {
    return step == point.scene.run.step && end == point.scene.run.end &&
           same_structure(models.front(), model);
  }
};

std::int64_t steps_of(const Group& group) {
  return static_cast<std::int64_t>(std::ceil(group.end / group.step - 1e-9));
}

// The steps nearest to the rows that tell where a run has settled.
std::vector<std::int64_t> rows_of(const Group& group) {
  std::vector<std::int64_t> rows;
  for (int row = 0; row < kSettledRows; ++row) {
    const double at = settled_row(group.end, row) / group.step;
    rows.push_back(std::min(steps_of(group), static_cast<std::int64_t>(std::llround(at))));
  }
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

// What the looks at a run gather.
struct Seen {
  LastPart part;
  std::int64_t impacts_before = -1;       // the last part; -1: not there yet
  bool lost = false;                      // out of range, or no longer finite
  double first_angle = 0.0, angle = 0.0;  // rad, of the spin, at the first look and the last

  void look(const EnsembleLook& look, const Model& model, double step) {
    const ContactPoint p = contact_point(model, look.q, look.v);
    RelativePoint point;
    point.t = static_cast<double>(look.k) * step;
    point.delta = p.delta;
    point.angle = std::atan2(p.d.y(), p.d.x());
    point.whirl_speed = p.has_normal ? p.whirl_speed() : 0.0;
    point.angle_rate = p.has_normal ? point.whirl_speed / p.delta : 0.0;
    part.points.push_back(point);
    part.normal_force.push_back(look.normal_force);
    part.slip.push_back(p.slip);
    angle = spin_angle(model, point.t, look.q);
    if (part.points.size() == 1) first_angle = angle;
    if (impacts_before < 0) impacts_before = look.impacts;
    const auto impacts = static_cast<std::size_t>(look.impacts - impacts_before);
    if (impacts > part.impacts) part.impact_times.push_back(point.t);
    part.impacts = impacts;
    lost = lost || !std::isfinite(p.delta) || !std::isfinite(p.slip) ||
           out_of_range(model, look.q).has_value();
  }
};

Metrics figures_of(const EnsembleRun& run, const Group& group, Seen& seen) {
  Metrics f;
  f.end = group.end;
  f.step = group.step;
  f.steps = steps_of(group);
  if (run.first_touch >= 0.0) f.first_touch = run.first_touch;
  f.impacts = static_cast<std::size_t>(run.impacts);
  f.contact_fraction = run.contact_fraction(group.end, group.step);
  f.mean_force = run.mean_force(group.end);
  f.peak_force = run.peak_impulse / group.step;
  f.impulse_total = run.impulse_total;
  f.peak_impulse = run.peak_impact;
  f.friction_work = run.friction_work;
  f.max_penetration = run.max_penetration;
  f.energy_residual = std::numeric_limits<double>::quiet_NaN();
  seen.part.from = (1.0 - kSettledShare) * group.end;
  if (const auto& points = seen.part.points; points.size() > 1) {
    seen.part.spin_speed = (seen.angle - seen.first_angle) / (points.back().t - points.front().t);
  }
  f.settled = settled(seen.part);
  return f;
}

bool finite(const EnsembleRun& run) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  return std::isfinite(run.impulse_total) && std::isfinite(run.peak_impulse) &&
         std::all_of(run.q.begin(), run.q.end(), is_finite) &&
         std::all_of(run.v.begin(), run.v.end(), is_finite);
}

// Alone, for the words of its failure. What its bits alone do not show is reported by the ensemble.
std::optional<PointResult> run_again(const PointScene& point, Status status,
                                     const std::atomic<bool>& interrupt) {
  const auto engine = native_engine(scene::Integrator::kVerlet);
  auto result = run_single(point.point, point.scene, *engine, interrupt);
  if (!result || !result->ok()) return result;
  result->status = to_string(status);
  result->reason = "seen in the ensemble alone";
  result->figures.reset();
  return result;
}

void run_group(const Group& group, const std::atomic<bool>& interrupt,
               std::vector<PointResult>& out) {
  std::vector<Seen> seen(group.points.size());
  EnsembleWatch watch;
  watch.steps = rows_of(group);
  watch.interrupt = &interrupt;
  watch.look = [&](const EnsembleLook& look) {
    seen[look.run].look(look, group.models[look.run], group.step);
  };
  Ensemble ensemble(group.models, group.step);
  const std::vector<EnsembleRun> runs = ensemble.run(steps_of(group), watch);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PointScene& point = *group.points[i];
    Status status = runs[i].status;
    if (status == Status::kInterrupted) continue;
    if (status == Status::kOk && !finite(runs[i])) status = Status::kDiverged;
    if (status == Status::kOk && seen[i].lost) status = Status::kOutOfRange;
    if (status == Status::kOk) {
      PointResult result;
      result.point = point.point;
      result.figures = figures_of(runs[i], group, seen[i]);
      out.push_back(std::move(result));
    } else if (auto result = run_again(point, status, interrupt)) {
      out.push_back(std::move(*result));
    }
  }
}

}  // namespace

bool has_ensemble(scene::Integrator integrator) { return integrator == scene::Integrator::kVerlet; }

std::vector<PointResult> run_ensembles(const std::vector<PointScene>& points,
                                       const std::atomic<bool>& interrupt) {
  std::vector<PointResult> out;
  std::vector<Group> groups;
  for (const PointScene& point : points) {
    if (!point.scene.fits_lanes()) {
      const auto engine = native_engine(scene::Integrator::kVerlet);
      if (auto result = run_single(point.point, point.scene, *engine, interrupt)) {
        out.push_back(std::move(*result));
      }
      continue;
    }
    try {
      Model model = make_model(point.scene);
      check_steps(point.scene, point.scene.run.step);
      refuse_finite_impacts(point.scene, FiniteImpacts::kUnsampled);
      auto group = std::find_if(groups.begin(), groups.end(),
                                [&](const Group& g) { return g.takes(point, model); });
      if (group == groups.end()) {
        groups.push_back({point.scene.run.step, point.scene.run.end, {}, {}});
        group = std::prev(groups.end());
      }
      group->points.push_back(&point);
      group->models.push_back(std::move(model));
    } catch (const scene::SceneError& error) {
      out.push_back(refused(point.point, reason_of(error)));
    }
  }
  for (const Group& group : groups) run_group(group, interrupt, out);
  return out;
}

}  // namespace rotorub::sweep
