// The figures of a measured run, from columns of values at the same samples.
#pragma once

#include <optional>
#include <vector>

#include "compare/measured/dominant_whirl.h"
#include "compare/measured/measured_run.h"

namespace rotorub {

// A record's column on the run, and the same of each run: values at the same samples.
struct HeldColumn {
  const Measurable* what = nullptr;
  std::vector<Sample> sample;             // one a value
  std::vector<double> measured;           // SI
  std::vector<std::vector<double>> runs;  // SI, each as `measured`
};

// What every figure needs of the scene and the record.
struct FigureFacts {
  std::vector<double> t;            // s, of the samples; ascending
  double interval = 0.0;            // s
  std::optional<double> clearance;  // m; none: no contact
};

// Those that the columns support. A frequency needs kLeastTurns in the record, and is left out with a remark where a
// run's own, from its rows, is beyond kMostOfRate of the sample rate (run_frequency: Hz, signed, of the native rotor;
// 0: none).
std::vector<MeasuredFigure> figures_of(const std::vector<HeldColumn>& columns, const FigureFacts& facts,
                                       double run_frequency, std::vector<std::string>& remarks);
inline constexpr double kMostOfRate = 0.4;
// A gap below this share of the clearance counts as contact, of record and runs alike: no sensor's zero is exact.
inline constexpr double kTouchShare = 0.01;

}  // namespace rotorub
