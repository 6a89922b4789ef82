// The native integrators: whole runs of `event`, a step of `verlet`, what each part of a machine
// costs, and what a mode costs. Run with --benchmark_repetitions
// and take the medians; README.md has a table.
#include <benchmark/benchmark.h>

#include <cmath>

#include "native_model/event/driver.h"
#include "native_model/prepare/prepare.h"
#include "native_model/stepping/stepper.h"
#include "native_model/trajectory/recorder.h"
#include "tests/bench/machines.h"

namespace rotorub {
namespace {

constexpr double kStep = 1e-5;  // s

// CPU time for each of `count`, s.
benchmark::Counter per(std::int64_t count) {
  return {static_cast<double>(count), benchmark::Counter::kIsRate | benchmark::Counter::kInvert};
}

// A whole run without output, to time the integration alone. The counter is per accepted step.
void event_run(benchmark::State& state, const Model& model, double end) {
  std::int64_t steps = 0;
  for (auto _ : state) {
    EventIntegrator integrator(model);
    Recorder recorder(model, {});
    const auto result = integrator.run(initial_state(model), end, recorder);
    if (result.status != Status::kOk) state.SkipWithError(result.message.c_str());
    steps += result.steps;
    benchmark::DoNotOptimize(recorder.statistics());
  }
  state.counters["per_step"] = per(steps);
  state.counters["steps"] = static_cast<double>(steps) / static_cast<double>(state.iterations());
}

// Repeats the steps of 0.1 s from the start; the set-up is not timed.
void verlet_steps(benchmark::State& state, const Model& model) {
  const std::int64_t steps = std::lround(0.1 / kStep);
  for (auto _ : state) {
    state.PauseTiming();
    VerletStepper stepper(model, kStep);
    state.ResumeTiming();
    for (std::int64_t k = 0; k < steps; ++k) {
      if (stepper.step(k).status != Status::kOk) state.SkipWithError("status");
    }
    benchmark::DoNotOptimize(stepper.q());
  }
  state.counters["per_step"] = per(state.iterations() * steps);
}

void register_all() {
  const auto add = [](const std::string& name, auto body) {
    benchmark::RegisterBenchmark(name.c_str(), body)->Unit(benchmark::kMicrosecond);
  };
  for (const std::string name : {"bench_ring", "bench_billiard", "bench_drop"}) {
    const scene::Scene scene = bench::shipped(name);
    const Model model = prepare(scene);
    const double end = scene.run.end;
    add("event/" + name, [=](benchmark::State& s) { event_run(s, model, end); });
  }
  for (const std::string name :
       {"bench_ring", "bench_billiard", "bench_drop", "paper_passive", "paper_sliding"}) {
    // The caller evaluates the controller, so its time is not in the step.
    scene::Scene scene = bench::shipped(name);
    if (name.starts_with("paper"))
      scene.forces[0].on = 0.0, scene.initial.steady = false;  // contact within 0.1 s
    const Model model = prepare(scene);
    add("verlet/" + name, [=](benchmark::State& s) { verlet_steps(s, model); });
  }
  for (const bench::Part& part : bench::parts()) {
    const Model model = part.make();
    add(std::string("parts/verlet/") + part.name,
        [=](benchmark::State& s) { verlet_steps(s, model); });
    add(std::string("parts/event/") + part.name,
        [=](benchmark::State& s) { event_run(s, model, 0.1); });
  }
  for (const int n : {2, 4, 8, 16, 32, 64}) {
    const Model model = prepare(bench::with_modes(n));
    add("modes/verlet/" + std::to_string(n), [=](benchmark::State& s) { verlet_steps(s, model); });
    add("modes/event/" + std::to_string(n), [=](benchmark::State& s) { event_run(s, model, 0.1); });
  }
}

const bool registered = (register_all(), true);

}  // namespace
}  // namespace rotorub
