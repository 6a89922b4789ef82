// Distributions of the values of a key in a study that draws them.
#pragma once

#include <limits>
#include <optional>

#include "compare/sweep/study_reader.h"
#include "native_model/scene/units.h"

namespace rotorub::sweep {

enum class DistributionKind { kUniform, kNormal, kLognormal, kTriangular, kWeibull };

// Values outside of [from, to] are never drawn: the density within is scaled to integrate to 1.
struct Distribution {
  DistributionKind kind = DistributionKind::kUniform;
  // SI: mean (normal), median (lognormal), mode (triangular) or scale (weibull)
  double centre = 0.0;
  // Standard deviation, SI (normal) or of the natural logarithm (lognormal); shape (weibull), 2 for
  // a Rayleigh distribution. > 0
  double width = 1.0;
  double from = -std::numeric_limits<double>::infinity();  // SI; finite for uniform and triangular
  double to = std::numeric_limits<double>::infinity();
};

// The value below which a draw lies with probability `share` in [0, 1]. Always finite: at the ends
// the result belongs to the double nearest to 0 or 1.
double quantile(const Distribution& distribution, double share);

// Reports the parameters of distributions in a [[vary]] without `distribution`.
void refuse_parameters(const StudyTable& table);

// Reads `distribution` and its parameters from a [[vary]], in the unit of the key. Empty if it
// is absent, or if it is wrong and was reported.
std::optional<Distribution> read_distribution(const StudyTable& table,
                                              const scene::Quantity& quantity);

}  // namespace rotorub::sweep
