#include "compare/tune/errors.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "compare/engine/engine.h"
#include "compare/study/split.h"

namespace rotorub::tune {
namespace {

// A part of a difference on the scale of its figure.
std::optional<double> share(const Figure& f, double native, double part) {
  const double apart = deviation(f, native, native + part);
  return std::isfinite(apart) ? std::optional(apart) : std::nullopt;
}

}  // namespace

void split_errors(const Setting& setting, const Runner& run, References& references,
                  ErrorParts& parts) {
  std::array<Metrics, 3> own, native;
  for (std::size_t k = 0; k < own.size(); ++k) {
    Setting finer = setting;
    finer.step /= std::pow(2.0, static_cast<double>(k));
    const Outcome outcome = run(finer);
    if (!outcome.failure.empty()) {
      parts.contact.reason = parts.step.reason =
          fmt::format("{} did not end well: {}", text(finer), outcome.failure);
      return;
    }
    own[k] = outcome.metrics;
    native[k] = references.at(finer.step).metrics;
  }
  for (const Figure& f : figures()) {
    if (!f.is_judged()) continue;
    const auto limit = [&](const std::array<Metrics, 3>& m) {
      return extrapolate({f.value(m[0]), f.value(m[1]), f.value(m[2])});
    };
    const Split s = split(limit(native), limit(own));
    const double value = f.value(native[0]);
    parts.contact.figures.emplace_back(&f, s.valid ? share(f, value, s.model_gap) : std::nullopt);
    parts.step.figures.emplace_back(
        &f, s.valid ? share(f, value, s.step_error - s.native_step_error) : std::nullopt);
  }
}

ErrorPart mode_errors(const bench::SceneReader& reader, int modes,
                      const std::atomic<bool>* interrupt) {
  ErrorPart part;
  const auto engine = native_engine(scene::Integrator::kEvent);
  const auto run = [&](const std::vector<std::string>& further) {
    const scene::Scene scene = reader(further);
    RunRequest request;
    request.output_times = std::vector<double>{scene.run.end};
    request.interrupt = interrupt;
    const Trajectory t = engine->run(scene, request);
    if (t.status != Status::kOk) throw std::runtime_error(t.message);
    return metrics(t, std::nullopt);
  };
  try {
    const Metrics own = run({});
    const Metrics more =
        run({"rotor.max_frequency=none", fmt::format("rotor.modes={}", 2 * modes)});
    for (const Figure& f : figures()) {
      if (!f.is_judged()) continue;
      const double apart = deviation(f, f.value(more), f.value(own));
      part.figures.emplace_back(&f, std::isfinite(apart) ? std::optional(apart) : std::nullopt);
    }
  } catch (const std::exception& error) {
    part.reason = fmt::format("no run with {} modes: {}", 2 * modes, error.what());
  }
  return part;
}

}  // namespace rotorub::tune
