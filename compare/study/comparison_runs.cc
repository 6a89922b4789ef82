#include "compare/study/comparison_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/base/median.h"
#include "compare/own/own_machine.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub {
namespace {

constexpr double kMujocoWork = 15.0;

// Sets the statistics of the timing. The median also replaces the time of the side's shown run,
// which ran beside others.
void finish(Side& side) {
  Timing& timing = side.timing;
  if (timing.us_per_step.empty()) return;
  timing.median = median(timing.us_per_step);
  timing.lowest = std::ranges::min(timing.us_per_step);
  timing.highest = std::ranges::max(timing.us_per_step);
  Metrics& m = side.metrics;
  m.us_per_step = timing.median;
  m.wall_s = side.trajectory.wall_s = 1e-6 * timing.median * static_cast<double>(m.steps);
  m.real_time_factor = m.wall_s > 0.0 ? m.end / m.wall_s : 0.0;
}

// From a trajectory with one row per step; each command acts from half a step before its time.
std::shared_ptr<const CommandRecord> commands_of(const Trajectory& t, double step) {
  const bool magnets = t.has("current_1");
  const auto& time = t.column("t");
  const auto& x = t.column(magnets ? "current_1" : "control_x");
  const auto& y = t.column(magnets ? "current_2" : "control_y");
  auto record = std::make_shared<CommandRecord>();
  for (std::size_t i = 0; i < time.size(); ++i) {
    record->add(i == 0 ? time[i] : time[i] - 0.5 * step, {x[i], y[i]});
  }
  return record;
}

}  // namespace

StepWatch recording(std::shared_ptr<CommandRecord> record) {
  return [record = std::move(record)](const WatchedStep& step) {
    record->add(step.command_begin, step.command);
  };
}

std::string cone_refusal(const scene::Scene& scene, bool own) {
  const bool falls = std::ranges::any_of(scene.auxiliary, [](const auto& bearing) {
    return bearing.contact && !bearing.contact->friction.is_constant();
  });
  if (falls) return "has one coefficient for all slips, and here friction depends on the slip";
  if (own || scene.auxiliary.size() < 2 || scene.mujoco.rotor == scene::MujocoRotor::kSegments)
    return "";
  return "supports only one contact of the modal chain; with --set mujoco.rotor=segments it "
         "supports all of them";
}

std::vector<ComparedEngine> compared_engines(const scene::Scene& scene,
                                             const CompareOptions& options) {
  const scene::ContactModel decides = options.contact;
  const auto mujoco = [&](scene::ContactModel contact) {
    return options.own ? own_engine(options.own, contact) : mujoco_engine(contact);
  };
  std::vector<ComparedEngine> all;
  all.push_back({"native", native_engine(scene.run.integrator), kNativeWork});
  all.push_back({to_string(decides), mujoco(decides), kMujocoWork});
  const bool has_cones = cone_refusal(scene, options.own != nullptr).empty();
  for (const auto& [contact, word] : scene::kContactModels) {
    if (contact == decides || (scene::is_cone(contact) && !has_cones)) continue;
    const bool rigid = contact == scene::ContactModel::kRigid;
    if (scene.is_compliant() && (rigid || contact == scene::ContactModel::kCone)) continue;
    all.push_back({word, mujoco(contact), kMujocoWork});
  }
  if (has_cones && !scene.is_compliant()) {
    auto engine = options.own
                      ? own_engine(options.own, scene::ContactModel::kCone, OwnSolref::kDefault)
                      : default_cone_engine();
    all.push_back({kConeDefault, std::move(engine), kMujocoWork, false});
  }
  return all;
}

std::function<void(double)> Runner::part(double work, const std::string& what) {
  if (!options_.progress) return {};
  return [this, work, what, told = std::make_shared<double>(0.0)](double share) {
    const std::lock_guard lock(mutex_);
    done_ += (share - std::exchange(*told, share)) * work;
    options_.progress(done_ / total_, what);
  };
}

Trajectory Runner::run(const Engine& engine, RunRequest request, double work,
                       const std::string& what) {
  return run(scene_, engine, std::move(request), work, what);
}

Trajectory Runner::timed(const ComparedEngine& who, double end,
                         std::shared_ptr<const CommandRecord> commands) {
  scene::Scene shorter = scene_;
  shorter.run.end = end;
  RunRequest request;
  request.output_times = std::vector<double>{end};
  request.commands = std::move(commands);
  return run(shorter, *who.engine, std::move(request), who.work, "timing " + who.label);
}

Trajectory Runner::run(const scene::Scene& scene, const Engine& engine, RunRequest request,
                       double work, const std::string& what) {
  request.interrupt = options_.interrupt;
  request.progress = part(work, what);
  if (request.progress) request.progress(0.0);
  Trajectory trajectory = engine.run(scene, request);
  if (request.progress) request.progress(1.0);
  return trajectory;
}

