#include "compare/study/trust.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ranges>

#include "compare/base/format.h"
#include "compare/figures/figure.h"

namespace rotorub {
namespace {

std::vector<JudgedFigure> those(const std::vector<JudgedFigure>& figures, FigureVerdict verdict) {
  std::vector<JudgedFigure> found;
  std::copy_if(figures.begin(), figures.end(), std::back_inserter(found),
               [&](const JudgedFigure& f) { return f.verdict == verdict; });
  return found;
}

// "mean normal force +0.52 %, hard impacts -29 %": the texts of all figures.
template <class Text>
std::string listed(const std::vector<JudgedFigure>& figures, Text text) {
  return fmt::format("{}", fmt::join(figures | std::views::transform(text), ", "));
}

struct FigureWords {
  const char* word;
  Tone tone;
};
// In the order of FigureVerdict.
constexpr FigureWords kFigureWords[] = {{"not judged", Tone::kPlain},
                                        {"undecidable", Tone::kPart},
                                        {"within", Tone::kGood},
                                        {"outside", Tone::kBad}};
// In the order of Trust.
constexpr VerdictWords kVerdictWords[] = {{"yes", Tone::kGood},
                                          {"averages only", Tone::kPart},
                                          {"no", Tone::kBad},
                                          {"undecidable", Tone::kPart}};

}  // namespace

const char* to_string(FigureVerdict verdict) {
  return kFigureWords[static_cast<int>(verdict)].word;
}
Tone tone_of(FigureVerdict verdict) { return kFigureWords[static_cast<int>(verdict)].tone; }

const VerdictWords& words_of(Trust trust) { return kVerdictWords[static_cast<int>(trust)]; }
const char* to_string(Trust trust) { return words_of(trust).word; }

JudgedFigure judged(const Figure& figure, const FigureSample& native, const FigureSample& other,
                    double tolerance) {
  JudgedFigure f{&figure, native.value, other.value, deviation(figure, native.mean, other.mean)};
  f.native_mean = native.mean;
  f.difference = other.mean - native.mean;
  if (f.is_absent()) f.deviation = f.difference = 0.0;
  const Interval c = interval(native, other);
  f.interval = std::max(native.replay_floor, share_of(figure, native.mean, c.half));
  f.least_detectable = std::max(f.interval, share_of(figure, native.mean, c.least_detectable));
  const bool nothing = native.mean == 0.0 && other.mean == 0.0;
  if (!figure.is_judged() || f.is_absent() || nothing) return f;
  const double d = std::abs(f.deviation);
  // Not `d - c > e`, so that NaN counts as outside.
  f.verdict = d + f.interval <= tolerance      ? FigureVerdict::kWithin
              : !(d - f.interval <= tolerance) ? FigureVerdict::kOutside
                                               : FigureVerdict::kUndecidable;
  if (figure.scale == Scale::kCount && f.verdict == FigureVerdict::kOutside &&
      std::abs(other.mean - native.mean) <= 1.0) {
    f.verdict = FigureVerdict::kUndecidable;
    f.least_detectable = std::max(f.least_detectable, share_of(figure, native.mean, 2.0));
  }
  return f;
}

JudgedFigure judged(const Figure& figure, double native, double other, double tolerance) {
  return judged(figure, FigureSample{native, native}, FigureSample{other, other}, tolerance);
}

bool JudgedFigure::is_absent() const { return std::isnan(native) || std::isnan(other); }

bool JudgedFigure::is_in_units() const {
  return rotorub::is_in_units(*figure, native) || rotorub::is_in_units(*figure, native_mean);
}

bool is_settled(const JudgedFigure& figure, double tolerance) {
  if (figure.verdict == FigureVerdict::kNotJudged) return true;
  return figure.interval <= 0.5 * std::abs(std::abs(figure.deviation) - tolerance);
}

std::string deviation_text(const JudgedFigure& f) {
  return f.is_in_units() && f.figure->comparable ? change_text(*f.figure, f.difference)
                                                 : deviation_text(*f.figure, f.deviation);
}

std::string size_text(const JudgedFigure& f, double size) {
  const bool shown = rotorub::is_in_units(*f.figure, f.native);
  return size_text(*f.figure, shown ? f.native : f.native_mean, size);
}

std::string difference_text(const JudgedFigure& f) {
  if (f.is_absent()) return "–";
  if (f.is_in_units() && f.native != f.other) {
    const std::string unit = *f.figure->unit ? std::string(" ") + f.figure->unit : std::string();
    return fmt::format("{}{} instead of {}", figure_value(*f.figure, f.other), unit,
                       figure_value(*f.figure, f.native));
  }
  const std::string text = deviation_text(f);
  return f.interval >= 5e-5 ? text + " ± " + size_text(f, f.interval) : text;
}

namespace {

// Two significant digits without an exponent: "630", "16", "1.6".
std::string two_digits(double value) {
  const double unit = value > 0.0 ? std::pow(10.0, std::floor(std::log10(value)) - 1.0) : 1.0;
  return fmt::format("{:.10g}", std::round(value / unit) * unit);
}

}  // namespace

std::string plain_difference(const JudgedFigure& f) {
  constexpr double kTimes = 2.0;   // larger ratios are written as a factor,
  constexpr double kWhole = 10.0;  // and even larger ones as a whole number
  const Figure& figure = *f.figure;
  const double ratio = std::abs(1.0 + f.deviation);  // of the means, as in the table
  const bool small = f.is_in_units() || f.native == 0.0;
  if (figure.scale == Scale::kPoints || small || f.other == 0.0) {
    const auto value = [&](double v) {
      const double shown = figure.per_unit * v;
      return figure.scale == Scale::kPoints ? fmt::format("{:.3g}", std::round(10.0 * shown) / 10.0)
                                            : short_number(shown);
    };
    const std::string unit = *figure.unit ? std::string(" ") + figure.unit : std::string();
    return fmt::format("{} {}{} instead of {}{}", figure.label, value(f.other), unit,
                       value(f.native), unit);
  }
  const std::string_view unit = figure.unit;
  const bool speed = unit == "Hz" || unit == "rad/s";
  const std::string turned = f.other * f.native < 0.0 ? " and the other way round" : "";
  if (ratio >= kTimes) {
    // As deviation_text() writes it, so that a reader finds the same number in the table.
    const std::string times = ratio < kWhole ? two_digits(ratio) : short_number(std::round(ratio));
    return fmt::format("{} {} times as {}{}", figure.label, times, speed ? "fast" : "large",
                       turned);
  }
  const char* way = ratio > 1.0 ? (speed ? "fast" : "large") : (speed ? "slow" : "small");
  return fmt::format("{} {} % too {}{}", figure.label, two_digits(100.0 * std::abs(ratio - 1.0)),
                     way, turned);
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

namespace {

// Why a figure is undecidable.
std::string detectable_text(const JudgedFigure& f) {
  const bool count = f.figure->scale == Scale::kCount;
  if (count && f.interval == 0.0 && std::abs(f.difference) <= 1.0)
    return "a difference of one cannot be judged";
  return fmt::format("{}{} would be detected", size_text(f, f.least_detectable),
                     count && f.is_in_units() ? " more or fewer" : "");
}

}  // namespace

std::string why(const std::vector<JudgedFigure>& figures, double tolerance) {
  std::string text = listed(outside(figures), [](const JudgedFigure& f) {
    return fmt::format("{} {}", f.figure->label, difference_text(f));
  });
  const auto add = [&](const char* verdict, const std::string& list) {
    if (list.empty()) return;
    text += fmt::format("{}{} {}: {}", text.empty() ? "" : "; ", verdict, percent_text(tolerance),
                        list);
  };
  add("within", listed(those(figures, FigureVerdict::kWithin),
                       [](const JudgedFigure& f) { return f.figure->label; }));
  add("undecidable at", listed(undecidable(figures), [](const JudgedFigure& f) {
        return fmt::format("{} {} ({})", f.figure->label, difference_text(f), detectable_text(f));
      }));
  return text;
}

}  // namespace rotorub
