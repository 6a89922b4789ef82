#include "compare/study/scene_comparison.h"

#include <algorithm>
#include <cmath>

#include "compare/study/side_difference.h"
#include "compare/study/verdict.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {
namespace {

// Work of one run at the scene's step, in units of a native one; only for the progress bar.
constexpr double kNativeWork = 1.0, kMujocoWork = 15.0;

// Runs engines one after another and keeps count of the work for the progress bar.
class Runner {
 public:
  Runner(const scene::Scene& scene, const CompareOptions& options, double total)
      : scene_(scene), options_(options), total_(total) {}

  // `work`: share of the total that this run stands for, in the units of `total`.
  Trajectory run(const Engine& engine, RunRequest request, double work, const std::string& what) {
    request.interrupt = options_.interrupt;
    if (options_.progress) {
      request.progress = [&](double share) {
        options_.progress((done_ + share * work) / total_, what);
      };
      request.progress(0.0);
    }
    Trajectory trajectory = engine.run(scene_, request);
    done_ += work;
    return trajectory;
  }
  Twins twins(const Engine& native, const Trajectory& original, double threshold,
              const std::vector<double>& times) {
    TwinParameters parameters;
    parameters.count = options_.twins;
    parameters.output_times = times;
    parameters.interrupt = options_.interrupt;
    const double work = options_.twins * kNativeWork;
    if (options_.progress) {
      parameters.progress = [&](double share) {
        options_.progress((done_ + share * work) / total_, "native twins");
      };
    }
    Twins found = run_twins(native, scene_, original, threshold, parameters);
    done_ += work;
    return found;
  }
  bool interrupted() const { return options_.interrupt && options_.interrupt->load(); }

 private:
  const scene::Scene& scene_;
  const CompareOptions& options_;
  double total_, done_ = 0.0;
};

struct Contestant {
  std::string label;
  std::unique_ptr<Engine> engine;
  double work;
};

std::vector<Contestant> contestants(const scene::Scene& scene, scene::ContactModel decides) {
  std::vector<Contestant> all;
  all.push_back({"native", native_engine(scene.run.integrator), kNativeWork});
  all.push_back({to_string(decides), mujoco_engine(decides), kMujocoWork});
  for (const auto contact :
       {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb, scene::ContactModel::kCone}) {
    if (contact == decides) continue;
    all.push_back({to_string(contact), mujoco_engine(contact), kMujocoWork});
  }
  return all;
}

RunRequest without_rows(const scene::Scene& scene) {
  RunRequest request;
  request.output_times = std::vector<double>{scene.run.end};
  return request;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

void finish(Timing& timing) {
  if (timing.us_per_step.empty()) return;
  timing.median = median(timing.us_per_step);
  const auto [low, high] =
      std::minmax_element(timing.us_per_step.begin(), timing.us_per_step.end());
  timing.lowest = *low;
  timing.highest = *high;
}

// Passes for time alone, engines in turn so that a slow spell of the machine meets all of them.
void time_runs(Runner& runner, const scene::Scene& scene, const std::vector<Contestant>& all,
               int repeats, std::vector<Side>& sides) {
  for (int pass = 0; pass < repeats; ++pass) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (runner.interrupted() || sides[k].trajectory.status != Status::kOk) continue;
      const Trajectory t =
          runner.run(*all[k].engine, without_rows(scene), all[k].work, "timing " + all[k].label);
      if (t.steps > 0 && t.status == Status::kOk) {
        sides[k].timing.us_per_step.push_back(1e6 * t.wall_s / static_cast<double>(t.steps));
      }
    }
  }
  for (Side& side : sides) finish(side.timing);
}

// The figures at dt, dt/2 and dt/4 and what they tend to.
void climb_down(Runner& runner, const scene::Scene& scene, const Contestant& who, Side& side) {
  std::array<Metrics, 3> rungs;
  rungs[0] = side.metrics;
  std::string failed = side.trajectory.status == Status::kOk ? "" : "the run did not end well";
  for (std::size_t k = 1; k < rungs.size() && failed.empty(); ++k) {
    RunRequest request = without_rows(scene);
    const double part = k == 1 ? 2.0 : 4.0;
    request.step = scene.run.step / part;
    const Trajectory t = runner.run(*who.engine, request, part * who.work,
                                    who.label + (k == 1 ? " at half the step" : " at a quarter"));
    rungs[k] = metrics(t, std::nullopt);
    if (t.status != Status::kOk) failed = "a run at a smaller step did not end well: " + t.message;
  }
  for (const Figure& f : figures()) {
    Extrapolation e;
    if (failed.empty()) {
      e = extrapolate({f.value(rungs[0]), f.value(rungs[1]), f.value(rungs[2])});
    } else {
      e.values.fill(f.value(rungs[0]));
      e.limit = e.values[0];
      e.reason = failed;
    }
    side.limits.push_back(e);
  }
}

