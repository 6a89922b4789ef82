// From figures to a verdict, as pure functions of the values, the tolerance and the twins.
//
// Twins are runs whose starts differ by a few units in the last place, on both sides. With d the
// difference of the means of a figure, c half of its confidence interval (figure_sample.h) and e
// the tolerance, all on the figure's own scale:
//   |d| + c <= e   within
//   |d| - c > e    outside
//   otherwise      undecidable at e, because the motion does not repeat itself well enough
// Undecidable figures do not affect the trust. Without scatter c is 0. A figure that one of the
// runs lacks, or that is 0 in both, is not judged. Counts that differ by no more than one are never
// outside: 1 instead of 2 is undecidable, 600 instead of 601 is within 1 %.
#pragma once

#include <string>
#include <vector>

#include "compare/base/palette.h"
#include "compare/figures/figure.h"
#include "compare/figures/figure_sample.h"

namespace rotorub {

// The later of two weighs more.
enum class FigureVerdict { kNotJudged, kUndecidable, kWithin, kOutside };
const char* to_string(FigureVerdict verdict);
Tone tone_of(FigureVerdict verdict);

// One figure of a run compared with the native run.
struct JudgedFigure {
  const Figure* figure = nullptr;
  double native = 0.0, other = 0.0;  // SI, of the runs that are shown
  double deviation = 0.0;            // of the means, see deviation(); 0 if a value is absent
  double interval = 0.0;             // c, on the same scale, >= 0
  // The smallest deviation that this number of twins can resolve (figure_sample.h), at least c,
  // because a drift without scatter hides a deviation too.
  double least_detectable = 0.0;
  double native_mean = 0.0;  // SI, the value that a share is relative to
  double difference = 0.0;   // SI, of the means; 0 if a value is absent
  FigureVerdict verdict = FigureVerdict::kNotJudged;

  bool is_absent() const;    // one of the runs, or both, lack the figure
  bool is_in_units() const;  // figure.h, for the native run that is shown or the native mean
};

// c is at least native.replay_floor.
JudgedFigure judged(const Figure& figure, const FigureSample& native, const FigureSample& other,
                    double tolerance);
JudgedFigure judged(const Figure& figure, double native, double other,
                    double tolerance);  // without twins

// True if further twins would not change the verdict: the interval is at most half of the distance
// from the tolerance, or the figure is not judged.
bool is_settled(const JudgedFigure& figure, double tolerance);

// As for a figure (figure.h), in the figure's unit if is_in_units(): "+12", "0.0032 mm/s".
std::string deviation_text(const JudgedFigure& figure);
std::string size_text(const JudgedFigure& figure, double size);

// The deviation, with half of its interval if there is one: "-0.70 % ± 1.10 %". If is_in_units(),
// the values themselves: "0.157 mm/s instead of 0.196", "42 instead of 30".
std::string difference_text(const JudgedFigure& figure);

// The same for newcomers: "rms gap rate 16 times as large", "lasting contact 0 % instead of 99 %",
// "whirl 22 times as fast and the other way round".
std::string plain_difference(const JudgedFigure& figure);

// Uses for which a contact model may be trusted.
enum class Trust {
  kYes,           // no judged figure is outside, and at least one is within
  kAveragesOnly,  // the averages are not outside, but figures of single moments are
  kNo,            // an average is outside, or a run did not end well
  kUndecidable    // no figure is outside or within
};

// The words of a verdict on a contact model.
struct VerdictWords {
  const char* word;  // "averages only"
  Tone tone;
};
const VerdictWords& words_of(Trust trust);
const char* to_string(Trust trust);

Trust trust(const std::vector<JudgedFigure>& figures);

// The judged figures that are outside, in order of decreasing deviation, and the undecidable ones.
std::vector<JudgedFigure> outside(const std::vector<JudgedFigure>& figures);
std::vector<JudgedFigure> undecidable(const std::vector<JudgedFigure>& figures);

// Half a sentence with the reason: "peak force -89 %, hard impacts -29 %; within 1 %: mean normal
// force, contact, total impulse".
std::string why(const std::vector<JudgedFigure>& figures, double tolerance);

}  // namespace rotorub
