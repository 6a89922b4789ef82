#include "compare/study/replay.h"

#include <cmath>

#include "native_model/scene/diagnostic.h"
#include "native_model/system/model.h"

namespace rotorub {
namespace {

// A row at every step; each command acts about its instant.
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

bool has_commands(const scene::Scene& scene) {
  return scene.first().controller && make_model(scene).first().controller != nullptr;
}

std::vector<double> replay_floor(Runner& runner, const scene::Scene& scene) {
  std::vector<double> floor(figures().size(), 0.0);
  if (scene.first().actuator && scene.first().actuator->coil_lag > 0.0) return floor;
  const auto event = native_engine(scene::Integrator::kEvent);
  const auto run = [&](const Engine& engine, RunRequest request) {
    return runner.run(engine, std::move(request), kNativeWork, "replay of the native model");
  };
  // Rows at the steps alone.
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

StepWatch CommandTape::watch() {
  return [this](const WatchedStep& step) { add(step); };
}

}  // namespace rotorub
