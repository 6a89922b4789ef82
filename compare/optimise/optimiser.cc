#include "compare/optimise/optimiser.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <nlopt.hpp>

#include "compare/engine/engine.h"
#include "compare/figures/figure.h"
#include "compare/metrics/metrics.h"
#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/result/result.h"
#include "compare/run_files/summary.h"
#include "compare/sweep/point_run.h"
#include "compare/sweep/sample.h"
#include "compare/sweep/study_reader.h"

namespace rotorub::optimise {
namespace {

using nlohmann::json;

struct Stopped {};  // interrupted by the user

// The key's start as a fraction of the way from `from` to `to`.
double start_share(const sweep::Vary& vary) {
  if (!vary.start) return 0.5;
  if (vary.spacing == sweep::Spacing::kLinear)
    return (*vary.start - vary.from) / (vary.to - vary.from);
  return std::log(*vary.start / vary.from) / std::log(vary.to / vary.from);
}

class Search {
 public:
  Search(const Task& task, const scene::Variants& variants, const OptimiserOptions& options)
      : task_(task), variants_(variants), options_(options) {}

  Optimum run() {
    std::vector<double> at;
    for (const sweep::Vary& vary : task_.study.vary) at.push_back(start_share(vary));
    const int all = task_.goal.evaluations;
    // Throws if the start is refused, because the study is then wrong.
    scene_of(task_, variants_, values_of(at), false);
    if (task_.goal.algorithm != Algorithm::kDirect) {
      constexpr nlopt::algorithm kAlgorithms[] = {nlopt::LN_COBYLA, nlopt::LN_BOBYQA,
                                                  nlopt::LN_NELDERMEAD, nlopt::LN_SBPLX};
      search(kAlgorithms[static_cast<int>(task_.goal.algorithm)], at, all);
      return std::move(out_);
    }
    const bool constrained = !task_.goal.constraints.empty();
    search(constrained ? nlopt::GN_ORIG_DIRECT_L : nlopt::GN_DIRECT_L, at, std::max(1, all / 2));
    if (out_.best) at = shares_[*out_.best];
    if (out_.ending != Ending::kInterrupted) search(nlopt::LN_COBYLA, at, all);
    return std::move(out_);
  }

 private:
  // Stops after `most` evaluations in total.
  void search(nlopt::algorithm algorithm, std::vector<double> at, int most) {
    constexpr double kFirstStep = 0.1;  // relative to the range
    if (static_cast<int>(out_.evaluations.size()) >= most) {
      out_.ending = Ending::kEvaluations;
      return;
    }
    most_ = most;
    nlopt::opt nlopt(algorithm, static_cast<unsigned>(at.size()));
    nlopt.set_lower_bounds(0.0);
    nlopt.set_upper_bounds(1.0);
    using Point = std::vector<double>;
    nlopt.set_min_objective([](const Point& x, Point&,
                               void* search) { return static_cast<Search*>(search)->objective(x); },
                            this);
    std::vector<Call> calls;
    for (std::size_t k = 0; k < task_.goal.constraints.size(); ++k) calls.push_back({this, k});
    for (Call& call : calls) {
      nlopt.add_inequality_constraint(
          [](const Point& x, Point&, void* data) {
            const auto& [search, k] = *static_cast<Call*>(data);
            return search->constraint(k, x);
          },
          &call, Optimum::kFeasible);
    }
    nlopt.set_xtol_abs(task_.goal.tolerance);
    nlopt.set_initial_step(kFirstStep);
    double least = 0.0;
    try {
      nlopt.optimize(at, least);
      out_.ending = Ending::kConverged;
    } catch (const nlopt::forced_stop&) {
      out_.ending = interrupted_ ? Ending::kInterrupted : Ending::kEvaluations;
    } catch (const nlopt::roundoff_limited&) {
      out_.ending = Ending::kRoundoff;
    }
  }

  // The objective and the constraints of NLopt: positive constraints are violated.
  double objective(const std::vector<double>& x) {
    const Evaluation& e = at(x);
    return e.figure ? sign() * *e.figure : penalty();
  }
  double constraint(std::size_t k, const std::vector<double>& x) {
    const std::optional<double>& value = at(x).constraints[k];
    return value ? excess(k, *value) : 1.0;
  }
  struct Call {
    Search* search;
    std::size_t constraint;
  };

  double sign() const { return task_.goal.maximise ? -1.0 : 1.0; }
  // Positive if violated; relative to the limit.
  double excess(std::size_t k, double value) const {
    const Constraint& c = task_.goal.constraints[k];
    const double size = c.limit == 0.0 ? 1.0 : std::abs(c.limit);
    return (c.is_max ? value - c.limit : c.limit - value) / size;
  }
  // The objective of a point without a result: worse than every result so far, but finite, because
  // the algorithms fit linear models through it.
  double penalty() const {
    double low = 0.0, high = 0.0;
    bool any = false;
    for (const Evaluation& e : out_.evaluations) {
      if (!e.figure) continue;
      const double value = sign() * *e.figure;
      low = any ? std::min(low, value) : value;
      high = any ? std::max(high, value) : value;
      any = true;
    }
    return any ? high + (high - low) + 0.1 * std::abs(high) : 1.0;
  }