Side Runner::shown(const ComparedEngine& who, RunRequest request) {
  request.output_times = dense_times(scene_.run, options_.rows);
  Side side;
  side.label = who.label;
  side.engine = who.engine->name();
  request.solref = &side.solref;
  side.trajectory = run(*who.engine, std::move(request), who.work, who.label);
  side.metrics = metrics(side.trajectory, contact_facts(scene_));
  return side;
}

Twins Runner::twins(const ComparedEngine& who, double threshold, TwinParameters parameters) {
  parameters.count = options_.twins;
  parameters.jobs = options_.jobs;
  parameters.interrupt = options_.interrupt;
  parameters.progress = part(parameters.count * who.work, who.label + " twins");
  return run_twins(*who.engine, scene_, who.side->trajectory, threshold, parameters);
}

ModelError Runner::model_error(const std::vector<FigureSample>& native) {
  ModelErrorParameters parameters;
  parameters.tolerance = options_.tolerance;
  parameters.spread = single_run_intervals(native);
  parameters.jobs = options_.jobs;
  parameters.interrupt = options_.interrupt;
  parameters.progress = part(kLadderWork, "more modes");
  return rotorub::model_error(scene_, parameters);
}

StepLevel run_level(Runner& runner, const ComparedEngine& who, std::size_t level,
                    RunRequest request) {
  const double part = level == 1 ? 2.0 : 4.0;
  request.step = runner.scene().run.step / part;
  const Trajectory t = runner.run(*who.engine, std::move(request), part * who.work,
                                  who.label + (level == 1 ? " at half the step" : " at a quarter"));
  return {metrics(t, contact_facts(runner.scene())),
          t.status == Status::kOk ? "" : "a run at a smaller step did not end well: " + t.message};
}

namespace {

// The effect of half the step on a figure.
enum class StepChange { kAbsent, kSmall, kScatter, kLarge };

StepChange step_change(std::size_t k, const Metrics& whole, const Metrics& half,
                       const StepTest& test) {
  constexpr double kSmallPart = 0.05;
  const Figure& f = figures()[k];
  const double native = f.value(test.native), at_whole = f.value(whole);
  const double change = std::abs(share_of(f, native, f.value(half) - at_whole));
  if (std::isnan(change)) return StepChange::kAbsent;
  const double apart = std::abs(deviation(f, native, at_whole));
  if (change <= kSmallPart * std::max(test.tolerance, apart)) return StepChange::kSmall;
  return change <= test.scatter[k] ? StepChange::kScatter : StepChange::kLarge;
}

std::string reason_for_no_limit(StepChange change) {
  switch (change) {
    case StepChange::kAbsent:
      return "a run has no finite value";
    case StepChange::kSmall:
      return "";
    case StepChange::kScatter:
      return "half the step changes the figure by no more than it scatters";
    case StepChange::kLarge:
      break;
  }
  return "no judged figure needed a run at a quarter of the step";
}

}  // namespace

bool needs_quarter(const Side& side, const StepLevel& half, const StepTest& test) {
  if (!half.failed.empty()) return false;
  for (std::size_t k = 0; k < figures().size(); ++k) {
    if (!figures()[k].is_judged() || !figures()[k].split) continue;
    if (step_change(k, side.metrics, half.metrics, test) == StepChange::kLarge) return true;
  }
  return false;
}

void set_limits(const Ladder& ladder, const StepTest& test, Side& side) {
  if (side.trajectory.status != Status::kOk) return leave_limits("the run did not end well", side);
  const StepLevel &half = ladder[1], &quarter = ladder[2];
  if (!half.failed.empty()) return leave_limits(half.failed, side);
  const bool two = !needs_quarter(side, half, test);
  if (!two && !quarter.failed.empty()) return leave_limits(quarter.failed, side);
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& f = figures()[k];
    const double at_whole = f.value(side.metrics), at_half = f.value(half.metrics);
    side.limits.push_back(
        two ? limit_of_two(at_whole, at_half,
                           reason_for_no_limit(step_change(k, side.metrics, half.metrics, test)))
            : extrapolate({at_whole, at_half, f.value(quarter.metrics)}));
  }
}

void leave_limits(const std::string& reason, Side& side) {
  for (const Figure& f : figures()) {
    Extrapolation e;
    e.values.fill(f.value(side.metrics));
    e.limit = e.values[0];
    e.reason = reason;
    side.limits.push_back(e);
  }
}

