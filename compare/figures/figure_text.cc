#include "compare/figures/figure_text.h"

#include <fmt/format.h>

#include <cmath>

#include "compare/base/format.h"

namespace rotorub {

std::string figure_value(const Figure& figure, double value) {
  return short_number(value * figure.per_unit);
}

std::string deviation_text(const Figure& figure, double deviation) {
  if (!figure.comparable) return "–";
  const char* unit = figure.scale == Scale::kPoints ? "pts" : "%";
  if (!std::isfinite(deviation)) return deviation > 0.0 ? "+∞" : "-∞";
  const double percent = 100.0 * deviation;
  const double size = std::abs(percent);
  if (size < 0.005) return fmt::format("0.00 {}", unit);
  if (size < 10.0) return fmt::format("{:+.2f} {}", percent, unit);
  if (figure.scale == Scale::kPoints || percent < 1000.0) {
    return fmt::format("{:+.0f} {}", percent, unit);
  }
  return "×" + short_number(std::round(1.0 + deviation));
}

std::string size_text(const Figure& figure, double size) {
  const std::string text = deviation_text(figure, size);
  return text.starts_with('+') ? text.substr(1) : text;
}

}  // namespace rotorub
