#include "compare/study/three_errors.h"

#include <cassert>
#include <cmath>

namespace rotorub {
namespace {

void take(LargestError& largest, const Figure& figure, std::optional<double> share) {
  if (!share || !std::isfinite(*share)) {
    ++largest.untold;
  } else if (!largest.figure || std::abs(*share) > std::abs(largest.share)) {
    largest.figure = &figure;
    largest.share = *share;
  }
}

}  // namespace

ThreeErrors three_errors(const SceneComparison& c, std::size_t side) {
  assert(side >= 1 && side < c.sides.size());
  ThreeErrors errors;
  for (const FigureDifference& d : c.differences[side - 1].figures) {
    const Figure& f = *d.figure;
    if (!f.is_judged() || !f.split) continue;
    const double native = f.value(c.reference(side).metrics);
    const auto share = [&](double part) {
      return d.split.valid ? std::optional(deviation(f, native, native + part)) : std::nullopt;
    };
    take(errors.contact, f, share(d.split.model_gap));
    take(errors.step, f, share(d.split.step_error - d.split.native_step_error));
  }
  if (c.model_error && !c.model_error->figures.empty()) {
    errors.modes.emplace();
    for (const FigureLimit& f : c.model_error->figures) take(*errors.modes, *f.figure, f.error);
  }
  return errors;
}

}  // namespace rotorub