  std::vector<double> values_of(const std::vector<double>& shares) const {
    std::vector<double> values;
    for (std::size_t k = 0; k < shares.size(); ++k)
      values.push_back(sweep::between(task_.study.vary[k], shares[k]));
    return values;
  }

  // NLopt calls the objective and each constraint separately, so the point is run once and
  // remembered.
  const Evaluation& at(const std::vector<double>& shares) {
    if (const auto found = known_.find(shares); found != known_.end())
      return out_.evaluations[found->second];
    if (static_cast<int>(out_.evaluations.size()) >= most_) throw nlopt::forced_stop();
    try {
      out_.evaluations.push_back(evaluate(values_of(shares)));
    } catch (const Stopped&) {
      interrupted_ = true;
      throw nlopt::forced_stop();  // the only exception that passes through NLopt
    }
    known_[shares] = shares_.size();
    shares_.push_back(shares);
    keep_best();
    if (options_.progress) options_.progress(out_);
    return out_.evaluations.back();
  }

  void keep_best() {
    const Evaluation& last = out_.evaluations.back();
    if (!last.figure || last.violation > Optimum::kFeasible) return;
    if (!out_.best || sign() * *last.figure < sign() * *out_.evaluations[*out_.best].figure)
      out_.best = out_.evaluations.size() - 1;
  }

  // Runs the scene; returns its figures and the rest of its summary.
  json run_json(const scene::Scene& scene, Evaluation& out) const {
    RunRequest request;
    request.interrupt = options_.interrupt;
    const Trajectory run = sweep::engine_of(task_.study, scene)->run(scene, request);
    if (run.status == Status::kInterrupted) throw Stopped();
    if (run.status != Status::kOk) {
      out.status = rotorub::to_string(run.status);
      out.reason = run.message;
      return nullptr;
    }
    return summary_json(scene, run);
  }

  Evaluation evaluate(const std::vector<double>& values) const {
    if (options_.interrupt && *options_.interrupt) throw Stopped();
    Evaluation out;
    out.values = values;
    out.status = "ok";
    out.constraints.resize(task_.goal.constraints.size());
    const Goal& goal = task_.goal;
    const bool mujoco = task_.study.engine == sweep::EngineKind::kMujoco;
    const auto refuse = [&](std::string reason) {
      out.status = sweep::kRefused;
      out.reason = std::move(reason);
    };
    const auto refused = sweep::refusal_of([&] {
      const scene::Scene scene = scene_of(task_, variants_, values, mujoco);
      json run, modes;
      if (goal.needs(Source::kModes))
        modes = result::json_of(modes_result("", analyse_rotor(scene, {})));
      if (goal.needs(Source::kRun)) run = run_json(scene, out);
      if (!out.ok()) return;
      const auto value = [&](const FigurePath& figure, bool largest) {
        const auto found =
            figure_value(figure, figure.source == Source::kRun ? run : modes, largest);
        if (!found) refuse("has no number `" + figure.text + "`");
        return found;
      };
      out.figure = value(goal.figure, !goal.maximise);
      for (std::size_t k = 0; k < goal.constraints.size(); ++k) {
        out.constraints[k] = value(goal.constraints[k].figure, goal.constraints[k].is_max);
        if (out.constraints[k])
          out.violation = std::max(out.violation, excess(k, *out.constraints[k]));
      }
    });
    if (refused) refuse(*refused);
    if (!out.ok()) out.figure.reset();
    return out;
  }

  const Task& task_;
  const scene::Variants& variants_;
  const OptimiserOptions& options_;
  Optimum out_;
  std::map<std::vector<double>, std::size_t> known_;  // keyed by the shares of the keys
  std::vector<std::vector<double>> shares_;           // of each evaluation
  int most_ = 0;
  bool interrupted_ = false;
};

}  // namespace

const char* to_string(Ending ending) {
  switch (ending) {
    case Ending::kConverged:
      return "converged";
    case Ending::kEvaluations:
      return "evaluations used up";
    case Ending::kRoundoff:
      return "ended by round-off";
    case Ending::kInterrupted:
      break;
  }
  return "interrupted";
}

scene::Scene scene_of(const Task& task, const scene::Variants& variants,
                      const std::vector<double>& values, bool with_text) {
  std::vector<sweep::Value> all;
  for (const double value : values) all.push_back({sweep::number_text(value), value});
  return variants.scene(sweep::changes_of(task.study, all), with_text);
}

Optimum optimise(const Task& task, const scene::Variants& variants,
                 const OptimiserOptions& options) {
  return Search(task, variants, options).run();
}

}  // namespace rotorub::optimise
