#include "compare/study/trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compare/study/format.h"

namespace rotorub {
namespace {

std::vector<JudgedFigure> those(const std::vector<JudgedFigure>& figures, FigureVerdict verdict) {
  std::vector<JudgedFigure> found;
  std::copy_if(figures.begin(), figures.end(), std::back_inserter(found),
               [&](const JudgedFigure& f) { return f.verdict == verdict; });
  return found;
}

std::string with_deviations(const std::vector<JudgedFigure>& figures) {
  std::string text;
  for (const JudgedFigure& f : figures) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", f.figure->label,
                        deviation_text(*f.figure, f.deviation));
  }
  return text;
}

std::string labels(const std::vector<JudgedFigure>& figures) {
  std::string text;
  for (const JudgedFigure& f : figures) {
    text += (text.empty() ? "" : ", ") + std::string(f.figure->label);
  }
  return text;
}

// "; undecidable at 1 %: hard impacts (repeats to 6.8 %)".
std::string undecidable_text(const std::vector<JudgedFigure>& figures, double tolerance) {
  std::string text;
  for (const JudgedFigure& f : undecidable(figures)) {
    text += fmt::format("{}{} (repeats to {})", text.empty() ? "" : ", ", f.figure->label,
                        size_text(*f.figure, f.spread));
  }
  return text.empty() ? text : "undecidable at " + percent_text(tolerance) + ": " + text;
}

}  // namespace

const char* to_string(FigureVerdict verdict) {
  switch (verdict) {
    case FigureVerdict::kNotJudged:
      return "not judged";
    case FigureVerdict::kWithin:
      return "within";
    case FigureVerdict::kOutside:
      return "outside";
    case FigureVerdict::kUndecidable:
      return "undecidable";
  }
  return "";
}

const char* to_string(Trust trust) {
  switch (trust) {
    case Trust::kYes:
      return "yes";
    case Trust::kAveragesOnly:
      return "averages only";
    case Trust::kNo:
      return "no";
    case Trust::kUndecidable:
      return "undecidable";
  }
  return "";
}

JudgedFigure judged(const Figure& figure, double native, double other, double spread,
                    double tolerance) {
  JudgedFigure f{&figure, native, other, deviation(figure, native, other), spread};
  if (!figure.is_judged()) return f;
  // Not <=: what is no number is outside.
  const bool near = std::abs(f.deviation) <= std::max(tolerance, spread);
  f.verdict = !near                ? FigureVerdict::kOutside
              : spread > tolerance ? FigureVerdict::kUndecidable
                                   : FigureVerdict::kWithin;
  return f;
}

double spread(const Figure& figure, const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  double least = 0.0, greatest = 0.0;
  for (const double value : values) {
    const double apart = deviation(figure, values.front(), value);
    least = std::min(least, apart);
    greatest = std::max(greatest, apart);
  }
  return greatest - least;
}

Trust trust(const std::vector<JudgedFigure>& figures) {
  bool peaks = true, decided = false;
  for (const JudgedFigure& f : figures) {
    if (f.verdict == FigureVerdict::kOutside && f.figure->judged == Judged::kAverage) {
      return Trust::kNo;
    }
    peaks = peaks && f.verdict != FigureVerdict::kOutside;
    decided = decided || f.verdict == FigureVerdict::kWithin;
  }
  if (!peaks) return Trust::kAveragesOnly;
  return decided ? Trust::kYes : Trust::kUndecidable;
}

std::vector<JudgedFigure> outside(const std::vector<JudgedFigure>& figures) {
  auto found = those(figures, FigureVerdict::kOutside);
  std::stable_sort(found.begin(), found.end(), [](const JudgedFigure& a, const JudgedFigure& b) {
    return std::abs(a.deviation) > std::abs(b.deviation);
  });
  return found;
}

std::vector<JudgedFigure> undecidable(const std::vector<JudgedFigure>& figures) {
  return those(figures, FigureVerdict::kUndecidable);
}

std::string why(const std::vector<JudgedFigure>& figures, double tolerance) {
  const auto far = outside(figures), near = those(figures, FigureVerdict::kWithin);
  std::string text = with_deviations(far);
  const auto add = [&](const std::string& part) {
    if (!part.empty()) text += (text.empty() ? "" : "; ") + part;
  };
  if (!near.empty()) add("within " + percent_text(tolerance) + ": " + labels(near));
  add(undecidable_text(figures, tolerance));
  return text;
}

}  // namespace rotorub
