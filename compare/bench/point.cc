#include "compare/bench/point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "compare/base/median.h"
#include "compare/base/units.h"
#include "native_model/trajectory/columns.h"

namespace rotorub::bench {

const char* to_string(Outcome outcome) {
  constexpr const char* kWords[] = {"ok", "chatter", "wrong_attractor", "diverged", "refused"};
  return kWords[static_cast<int>(outcome)];
}

PointErrors point_errors(const Trajectory& trajectory, const Reference& reference) {
  assert(trajectory.rows() == reference.trajectory.rows());
  assert(trajectory.contacts == reference.trajectory.contacts);
  PointErrors e;
  e.position = position_distance(trajectory, reference.trajectory);

  // At an impact the force is not defined, and a row of a fixed-step engine next to an impact is
  // not meaningful. Rows where the reference has a force are rows of lasting contact.
  double off = 0.0, sum = 0.0;
  for (std::size_t contact = 0; contact < trajectory.contacts; ++contact) {
    const std::string name = column_of_contact(contact, "normal_force");
    const auto& force = trajectory.column(name);
    const auto& exact = reference.trajectory.column(name);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      if (exact[k] <= 0.0) continue;
      off += std::abs(force[k] - exact[k]);
      sum += exact[k];
    }
  }
  if (sum > 0.0) e.force = off / sum;

  const double impulse = reference.trajectory.statistics.impulse_total;
  if (impulse > 0.0) {
    e.impulse = std::abs(trajectory.statistics.impulse_total - impulse) / impulse;
  }
  return e;
}

Judgement judge(const Trajectory& trajectory, const Settled& settled, const Settled& reference,
                const std::vector<ContactFacts>& contacts) {
  if (trajectory.status == Status::kStepTooLarge) return {Outcome::kRefused, trajectory.message};
  if (trajectory.status != Status::kOk) {
    return {Outcome::kDiverged,
            fmt::format("{} at t = {:.6g} s: {}", rotorub::to_string(trajectory.status),
                        trajectory.end, trajectory.message)};
  }
  const DeepestPenetration deepest = deepest_penetration(trajectory.statistics, contacts);
  const double clearance = contacts[deepest.contact].clearance;
  if (deepest.depth > kLost * clearance) {
    return {Outcome::kDiverged,
            fmt::format("the rotor has been {:.3g} m deep in a ring with a clearance of {:.3g} m",
                        deepest.depth, clearance)};
  }
  const auto said = [&](const char* what) {
    return fmt::format(
        "{}{} (in contact {:.3g} % of the last fifth, whirl {:.5g} Hz) where the reference has {} "
        "({:.3g} %, {:.5g} Hz)",
        what, rotorub::to_string(settled.attractor), 100.0 * settled.contact_share,
        kHz * settled.whirl_frequency, rotorub::to_string(reference.attractor),
        100.0 * reference.contact_share, kHz * reference.whirl_frequency);
  };
  if (settled.attractor != reference.attractor) {
    const bool bounces = settled.attractor == Attractor::kBouncing;
    return bounces ? Judgement{Outcome::kChatter, said("")}
                   : Judgement{Outcome::kWrongAttractor, said("another attractor: ")};
  }
  // The same kind of motion at another frequency is another attractor too, such as a second whip.
  const bool whirls = reference.attractor == Attractor::kBackwardWhip ||
                      reference.attractor == Attractor::kForwardRub ||
                      reference.attractor == Attractor::kRolling;
  const double apart = std::abs(settled.whirl_frequency - reference.whirl_frequency);
  if (whirls && apart > kWhirlTolerance * std::abs(reference.whirl_frequency)) {
    return {Outcome::kWrongAttractor, said("another whirl: ")};
  }
  return {};
}

double Point::us_per_step() const {
  return steps > 0 ? 1e6 * wall.median / static_cast<double>(steps) : 0.0;
}

double Point::real_time_factor() const { return wall.median > 0.0 ? end / wall.median : 0.0; }

