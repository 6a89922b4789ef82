#include "native_model/scene/units.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

// SI value = number times / over. Both are whole numbers where possible, so that "18 mm" is 0.018
// to the last bit.
struct Unit {
  double times = 1.0;
  double over = 1.0;
  Dimension dimension{};
};

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr auto kUnits = std::to_array<NamedUnit>({
    {"m", {1.0, 1.0, kLength.dimension}},
    {"km", {1e3, 1.0, kLength.dimension}},
    {"cm", {1.0, 1e2, kLength.dimension}},
    {"mm", {1.0, 1e3, kLength.dimension}},
    {"um", {1.0, 1e6, kLength.dimension}},
    {"\u00b5m", {1.0, 1e6, kLength.dimension}},
    {"\u03bcm", {1.0, 1e6, kLength.dimension}},
    {"nm", {1.0, 1e9, kLength.dimension}},
    {"in", {254.0, 1e4, kLength.dimension}},
    {"mil", {254.0, 1e7, kLength.dimension}},
    {"mils", {254.0, 1e7, kLength.dimension}},
    {"ft", {3048.0, 1e4, kLength.dimension}},
    {"s", {1.0, 1.0, kTime.dimension}},
    {"ms", {1.0, 1e3, kTime.dimension}},
    {"us", {1.0, 1e6, kTime.dimension}},
    {"\u00b5s", {1.0, 1e6, kTime.dimension}},
    {"\u03bcs", {1.0, 1e6, kTime.dimension}},
    {"ns", {1.0, 1e9, kTime.dimension}},
    {"min", {60.0, 1.0, kTime.dimension}},
    {"kg", {1.0, 1.0, kMass.dimension}},
    {"g", {1.0, 1e3, kMass.dimension}},
    {"mg", {1.0, 1e6, kMass.dimension}},
    {"t", {1e3, 1.0, kMass.dimension}},
    {"lb", {45359237.0, 1e8, kMass.dimension}},
    {"oz", {45359237.0, 16e8, kMass.dimension}},
    {"gmm", {1.0, 1e6, {1, 1, 0, 0, 0}}},
    {"N", {1.0, 1.0, kForce.dimension}},
    {"mN", {1.0, 1e3, kForce.dimension}},
    {"kN", {1e3, 1.0, kForce.dimension}},
    {"MN", {1e6, 1.0, kForce.dimension}},
    {"lbf", {44482216152605.0, 1e13, kForce.dimension}},
    {"Nm", {1.0, 1.0, {2, 1, -2, 0, 0}}},
    {"Nmm", {1.0, 1e3, {2, 1, -2, 0, 0}}},
    {"Ns", {1.0, 1.0, {1, 1, -1, 0, 0}}},
    {"Pa", {1.0, 1.0, kPressure.dimension}},
    {"mPa", {1.0, 1e3, kPressure.dimension}},
    {"kPa", {1e3, 1.0, kPressure.dimension}},
    {"MPa", {1e6, 1.0, kPressure.dimension}},
    {"GPa", {1e9, 1.0, kPressure.dimension}},
    {"psi", {44482216152605.0, 64516e5, kPressure.dimension}},
    {"J", {1.0, 1.0, {2, 1, -2, 0, 0}}},
    {"W", {1.0, 1.0, {2, 1, -3, 0, 0}}},
    {"A", {1.0, 1.0, {0, 0, 0, 1, 0}}},
    {"mA", {1.0, 1e3, {0, 0, 0, 1, 0}}},
    {"V", {1.0, 1.0, {2, 1, -3, -1, 0}}},
    {"kV", {1e3, 1.0, {2, 1, -3, -1, 0}}},
    {"Ohm", {1.0, 1.0, {2, 1, -3, -2, 0}}},
    {"mOhm", {1.0, 1e3, {2, 1, -3, -2, 0}}},
    {"H", {1.0, 1.0, {2, 1, -2, -2, 0}}},
    {"mH", {1.0, 1e3, {2, 1, -2, -2, 0}}},
    {"Hz", {2.0 * std::numbers::pi, 1.0, kSpin.dimension}},
    {"kHz", {2e3 * std::numbers::pi, 1.0, kSpin.dimension}},
    {"rpm", {2.0 * std::numbers::pi, 60.0, kSpin.dimension}},
    {"rad", {1.0, 1.0, kAngle.dimension}},
    {"mrad", {1.0, 1e3, kAngle.dimension}},
    {"deg", {std::numbers::pi, 180.0, kAngle.dimension}},
    {"\u00b0", {std::numbers::pi, 180.0, kAngle.dimension}},
    {"%", {1.0, 100.0, {}}},
});

Unit power(const Unit& base, int exponent) {
  double times = 1.0, over = 1.0;
  for (int i = 0; i < std::abs(exponent); ++i) {
    times *= base.times;
    over *= base.over;
  }
  Unit result{exponent < 0 ? over : times, exponent < 0 ? times : over, base.dimension};
  for (int& of_one : result.dimension) of_one *= exponent;
  return result;
}

