// The figures that runs are compared by: one list that the table, the JSON, the page and the split
// into model gap and step error all go by.
#pragma once

#include <span>
#include <string>

#include "compare/metrics/metrics.h"

namespace rotorub {

// How the difference of two values is judged and written.
enum class Scale {
  kRelative,  // difference / value of the native side
  kPoints     // difference itself: shares of time, in points
};

// Whether the tolerance is on a figure, and what it tells.
enum class Judged {
  kNo,
  kAverage,  // of the whole run: what a machine's bearings and heat feel
  kPeak      // of single moments: what an impact does
};

struct Figure {
  const char* key;    // in JSON
  const char* label;  // in tables
  const char* unit;   // of the value as written
  double per_unit;    // written value = value in SI * per_unit
  Scale scale;
  Judged judged;
  bool split;           // converges with the step: split into model gap and step error
  bool comparable;      // means the same for a soft and for a rigid contact: has a difference
  const char* meaning;  // one sentence
  double (*value)(const Metrics&);  // not a number: the run has no such figure
  // SI, kRelative: a difference is relative to the native value, or to this where that is smaller.
  // Of a count: one more or less among up to so many is 1 / resolution.
  double resolution = 0.0;

  bool is_judged() const { return judged != Judged::kNo; }
};

std::span<const Figure> figures();
// Asserts that the key is one of the list.
const Figure& figure(const std::string& key);

// Difference on the scale of a figure, as a share (0.01: 1 % or 1 point); relative ones are
// positive where the magnitude grows, 0 for two zeros, infinite where the native value alone is 0
// and the figure has no resolution.
double deviation(const Figure& figure, double native, double other);
// A size in SI on the same scale, beside a native value; >= 0.
double share_of(const Figure& figure, double native, double size);

}  // namespace rotorub
