#include "compare/bench/event_engine.h"

#include <algorithm>

#include "native_model/run/run_native.h"

namespace rotorub::bench {
namespace {

class EventEngine final : public Engine {
 public:
  explicit EventEngine(const EventParameters& parameters) : parameters_(parameters) {}
  std::string name() const override { return "native-event"; }
  Trajectory run(const scene::Scene& scene, const RunRequest& request) const override {
    NativeOptions options;
    options.integrator = scene::Integrator::kEvent;
    options.event = parameters_;
    options.output_times = request.output_times;
    options.progress = request.progress;
    options.interrupt = request.interrupt;
    return run_native(perturbed(scene, request.perturbation_ulps), options);
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