Unit product(const Unit& a, const Unit& b) {
  Unit result{a.times * b.times, a.over * b.over, a.dimension};
  for (std::size_t i = 0; i < b.dimension.size(); ++i) result.dimension[i] += b.dimension[i];
  return result;
}

// Recursive descent over the grammar in the header. On failure error() has the reason.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : rest_(text) {}

  Unit parse() {
    const Unit unit = parse_product(0);
    skip_space();
    if (error_.empty() && !rest_.empty()) fail("unexpected '" + printable(rest_) + "' in the unit");
    return unit;
  }
  const std::string& error() const { return error_; }

 private:
  static constexpr int kDeepest = 16;  // nested brackets
  static constexpr int kHighestPower = 9;

  void fail(std::string reason) {
    if (error_.empty()) error_ = std::move(reason);
  }
  void skip_space() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t'))
      rest_.remove_prefix(1);
  }
  bool take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  Unit parse_product(int depth) {
    if (depth > kDeepest) {
      fail("too many brackets in the unit");
      return {};
    }
    skip_space();
    Unit result;
    bool divided = take("/");
    result = power(parse_factor(depth), divided ? -1 : 1);
    while (error_.empty()) {
      skip_space();
      if (rest_.empty() || rest_.front() == ')') break;
      if (take("/")) {
        result = product(result, power(parse_factor(depth), -1));
        divided = true;
        continue;
      }
      if (divided) {
        fail("ambiguous unit: put the factors after '/' in brackets, for example N/(m s)");
        break;
      }
      if (!take("*") && !take("\u00b7")) take("\u22c5");
      result = product(result, parse_factor(depth));
    }
    return result;
  }

  Unit parse_factor(int depth) {
    skip_space();
    Unit base;
    if (take("(")) {
      base = parse_product(depth + 1);
      skip_space();
      if (!take(")")) fail("a bracket is not closed in the unit");
    } else if (!take("1")) {
      base = parse_name();
    }
    return error_.empty() ? power(base, parse_power()) : Unit{};
  }

  Unit parse_name() {
    const std::size_t length = std::min(rest_.find_first_of(" \t*/^()0123456789-+"), rest_.size());
    std::string_view name = rest_.substr(0, length);
    for (std::string_view mark : {"\u00b7", "\u22c5", "\u00b2", "\u00b3"}) {
      name = name.substr(0, name.find(mark));
    }
    const auto* found = std::find_if(kUnits.begin(), kUnits.end(),
                                     [&](const NamedUnit& unit) { return unit.name == name; });
    if (found == kUnits.end()) {
      fail(name.empty() ? "a unit is missing"
                        : "unknown unit '" + printable(name) + "' (all units: mjcf/README.md)");
      return {};
    }
    rest_.remove_prefix(name.size());
    return found->unit;
  }

  int parse_power() {
    if (take("\u00b2")) return 2;
    if (take("\u00b3")) return 3;
    if (!take("^")) return 1;
    take("+");
    int exponent = 0;
    const auto [end, status] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), exponent);
    if (status != std::errc() || std::abs(exponent) > kHighestPower) {
      fail("a power in a unit is a whole number between -9 and 9");
      return 1;
    }
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return exponent;
  }

  std::string_view rest_;
  std::string error_;
};

// Words that are not units, in lower case, and the units that they probably mean.
struct Meant {
  std::string_view word, unit;
};
constexpr auto kMeant = std::to_array<Meant>({
    {"lbs", "lb"},        {"lbm", "lb"},        {"inch", "in"},        {"oz-in", "oz in"},
    {"ozin", "oz in"},    {"lb-in", "lb in"},   {"in-lb", "in lb"},    {"lb-ft", "lb ft"},
    {"ft-lb", "ft lb"},   {"n-m", "N m"},       {"g-mm", "g mm"},      {"meter", "m"},
    {"metre", "m"},       {"centimeter", "cm"}, {"centimetre", "cm"},  {"millimeter", "mm"},
    {"millimetre", "mm"}, {"micrometer", "um"}, {"micrometre", "um"},  {"micron", "um"},
    {"feet", "ft"},       {"second", "s"},      {"millisecond", "ms"}, {"minute", "min"},
    {"gram", "g"},        {"kilogram", "kg"},   {"tonne", "t"},        {"pound", "lb"},
    {"newton", "N"},      {"pascal", "Pa"},     {"hertz", "Hz"},       {"radian", "rad"},
    {"degree", "deg"},    {"percent", "%"},
});

bool is_unit(std::string_view word) {
  return std::ranges::any_of(kUnits, [&](const NamedUnit& unit) { return unit.name == word; });
}

// The unit or the word above that is spelt most like `word`, whatever its case; empty if none is.
std::string_view like_a_unit(std::string_view word) {
  std::vector<std::string_view> names;
  for (const NamedUnit& unit : kUnits) names.push_back(unit.name);
  for (const Meant& meant : kMeant) names.push_back(meant.word);
  return nearest(word, names);
}

