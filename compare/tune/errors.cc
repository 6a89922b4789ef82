#include "compare/tune/errors.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "compare/engine/engine.h"
#include "compare/metrics/extrapolation.h"

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
    const Outcome outcome = run(finer, setting.step);
    if (!outcome.failure.empty()) {
      parts.contact.reason = parts.step.reason =
          fmt::format("{} did not end well: {}", text(finer), outcome.failure);
      return;
    }
    own[k] = outcome.metrics;
    native[k] = references.at(finer.step, setting.step).metrics;
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

}  // namespace rotorub::tune
