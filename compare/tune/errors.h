// What a trusted setting is wrong by, and whose fault each part is.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/tune/search.h"

namespace rotorub::tune {

// As shares of the native value (points: as they are), one for each judged figure; none where it
// cannot be determined.
struct ErrorPart {
  std::vector<std::pair<const Figure*, std::optional<double>>> figures;
  std::string reason;  // why there is nothing at all; empty: there is
};

struct ErrorParts {
  ErrorPart contact;  // the contact model's: what remains as the step goes to 0
  ErrorPart step;     // what vanishes with it
};

// By runs at the step, a half and a quarter of it (compare/metrics/extrapolation.h).
void split_errors(const Setting& setting, const Runner& run, References& references,
                  ErrorParts& parts);

}  // namespace rotorub::tune