double total_work(const std::vector<Contestant>& all, const CompareOptions& options) {
  double total = options.twins * kNativeWork;
  for (const Contestant& c : all) total += c.work * (1.0 + options.timing_repeats + 2.0 + 4.0);
  return total;
}

// Where the scene has no contact: a share of the rotor's largest deflection.
double divergence_threshold(const scene::Scene& scene, const Trajectory& native) {
  if (scene.contact) return kDivergenceShare * scene.contact->clearance;
  double largest = 0.0;
  const auto &x = native.column("rotor_x"), &y = native.column("rotor_y");
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::hypot(x[i], y[i]));
  return std::max(kDivergenceShare * largest, 1e-12);
}

}  // namespace

Status SceneComparison::status() const {
  for (std::size_t k = 0; k < std::min<std::size_t>(2, sides.size()); ++k) {
    if (sides[k].trajectory.status != Status::kOk) return sides[k].trajectory.status;
  }
  return interrupted ? Status::kInterrupted : Status::kOk;
}

bool SceneComparison::within() const {
  const auto decides = std::find_if(differences.begin(), differences.end(),
                                    [](const SideDifference& d) { return d.decides; });
  return decides != differences.end() && decides->within();
}

SceneComparison compare_scene(const scene::Scene& scene, const CompareOptions& options) {
  SceneComparison result;
  result.scene = scene;
  result.tolerance = options.tolerance;
  result.twins = options.twins;
  const auto all = contestants(scene, options.contact);
  Runner runner(scene, options, total_work(all, options));
  const auto times = dense_times(scene.run, options.rows);

  // 1. The runs that are shown: every row that plots and residuals need.
  for (const Contestant& who : all) {
    RunRequest request;
    request.output_times = times;
    Side side;
    side.label = who.label;
    side.engine = who.engine->name();
    side.trajectory = runner.run(*who.engine, request, who.work, who.label);
    side.metrics = metrics(side.trajectory, contact_facts(scene));
    result.sides.push_back(std::move(side));
    if (runner.interrupted()) {
      result.interrupted = true;
      return result;
    }
  }

  // 2. Smaller steps, twins, and clean times.
  for (std::size_t k = 0; k < all.size(); ++k) {
    climb_down(runner, scene, all[k], result.sides[k]);
  }
  result.twin.threshold = divergence_threshold(scene, result.sides[0].trajectory);
  const double threshold = result.twin.threshold;
  const Twins twins = runner.twins(*all[0].engine, result.sides[0].trajectory, threshold, times);
  result.twin = first_to_part(twins, result.twin);
  time_runs(runner, scene, all, options.timing_repeats, result.sides);
  if (runner.interrupted()) {
    result.interrupted = true;
    return result;
  }

  // 3. The differences, and why.
  const Repeatability repeats = repeatability(result.sides[0], twins);
  for (std::size_t k = 1; k < result.sides.size(); ++k) {
    SideDifference d =
        side_difference(result.sides[0], result.sides[k], repeats, options, threshold);
    d.reasons = reasons(result, result.sides[k], d);
    result.differences.push_back(std::move(d));
  }
  return result;
}

std::vector<double> dense_times(const scene::Run& run, std::size_t rows) {
  const auto steps = static_cast<std::size_t>(std::ceil(run.end / run.step - 1e-9));
  const std::size_t stride = std::max<std::size_t>(1, (steps + rows - 1) / rows);
  std::vector<double> times = output_times(run);
  for (std::size_t k = 0; k <= steps; k += stride) {
    times.push_back(std::min(run.end, static_cast<double>(k) * run.step));
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

Trajectory rows_at(const Trajectory& trajectory, const std::vector<double>& times) {
  const auto& t = trajectory.column("t");
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (std::binary_search(times.begin(), times.end(), t[i])) wanted.push_back(i);
  }
  Trajectory out = trajectory;
  for (std::size_t c = 0; c < out.series.size(); ++c) {
    const auto& values = trajectory.series[c].values;
    out.series[c].values.clear();
    for (const std::size_t i : wanted) out.series[c].values.push_back(values[i]);
  }
  return out;
}

}  // namespace rotorub