// The unit meant by such a word, or by a unit in the wrong case or misspelt. "in3" means in^3.
std::string meant_word(std::string_view word) {
  if (is_unit(word)) return std::string(word);
  const bool powered = word.size() > 1 && (word.back() == '2' || word.back() == '3');
  if (powered) return meant_word(word.substr(0, word.size() - 1)) + "^" + word.back();
  const std::string_view like = like_a_unit(word);
  for (const Meant& meant : kMeant) {
    if (meant.word == like) return std::string(meant.unit);
  }
  return std::string(like.empty() ? word : like);
}

std::string pound_as_force(std::string_view word) {
  return word == "lb" ? "lbf" : std::string(word);
}

// Replaces each word of `unit` by change(word) and keeps everything in between.
template <class Change>
std::string with_words(std::string_view unit, const Change& change) {
  std::string text;
  while (!unit.empty()) {
    const std::size_t length = std::min(unit.find_first_of(" \t*/^()"), unit.size());
    if (length > 0) text += change(unit.substr(0, length));
    unit.remove_prefix(length);
    if (unit.empty()) break;
    text += unit.front();
    unit.remove_prefix(1);
  }
  return text;
}

// Angles are optional beside other dimensions (N m/rad is N m), but a quantity of dimension 1 is
// either an angle or a pure number.
bool fits(const Dimension& unit, const Dimension& key) {
  const auto is_zero = [](int power) { return power == 0; };
  const bool dimensionless = std::all_of(key.begin(), key.end() - 1, is_zero);
  return std::equal(key.begin(), key.end() - 1, unit.begin()) &&
         (!dimensionless || unit.back() == key.back());
}

// True for a speed of rotation in 1/min, which means revolutions on nameplates and radians in the
// SI. In 1/s it has the value of a number without a unit, rad/s.
bool is_ambiguous(const Unit& unit, const Dimension& key) {
  return key.back() == 1 && unit.dimension.back() == 0 && unit.times != unit.over;
}

bool is_unit_of(const Quantity& quantity, std::string_view text) {
  UnitParser parser(text);
  const Unit unit = parser.parse();
  return parser.error().empty() && fits(unit.dimension, quantity.dimension);
}

// A suggestion, as the end of a message, for a number with a unit that does not fit `quantity`.
// Empty if there is none.
std::string hint(std::string_view number, std::string_view unit, const Quantity& quantity) {
  const auto perhaps = [&](const std::string& meant) {
    return "; did you mean \"" + printable(std::string(number) + meant) + "\"?";
  };
  const std::string spelt = with_words(unit, meant_word);
  if (is_unit_of(quantity, spelt)) return perhaps(spelt);
  const std::string forced = with_words(spelt, pound_as_force);
  if (is_unit_of(quantity, forced)) return perhaps(forced) + " (lb is a mass, lbf a force)";
  return {};
}

}  // namespace

ParsedQuantity parse_quantity(std::string_view text, const Quantity& quantity) {
  const std::string expected = "expected " + std::string(quantity.name) + " (a number in " +
                               std::string(quantity.unit) +
                               ", or a string with a unit: " + std::string(quantity.examples) +
                               "), got \"" + printable(text) + "\"";
  std::string_view rest = trimmed(text);
  if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);

  // The number. "inf", "nan" and "+-1", which std::from_chars would accept, are refused.
  const std::string_view digits = rest.starts_with('-') ? rest.substr(1) : rest;
  if (digits.empty() || (digits.front() != '.' && (digits.front() < '0' || digits.front() > '9'))) {
    return {0.0, expected};
  }
  double number = 0.0;
  const auto [end, status] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (status == std::errc::invalid_argument) return {0.0, expected};
  if (status != std::errc()) return {0.0, expected + ": out of the range of a double"};
  const std::string_view written = rest.substr(0, static_cast<std::size_t>(end - rest.data()));
  rest.remove_prefix(written.size());

  if (rest.size() > 1 && rest[0] == ',' && rest[1] >= '0' && rest[1] <= '9') {
    return {0.0, expected + "; write a decimal point: " +
                     printable(std::string(written) + "." + std::string(rest.substr(1)))};
  }

  // The unit.
  if (trimmed(rest).empty()) return {number, {}};
  UnitParser parser(rest);
  const Unit unit = parser.parse();
  if (!parser.error().empty() || !fits(unit.dimension, quantity.dimension)) {
    const std::string meant = hint(written, rest, quantity);
    if (!meant.empty()) return {0.0, expected + meant};
    return {0.0, parser.error().empty() ? expected : expected + ": " + parser.error()};
  }
  if (is_ambiguous(unit, quantity.dimension)) {
    return {0.0, expected + ": it counts neither turns nor radians; write rpm, Hz or rad/s"};
  }
  const double value = number * unit.times / unit.over;
  if (!std::isfinite(value)) return {0.0, expected + ": out of the range of a double"};
  return {value, {}};
}

}  // namespace rotorub::scene
