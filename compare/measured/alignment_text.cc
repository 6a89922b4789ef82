// Alignments as text.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "compare/measured/alignment.h"

namespace rotorub {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kAsFar = 1.5;  // size ratios beyond this factor, or its inverse, are mentioned

// Avoids a negative zero.
double rounded_to(double value, double unit) { return std::round(value / unit) * unit + 0.0; }

}  // namespace

std::string channels_text(const std::vector<std::string>& by) {
  if (by.size() < 2) return fmt::format("{}", fmt::join(by, ""));
  return fmt::format("{} and {}", fmt::join(by.begin(), by.end() - 1, ", "), by.back());
}

std::string other_size_text(const LagScore& at) {
  return fmt::format(
      "at {:+.3f} ms they are more alike (correlation {:.4f}), the record {:.3g} times as large: "
      "is its unit right?",
      1e3 * at.shift, at.correlation, at.gain);
}

std::string mirrored_text(const Mirrored& m) {
  constexpr double kExchanged = 1.0;  // degrees
  const double angle = m.angle / kDegree;
  const bool exchanged = std::abs(std::abs(angle) - 90.0) < kExchanged;
  return fmt::format(
      "with {} it would fit: shift {:+.6f} ms, sensors' x axis at {:+.3f}°, left {:.3g} % of the "
      "run's rms; {} says so, if it is not the machine that whirls the other way than the run",
      exchanged ? "x and y of the sensors exchanged" : "y of the sensors mirrored",
      rounded_to(1e3 * m.shift, 1e-6), rounded_to(angle, 1e-3), 100.0 * m.residual, m.flag);
}

std::string alignment_text(const Alignment& a) {
  const auto error = [](const std::optional<double>& e, double unit, const char* name) {
    return e ? fmt::format(" ± {:.3g}{}", *e / unit, name) : std::string();
  };
  std::string text =
      fmt::format("shift {:+.6f} ms{}{}", rounded_to(1e3 * a.shift, 1e-6),
                  a.shift_found ? "" : " as given", error(a.shift_error, 1e-6, " µs"));
  text += fmt::format(", sensors' x axis at {:+.3f}°", rounded_to(a.angle / kDegree, 1e-3));
  switch (a.angle_from) {
    case AngleFrom::kGiven:
      text += " as given";
      break;
    case AngleFrom::kFound:
      text += error(a.angle_error, kDegree, "°");
      break;
    case AngleFrom::kNoPair:
      text += " taken: no x with its y is measured";
      break;
    case AngleFrom::kCircle:
      text +=
          " taken: the motion is a circle to within what is left, in which a turn of the frame "
          "looks like a shift (--measured-angle tells it)";
      break;
  }
  if (a.by.empty()) return text + "; nothing moves in both: nothing says how well it fits";
  text +=
      fmt::format("; by {}: correlation {:.4f}", channels_text(a.by), a.correlation.value_or(0.0));
  if (a.residual) text += fmt::format(", left {:.3g} % of the run's rms", 100.0 * *a.residual);
  if (a.gain && (*a.gain > kAsFar || *a.gain < 1.0 / kAsFar)) {
    text += fmt::format("; the record moves {:.3g} times as far as the run", *a.gain);
  }
  if (a.other_size) text += "; " + other_size_text(*a.other_size);
  if (a.mirrored) text += "; " + mirrored_text(*a.mirrored);
  if (a.turn_for_shift) {
    text += fmt::format(
        "; so near to a circle that {:+.3g}° of the angle make up for 10 µs of the shift: tell one "
        "of them, if it is known",
        1e-5 * *a.turn_for_shift / kDegree);
  }
  if (a.ambiguous()) {
    text += fmt::format("; ambiguous: {:+.6f} ms fits nearly as well (correlation {:.4f})",
                        1e3 * a.next->shift, a.next->correlation);
  } else if (a.next) {
    text += fmt::format("; next best {:+.3f} ms (correlation {:.3f})", 1e3 * a.next->shift,
                        a.next->correlation);
  }
  return text;
}

}  // namespace rotorub
