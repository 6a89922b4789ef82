#include "native_model/integrate/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "native_model/integrate/command.h"
#include "native_model/integrate/event.h"
#include "native_model/integrate/paper.h"
#include "native_model/system/actuation.h"
#include "native_model/system/run_size.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {
namespace {

void record_mode_change(Recorder& recorder, double t, Mode before, const PaperStep& step) {
  if (step.impact) {
    recorder.add(step.detail);
    recorder.add(Event{step.detail.t, EventKind::kImpact});
  }
  if (step.mode == before) return;
  const EventKind kind = step.mode == Mode::kSlide   ? EventKind::kSlide
                         : step.mode == Mode::kStick ? EventKind::kStick
                                                     : EventKind::kLiftOff;
  recorder.add(Event{t, kind});
}

const char* reason(Status status) {
  switch (status) {
    case Status::kDiverged: return "the state is no longer finite";
    case Status::kNoSolution: return "the contact laws have no solution (Painleve)";
    case Status::kAmbiguous: return "the contact laws have several solutions (Painleve)";
    case Status::kInterrupted: return "interrupted";
    default: return "";
  }
}

Trajectory run_paper(const Model& model, const scene::Run& run, double step,
                     const NativeOptions& options) {
  Recorder recorder(model, options.output_times.value_or(output_times(run)));
  State state = initial_state(model);
  PaperStepper stepper(model, step, state);
  Command command(model);
  recorder.begin({0.0, state.q.data(), state.v.data(), 0.0, 0.0, Mode::kFree,
                  actuator_state(model, state.q.data(), state.v.data(),
                                 command.at(0.0, state.q.data(), state.v.data()))});

  const auto steps = static_cast<std::int64_t>(std::ceil(run.end / step - 1e-9));
  Status status = Status::kOk;
  std::string message = step_refusal(model, step);
  if (!message.empty()) status = Status::kStepTooLarge;
  std::int64_t k = 0;
  Mode mode = Mode::kFree;
  const auto start = std::chrono::steady_clock::now();
  for (; k < steps && status == Status::kOk; ++k) {
    const double t = static_cast<double>(k) * step, next = static_cast<double>(k + 1) * step;
    const Eigen::Vector2d& u = command.at(t, stepper.q(), stepper.v());
    const PaperStep done = stepper.step(k, u);
    if (done.status != Status::kOk) {
      status = done.status;
      break;
    }
    state.t = next;
    record_mode_change(recorder, state.t, mode, done);
    mode = done.mode;
    // An impact's impulse is no force of lasting contact.
    const double scale = done.impact ? 0.0 : 1.0 / step;
    recorder.step({state.t, stepper.q(), stepper.v(), done.normal_impulse * scale,
                   done.friction_impulse * scale, mode,
                   actuator_state(model, stepper.q(), stepper.v(), u)},
                  done.normal_impulse, done.friction_impulse, done.impact);
    if ((k & 0xfff) == 0) {
      if (options.interrupt && options.interrupt->load(std::memory_order_relaxed)) {
        status = Status::kInterrupted;
      }
      if (options.progress) options.progress(static_cast<double>(k) / static_cast<double>(steps));
    }
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  Trajectory out = recorder.finish(status == Status::kOk ? run.end : state.t);
  out.engine = "native";
  out.integrator = "paper";
  out.contact_model = "rigid";
  out.step = step;
  out.steps = k;
  out.wall_s = wall.count();
  out.status = status;
  if (message.empty() && status != Status::kOk) {
    message = std::string(reason(status)) + " at t = " + std::to_string(state.t) + " s";
  }
  out.message = message;
  return out;
}

Trajectory run_event(const Model& model, const scene::Run& run, const NativeOptions& options) {
  Recorder recorder(model, options.output_times.value_or(output_times(run)));
  EventOptions settings;
  // Of a run without a step it is the resolution of peaks alone: never so fine that the bins take
  // longer than the run.
  constexpr double kMostBins = 1e7;
  settings.force_bin = std::max(options.step.value_or(run.step), run.end / kMostBins);
  EventIntegrator integrator(model, settings);
  const auto start = std::chrono::steady_clock::now();
  const EventIntegrator::Result result = integrator.run(
      initial_state(model), run.end, recorder, options.progress, options.interrupt);
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

}  // namespace

Trajectory run_native(const scene::Scene& scene, const NativeOptions& options) {
  const Model model = make_model(scene);
  const std::vector<double>* times = options.output_times ? &*options.output_times : nullptr;
  if (options.integrator.value_or(scene.run.integrator) == scene::Integrator::kEvent) {
    check_run_size(scene, model, std::nullopt, times);
    return run_event(model, scene.run, options);
  }
  const double step = options.step.value_or(scene.run.step);
  check_run_size(scene, model, step, times);
  return run_paper(model, scene.run, step, options);
}

}  // namespace rotorub
