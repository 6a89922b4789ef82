#include "compare/study/trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compare/base/format.h"
#include "compare/figures/figure_text.h"

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
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", f.figure->label, difference_text(f));
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

// "; undecidable at 1 %: hard impacts -0.7 ± 1.1 % (1.6 % would be detected)".
std::string undecidable_text(const std::vector<JudgedFigure>& figures, double tolerance) {
  std::string text;
  for (const JudgedFigure& f : undecidable(figures)) {
    text += fmt::format("{}{} {} ({} would be detected)", text.empty() ? "" : ", ", f.figure->label,
                        difference_text(f), size_text(*f.figure, f.least_told));
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

Tone tone_of(Trust trust) {
  switch (trust) {
    case Trust::kYes:
      return Tone::kGood;
    case Trust::kAveragesOnly:
    case Trust::kUndecidable:
      return Tone::kPart;
    case Trust::kNo:
      break;
  }
  return Tone::kBad;
}

JudgedFigure judged(const Figure& figure, const FigureSample& native, const FigureSample& other,
                    double tolerance, double floor) {
  JudgedFigure f{&figure, native.value, other.value, deviation(figure, native.mean, other.mean)};
  if (f.is_absent()) f.deviation = 0.0;
  const Interval c = interval(native, other);
  f.interval = std::max(floor, share_of(figure, native.mean, c.half));
  f.least_told = share_of(figure, native.mean, c.least_told);
  const bool nothing = native.mean == 0.0 && other.mean == 0.0;
  if (!figure.is_judged() || f.is_absent() || nothing) return f;
  const double d = std::abs(f.deviation);
  // Not >: what is no number is outside.
  f.verdict = d + f.interval <= tolerance      ? FigureVerdict::kWithin
              : !(d - f.interval <= tolerance) ? FigureVerdict::kOutside
                                               : FigureVerdict::kUndecidable;
  return f;
}

JudgedFigure judged(const Figure& figure, double native, double other, double tolerance) {
  return judged(figure, FigureSample{native, native}, FigureSample{other, other}, tolerance);
}

bool JudgedFigure::is_absent() const { return std::isnan(native) || std::isnan(other); }

std::string difference_text(const JudgedFigure& f) {
  if (f.is_absent()) return "–";
  if (std::abs(f.native) < f.figure->resolution && f.native != f.other) {
    const std::string unit = *f.figure->unit ? std::string(" ") + f.figure->unit : std::string();
    return fmt::format("{}{} for {}", figure_value(*f.figure, f.other), unit,
                       figure_value(*f.figure, f.native));
  }
  const std::string text = deviation_text(*f.figure, f.deviation);
  return f.interval >= 5e-5 ? text + " ± " + size_text(*f.figure, f.interval) : text;
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
