#include "compare/bench/error_pass.h"

#include <map>
#include <stdexcept>
#include <utility>

namespace rotorub::bench {
namespace {

bool stopped(const std::atomic<bool>* interrupt) {
  return interrupt && interrupt->load(std::memory_order_relaxed);
}

// The finest step of each series that reached the end.
class Limits {
 public:
  void add(const Point& point, Trajectory trajectory, std::size_t index) {
    if (!point.setting.step) return;
    runs_[{point.setting.engine, point.setting.setting}].push_back({index, std::move(trajectory)});
  }
  void fill(std::vector<Point>& points) const {
    for (const auto& [series, runs] : runs_) {
      const Run* finest = &runs.front();
      const auto step = [&](const Run& run) { return *points[run.index].setting.step; };
      for (const Run& run : runs) {
        if (step(run) < step(*finest)) finest = &run;
      }
      for (const Run& run : runs) {
        if (&run == finest) continue;
        points[run.index].limit_error = position_distance(run.trajectory, finest->trajectory);
      }
    }
  }

 private:
  struct Run {
    std::size_t index;
    Trajectory trajectory;
  };
  std::map<std::pair<std::string, std::string>, std::vector<Run>> runs_;
};

// Whatever an engine throws is said of this point, and the others go on.
Trajectory run(const Setting& setting, const RunRequest& request, Judgement& judgement) {
  try {
    return setting.runner->run(*setting.scene, request);
  } catch (const std::exception& error) {
    judgement = {Outcome::kRefused, error.what()};
    return {};
  }
}

}  // namespace

std::vector<Point> error_pass(const std::vector<Setting>& settings, const Reference& reference,
                              const Progress& progress, const std::atomic<bool>* interrupt) {
  std::vector<Point> points;
  Limits limits;
  const Settled goal = settled(reference.trajectory);
  for (std::size_t k = 0; k < settings.size() && !stopped(interrupt); ++k) {
    const Setting& setting = settings[k];
    Point point;
    point.setting = setting;
    RunRequest request;
    request.step = setting.step;
    request.output_times = reference.times;
    request.interrupt = interrupt;
    request.progress = [&](double share) {
      progress((static_cast<double>(k) + share) / static_cast<double>(settings.size()),
               "errors: " + setting.engine);
    };
    if (!setting.refusal.empty()) {
      point.judgement = {Outcome::kRefused, setting.refusal};
      points.push_back(std::move(point));
      continue;
    }
    Trajectory trajectory = run(setting, request, point.judgement);
    if (stopped(interrupt)) break;
    if (point.judgement.outcome != Outcome::kRefused) {
      const bool whole = trajectory.status == Status::kOk;
      if (whole) point.metrics = metrics(trajectory, contact_facts(*setting.scene));
      point.judgement = judge(trajectory, whole ? point.metrics->settled : Settled{}, goal);
      point.steps = trajectory.steps;
      point.end = trajectory.end;
      point.wall.median = trajectory.wall_s;
      if (whole) {
        point.errors = point_errors(trajectory, reference);
        limits.add(point, std::move(trajectory), points.size());
      }
    }
    points.push_back(std::move(point));
  }
  limits.fill(points);
  return points;
}

}  // namespace rotorub::bench