namespace {

// The distance of each completed run from the completed run with the finest step in its series.
// runs: one per point.
void add_limit_errors(const std::vector<Trajectory>& runs, std::vector<Point>& points) {
  const auto counts = [](const Point& p) { return p.finished() && p.setting.step; };
  std::map<std::pair<std::string, std::string>, std::size_t> finest;  // by engine and setting
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Setting& s = points[k].setting;
    if (!counts(points[k])) continue;
    const auto [known, fresh] = finest.try_emplace({s.engine, s.setting}, k);
    if (!fresh && *s.step < *points[known->second].setting.step) known->second = k;
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!counts(points[k])) continue;
    const std::size_t limit = finest.at({points[k].setting.engine, points[k].setting.setting});
    if (limit != k) points[k].limit_error = position_distance(runs[k], runs[limit]);
  }
}

// The point of one setting without its time. An exception of an engine becomes its judgement, and
// the other settings continue. trajectory: receives the recorded run.
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
  const std::vector<ContactFacts> contacts = contact_facts(*setting.scene);
  if (whole) {
    point.metrics = metrics(trajectory, contacts);
    point.errors = point_errors(trajectory, reference);
  }
  point.judgement = judge(trajectory, whole ? point.metrics->settled : Settled{}, goal, contacts);
  point.steps = trajectory.steps;
  point.end = trajectory.end;
  point.recorded_wall = trajectory.wall_s;
  return point;
}

}  // namespace

std::vector<Point> error_pass(const std::vector<Setting>& settings, const Reference& reference,
                              const Progress& progress, const std::atomic<bool>* interrupt) {
  std::vector<Point> points;
  std::vector<Trajectory> runs;
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
    points.push_back(std::move(point));
    runs.push_back(std::move(trajectory));
  }
  add_limit_errors(runs, points);
  return points;
}

int repeats_of(double seconds, const TimingParameters& parameters) {
  const double fit = parameters.budget / std::max(seconds, 1e-12);
  if (fit >= parameters.repeats) return parameters.repeats;
  return std::min(parameters.repeats, std::max(parameters.fewest, static_cast<int>(fit)));
}

WallTime wall_time(const std::vector<double>& seconds) {
  return {median(seconds), std::ranges::min(seconds), std::ranges::max(seconds),
          static_cast<int>(seconds.size())};
}

void interleaved(std::vector<TimedJob> jobs, const TimingParameters& parameters,
                 const Progress& progress, const std::atomic<bool>* interrupt) {
  double whole = 1e-12, done = 0.0;
  for (const TimedJob& job : jobs) whole += job.estimate * repeats_of(job.estimate, parameters);
  for (int round = 0; round < parameters.repeats; ++round) {
    for (TimedJob& job : jobs) {
      if (round >= repeats_of(job.estimate, parameters) || stopped(interrupt)) continue;
      const double taken = job.run();
      if (stopped(interrupt)) break;  // do not count an interrupted run
      job.seconds.push_back(taken);
      done += job.estimate;
      progress(std::min(1.0, done / whole), "times");
    }
  }
  for (const TimedJob& job : jobs)
    job.keep(job.seconds.empty() ? WallTime{} : wall_time(job.seconds));
}

void timing_pass(std::vector<Point>& points, const TimingParameters& parameters,
                 const Progress& progress, const std::atomic<bool>* interrupt) {
  std::vector<TimedJob> jobs;
  for (Point& point : points) {
    if (!point.finished()) continue;
    RunRequest request;
    request.step = point.setting.step;
    request.output_times = std::vector<double>{};
    request.interrupt = interrupt;
    jobs.push_back({[setting = point.setting, request] {
                      return setting.runner->run(*setting.scene, request).wall_s;
                    },
                    point.recorded_wall, [&point](const WallTime& wall) { point.wall = wall; }});
  }
  interleaved(std::move(jobs), parameters, progress, interrupt);
}

}  // namespace rotorub::bench
