// From figures to a verdict: pure functions of values, tolerance and the spread of twins.
//
// Twins are native runs whose starts are a few units in the last place apart. With d the deviation
// of a figure, s the spread of the twins' and e the tolerance, all on the figure's own scale:
//   |d| > max(e, s)   outside: no start that near explains it
//   else s > e        undecidable at e: the motion does not repeat itself that well
//   else              within
// What is undecidable does not decide.
#pragma once

#include <string>
#include <vector>

#include "compare/study/figure.h"

namespace rotorub {

enum class FigureVerdict { kNotJudged, kWithin, kOutside, kUndecidable };
const char* to_string(FigureVerdict verdict);

// One figure of one run against the native one.
struct JudgedFigure {
  const Figure* figure = nullptr;
  double native = 0.0, other = 0.0;  // SI
  double deviation = 0.0;            // see deviation()
  double spread = 0.0;               // of the twins, on the same scale; >= 0
  FigureVerdict verdict = FigureVerdict::kNotJudged;
};

JudgedFigure judged(const Figure& figure, double native, double other, double spread,
                    double tolerance);

// Greatest less least of a figure's values, values[0] that of the run that the others are twins of.
double spread(const Figure& figure, const std::vector<double>& values);

// What a contact model may be used for.
enum class Trust {
  kYes,           // no judged figure is outside, and one at least is within
  kAveragesOnly,  // the averages are not outside, figures of single moments are
  kNo,            // an average is outside, or a run did not end well
  kUndecidable    // nothing is outside, and nothing could be decided
};
const char* to_string(Trust trust);  // "yes", "averages only", "no", "undecidable"

Trust trust(const std::vector<JudgedFigure>& figures);

// Judged figures that are outside, the furthest first; and those that are undecidable.
std::vector<JudgedFigure> outside(const std::vector<JudgedFigure>& figures);
std::vector<JudgedFigure> undecidable(const std::vector<JudgedFigure>& figures);

// Half a sentence that says why: "peak force -89 %, hard impacts -29 %; within 1 %: mean normal
// force, contact, total impulse".
std::string why(const std::vector<JudgedFigure>& figures, double tolerance);

}  // namespace rotorub
