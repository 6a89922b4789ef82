// How the values of a key are distributed, where a study draws them.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "compare/sweep/study_reader.h"
#include "native_model/scene/units.h"

namespace rotorub::sweep {

enum class DistributionKind { kUniform, kNormal, kLognormal, kTriangular, kWeibull };

// What lies outside of [from, to] is never drawn: the density within is scaled up to 1.
struct Distribution {
  DistributionKind kind = DistributionKind::kUniform;
  double centre = 0.0;  // SI: normal's mean, lognormal's median, triangular's mode, weibull's scale
  // normal: standard deviation, SI; lognormal: that of the natural logarithm; weibull: its shape,
  // 2 of a Rayleigh distribution. > 0
  double width = 1.0;
  double from = -std::numeric_limits<double>::infinity();  // SI; finite: uniform, triangular
  double to = std::numeric_limits<double>::infinity();
};

// The value below which the share lies. share: in [0, 1], at the ends no further out than the
// nearest double to 0 or 1 makes it. Finite.
double quantile(const Distribution& distribution, double share);

// The parameters of all of them, as keys of a [[vary]]; and their words, for messages.
inline constexpr const char* kDistributionKeys[] = {"mean", "deviation", "median", "log_deviation",
                                                    "mode", "scale",     "shape"};
std::string distribution_words();

// Of a [[vary]]: `distribution` and its parameters, in the unit of the key. Nothing: there is none,
// or one that is reported.
std::optional<Distribution> read_distribution(const StudyTable& table,
                                              const scene::Quantity& quantity);

}  // namespace rotorub::sweep
