#include "compare/bench/event_engine.h"

#include <algorithm>
#include <chrono>

#include "native_model/event/driver.h"
#include "native_model/system/run_size.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::bench {
namespace {

class EventEngine final : public Engine {
 public:
  explicit EventEngine(const EventParameters& parameters) : parameters_(parameters) {}
  std::string name() const override { return "native-event"; }
  Trajectory run(const scene::Scene& given, const RunRequest& request) const override {
    const scene::Scene scene = perturbed(given, request.perturbation_ulps);
    const Model model = make_model(scene);
    const std::vector<double> times = request.output_times.value_or(output_times(scene.run));
    check_run_size(scene, model, std::nullopt, &times);
    Recorder recorder(model, times);
    EventIntegrator integrator(model, parameters_);
    const auto start = std::chrono::steady_clock::now();
    const EventIntegrator::Result result = integrator.run(
        initial_state(model), scene.run.end, recorder, request.progress, request.interrupt);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    Trajectory out = recorder.finish(result.end);
    out.engine = "native";
    out.integrator = "event";
    out.contact_model = "rigid";
    out.steps = result.steps;
    out.wall_s = wall.count();
    out.status = result.status;
    out.message = result.message;
    return out;
  }

 private:
  EventParameters parameters_;
};

}  // namespace

EventParameters event_parameters(double tolerance) {
  const EventParameters standard;
  EventParameters p;
  p.tolerance = tolerance;
  p.no_force = std::max(standard.no_force, 100.0 * tolerance);
  return p;
}

std::unique_ptr<Engine> event_engine(const EventParameters& parameters) {
  return std::make_unique<EventEngine>(parameters);
}

}  // namespace rotorub::bench
