// Distributions of the values of a key in a study that draws them.
#pragma once

#include <limits>
#include <optional>
#include <string>

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

// All parameters of distributions as keys of a [[vary]], and the names of the distributions for
// messages.
inline constexpr const char* kDistributionKeys[] = {"mean", "deviation", "median", "log_deviation",
                                                    "mode", "scale",     "shape"};
std::string distribution_words();

// Reads `distribution` and its parameters from a [[vary]], in the unit of the key. Empty if there
// is none, or if it is wrong and was reported.
std::optional<Distribution> read_distribution(const StudyTable& table,
                                              const scene::Quantity& quantity);

}  // namespace rotorub::sweep
