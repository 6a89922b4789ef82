#include "compare/result/shown_units.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <span>
#include <system_error>

#include "compare/base/format.h"

namespace rotorub::result {
namespace {

constexpr double kInch = 0.0254, kMil = 1e-3 * kInch;  // m
constexpr double kPoundForce = 4.4482216152605;        // N
constexpr double kPound = 0.45359237;                  // kg

// A unit stands before the units that it begins with.
constexpr UnitChange kSi[] = {{"mm/s", "m/s", 1e-3}, {"µm/N", "m/N", 1e-6}, {"µm", "m", 1e-6},
                              {"mm", "m", 1e-3},     {"µs", "s", 1e-6},     {"ms", "s", 1e-3}};
constexpr UnitChange kMm[] = {{"µm/N", "mm/N", 1e-3},
                              {"µm", "mm", 1e-3},
                              {"N/m", "N/mm", 1e-3},
                              {"m/s", "mm/s", 1e3},
                              {"m", "mm", 1e3}};
constexpr UnitChange kUs[] = {{"mm/s", "in/s", 1e-3 / kInch},
                              {"m/s", "in/s", 1.0 / kInch},
                              {"µm/N", "mil/lbf", 1e-6 / kMil* kPoundForce},
                              {"N s/m", "lbf s/in", kInch / kPoundForce},
                              {"N/m", "lbf/in", kInch / kPoundForce},
                              {"N s", "lbf s", 1.0 / kPoundForce},
                              {"N", "lbf", 1.0 / kPoundForce},
                              {"J", "in lbf", 1.0 / (kInch * kPoundForce)},
                              {"kg", "lb", 1.0 / kPound},
                              {"µm", "mil", 1e-6 / kMil},
                              {"mm", "in", 1e-3 / kInch},
                              {"m", "in", 1.0 / kInch}};

std::span<const UnitChange> changes(Units units) {
  if (units == Units::kSi) return kSi;
  if (units == Units::kMm) return kMm;
  return units == Units::kUs ? std::span<const UnitChange>(kUs) : std::span<const UnitChange>();
}

bool in_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || static_cast<signed char>(c) < 0 ||
         std::string_view("_./").find(c) != std::string_view::npos;
}

// Whether the text begins with the unit, and not with a longer word or a product, "kg m^2".
bool begins_with(std::string_view text, std::string_view unit) {
  if (!text.starts_with(unit)) return false;
  const std::string_view rest = text.substr(unit.size());
  for (const std::string_view factor : {" m", " s", " rad"}) {
    if (rest.starts_with(factor) &&
        (rest.size() == factor.size() ||
         !std::isalpha(static_cast<unsigned char>(rest[factor.size()]))))
      return false;
  }
  const bool ends_sentence = rest.starts_with('.') && (rest.size() == 1 || !in_word(rest[1]));
  return rest.empty() || ends_sentence || !in_word(rest.front());
}

}  // namespace

Units units_of(std::string_view word) {
  if (word == "si") return Units::kSi;
  if (word == "mm") return Units::kMm;
  return word == "us" ? Units::kUs : Units::kAsWritten;
}

std::string in_units(std::string_view text, Units units) {
  if (units == Units::kAsWritten) return std::string(text);
  std::string out;
  while (!text.empty()) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const bool begins_word = out.empty() || !in_word(out.back());
    const char* after = text.data();
    if (begins_word &&
        (std::isdigit(static_cast<unsigned char>(text.front())) || text.front() == '-'))
      after = std::from_chars(text.data(), end, value).ptr;
    const std::string_view rest(after, end);
    const auto change = std::ranges::find_if(changes(units), [&](const UnitChange& c) {
      return after != text.data() && rest.starts_with(' ') && begins_with(rest.substr(1), c.from);
    });
    if (change != changes(units).end()) {
      out += short_number(value * change->factor) + " " + std::string(change->to);
      text = rest.substr(1 + change->from.size());
    } else {
      const std::size_t taken = std::max<std::size_t>(1, text.size() - rest.size());
      out += text.substr(0, taken);
      text.remove_prefix(taken);
    }
  }
  return out;
}

const UnitChange* unit_change(std::string_view label, Units units) {
  for (const UnitChange& c : changes(units)) {
    const bool ends = label.ends_with(c.from) && label.size() > c.from.size() &&
                      label[label.size() - c.from.size() - 1] == ' ';
    if (ends) return &c;
  }
  return nullptr;
}

std::string times(const std::string& text, double factor) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && after == end && !text.empty() ? short_number(value * factor)
                                                               : text;
}

}  // namespace rotorub::result
