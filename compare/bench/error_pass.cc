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

// The point of one setting, without a time. Whatever an engine throws is said of it, and the others
// go on. `trajectory`: what was recorded.
Point examine(const Setting& setting, const RunRequest& request, const Reference& reference,
              const Settled& goal, Trajectory& trajectory) {
  Point point;
  point.setting = setting;
  if (!setting.refusal.empty()) {
    point.judgement = {Outcome::kRefused, setting.refusal};
    return point;
  }
  try {
    trajectory = setting.runner->run(*setting.scene, request);
  } catch (const std::exception& error) {
    point.judgement = {Outcome::kRefused, error.what()};
    return point;
  }
  const bool whole = trajectory.status == Status::kOk;
  if (whole) {
    point.metrics = metrics(trajectory, contact_facts(*setting.scene));
    point.errors = point_errors(trajectory, reference);
  }
  point.judgement = judge(trajectory, whole ? point.metrics->settled : Settled{}, goal,
                          setting.scene->first().contact->clearance);
  point.steps = trajectory.steps;
  point.end = trajectory.end;
  point.recorded_wall = trajectory.wall_s;
  return point;
}

}  // namespace

std::vector<Point> error_pass(const std::vector<Setting>& settings, const Reference& reference,
                              const Progress& progress, const std::atomic<bool>* interrupt) {
  std::vector<Point> points;
  Limits limits;
  const Settled goal = settled(reference.trajectory);
  for (std::size_t k = 0; k < settings.size() && !stopped(interrupt); ++k) {
    RunRequest request;
    request.step = settings[k].step;
    request.output_times = reference.times;
    request.interrupt = interrupt;
    request.progress = [&](double share) {
      progress((static_cast<double>(k) + share) / static_cast<double>(settings.size()),
               "errors: " + settings[k].engine);
    };
    Trajectory trajectory;
    Point point = examine(settings[k], request, reference, goal, trajectory);
    if (stopped(interrupt)) break;
    if (point.finished()) limits.add(point, std::move(trajectory), points.size());
    points.push_back(std::move(point));
  }
  limits.fill(points);
  return points;
}

}  // namespace rotorub::bench