double timed_end(const scene::Run& run, const std::vector<const Side*>& sides) {
  constexpr int kParts = 8;
  // A step in contact costs up to twice as much as one in flight, so the mean is accurate to a
  // tenth.
  constexpr double kAbout = 0.1, kFewestSteps = 10000.0;
  // Shares of contact from 0 up to each part of the run.
  const auto contact_shares = [&](const Trajectory& t) {
    const auto &time = t.column("t"), &force = t.column("normal_force");
    std::vector<double> shares(kParts + 1);
    std::size_t row = 0, touching = 0;
    for (int part = 1; part <= kParts; ++part) {
      for (; row < time.size() && time[row] <= run.end * part / kParts; ++row) {
        touching += force[row] != 0.0;
      }
      shares[static_cast<std::size_t>(part)] =
          static_cast<double>(touching) / static_cast<double>(std::max<std::size_t>(row, 1));
    }
    return shares;
  };
  std::vector<std::vector<double>> of_sides;
  for (const Side* side : sides) {
    const Trajectory& t = side->trajectory;
    if (t.status == Status::kOk && t.has("normal_force")) of_sides.push_back(contact_shares(t));
  }
  for (int part = 1; part < kParts; ++part) {
    const double end = run.end * part / kParts;
    if (end < kFewestSteps * run.step) continue;
    if (std::ranges::all_of(of_sides, [&](const std::vector<double>& shares) {
          return std::abs(shares[static_cast<std::size_t>(part)] - shares.back()) <= kAbout;
        }))
      return end;
  }
  return run.end;
}

void time_runs(Runner& runner, const std::vector<ComparedEngine>& all, int repeats,
               std::shared_ptr<const CommandRecord> commands) {
  std::vector<const Side*> sides;
  for (const ComparedEngine& who : all) sides.push_back(who.side);
  const double end = timed_end(runner.scene().run, sides);
  for (int pass = 0; pass < repeats; ++pass) {
    for (const ComparedEngine& who : all) {
      if (runner.interrupted() || who.side->trajectory.status != Status::kOk) continue;
      const Trajectory t = runner.timed(who, end, who.model ? nullptr : commands);
      if (t.steps > 0 && t.status == Status::kOk) {
        who.side->timing.us_per_step.push_back(1e6 * t.wall_s / static_cast<double>(t.steps));
      }
    }
  }
  for (const ComparedEngine& who : all) finish(*who.side);
}

bool has_commands(const scene::Scene& scene) {
  return scene.first().controller && prepare(scene).first().controller != nullptr;
}

std::vector<double> replay_floor(Runner& runner, const scene::Scene& scene) {
  std::vector<double> floor(figures().size(), 0.0);
  if (scene.first().actuator && scene.first().actuator->coil_lag > 0.0) return floor;
  const auto event = native_engine(scene::Integrator::kEvent);
  const auto run = [&](const Engine& engine, RunRequest request) {
    return runner.run(engine, std::move(request), kNativeWork, "replay of the native model");
  };
  // One row per step.
  RunRequest every;
  every.output_times.emplace();
  const double h = scene.run.step;
  for (int k = 0; k * h <= scene.run.end * (1.0 + 1e-12); ++k) every.output_times->push_back(k * h);
  Trajectory stepped;
  try {
    stepped = run(*native_engine(scene::Integrator::kVerlet), every);
  } catch (const scene::SceneError&) {
    return floor;
  }
  if (stepped.status != Status::kOk) return floor;
  const auto facts = contact_facts(scene);
  const Metrics closed = metrics(run(*event, every), facts);
  every.commands = commands_of(stepped, h);
  const Metrics open = metrics(run(*event, every), facts);
  for (std::size_t k = 0; k < floor.size(); ++k) {
    const Figure& f = figures()[k];
    const double apart = std::abs(deviation(f, f.value(closed), f.value(open)));
    if (std::isfinite(apart)) floor[k] = apart;
  }
  return floor;
}

ShadowColumn shadow_column(Runner& runner, const Side& native,
                           std::shared_ptr<const CommandRecord> commands,
                           const CompareOptions& options) {
  ShadowColumn column;
  column.driven = commands != nullptr;
  RunRequest request;
  request.commands = std::move(commands);
  try {
    column.side =
        runner.shown({"shadow", native_engine(scene::Integrator::kVerlet), kNativeWork}, request);
  } catch (const scene::SceneError& error) {
    column.absent = error.what();
    return column;
  }
  if (column.side->trajectory.status != Status::kOk) {
    const Trajectory& t = column.side->trajectory;
    column.absent = fmt::format("it ended early ({}): {}", to_string(t.status), t.message);
    column.side.reset();
    return column;
  }
  for (const Figure& f : figures()) {
    column.figures.push_back(
        judged(f, f.value(native.metrics), f.value(column.side->metrics), options.tolerance));
  }
  return column;
}

}  // namespace rotorub
