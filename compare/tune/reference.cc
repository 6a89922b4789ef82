#include "compare/tune/reference.h"

#include <fmt/format.h>

#include <stdexcept>

#include "compare/engine/engine.h"
#include "compare/metrics/rows.h"
#include "compare/study/trust.h"
#include "compare/study/twins.h"

namespace rotorub::tune {

const Reference& References::at(double step, double window_step) {
  const std::pair key(step, window_step);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  scene::Scene scene = scene_;
  scene.run.step = window_step;
  const auto engine = native_engine(scene::Integrator::kEvent);
  RunRequest request;
  request.step = step;
  request.output_times = dense_times(scene.run, kRows);
  request.interrupt = interrupt_;
  const Trajectory original = engine->run(scene, request);
  if (original.status != Status::kOk && original.status != Status::kInterrupted) {
    throw std::runtime_error(
        fmt::format("{}: the native model, which settings are judged against, ended early ({}): {}",
                    scene_.name, rotorub::to_string(original.status), original.message));
  }
  Reference reference{metrics(original, std::nullopt), {}};

  TwinParameters parameters;
  parameters.count = twins_;
  parameters.step = step;
  parameters.output_times = *request.output_times;
  parameters.interrupt = interrupt_;
  const double threshold = kDivergenceShare * scene_.first().contact->clearance;
  const Twins twins = run_twins(*engine, scene, original, threshold, parameters);
  for (const Figure& f : figures())
    reference.samples.push_back(figure_sample(f, reference.metrics, twins.metrics));
  return known_.emplace(key, std::move(reference)).first->second;
}

}  // namespace rotorub::tune
