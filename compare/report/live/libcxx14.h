// Parts of libstdc++ 12 that the native model needs and that libc++ 14 of Debian 12's emscripten
// lacks, or computes with different round-off. Included before every file (CMakeLists.txt here).
// Remove it when emscripten no longer needs it.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>

namespace std {

// For decimal numbers. strtod is exact to the last bit, but would also accept "0x1p3", "inf" and
// blanks.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const string_view text(first, static_cast<size_t>(last - first));
  const string number(text.substr(0, text.find_first_not_of("0123456789.eE+-")));
  if (number.empty() || number[0] == '+') return {first, errc::invalid_argument};
  char* end = nullptr;
  const double read = strtod(number.c_str(), &end);
  if (end == number.c_str()) return {first, errc::invalid_argument};
  if (read - read != 0.0) return {first + (end - number.c_str()), errc::result_out_of_range};
  value = read;
  return {first + (end - number.c_str()), errc()};
}

inline to_chars_result to_chars(char* first, char* last, double value, chars_format, int digits) {
  const auto room = static_cast<size_t>(last - first);
  const int length = snprintf(first, room, "%.*g", digits, value);
  if (static_cast<size_t>(length) >= room) return {last, errc::value_too_large};
  return {first + length, errc()};
}

// The shortest digits that read back as the same number.
inline to_chars_result to_chars(char* first, char* last, double value) {
  for (int digits = 1;; ++digits) {
    const to_chars_result done = to_chars(first, last, value, chars_format::general, digits);
    if (digits == 17 || done.ec != errc() || strtod(first, nullptr) == value) return done;
  }
}

// The general format gives the shortest digits too.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format) {
  return to_chars(first, last, value);
}

// R. L. Smith's division (Communications of the ACM 5, 1962), as in libgcc except near the ends of
// the range of doubles; libc++ scales by powers of two and rounds differently. It is a
// specialisation, because complex's own operator/= would not find an overload.
template <>
inline complex<double> operator/(const complex<double>& z, const complex<double>& w) {
  const double a = z.real(), b = z.imag(), c = w.real(), d = w.imag();
  if (abs(c) < abs(d)) {
    const double ratio = c / d, whole = c * ratio + d;
    return {(a * ratio + b) / whole, (b * ratio - a) / whole};
  }
  const double ratio = d / c, whole = d * ratio + c;
  return {(b * ratio + a) / whole, (b - a * ratio) / whole};
}

namespace ranges {

#define ROTORUB_RANGE_ALGORITHM(name)                                               \
  template <class Range, class Act>                                                 \
  auto name(Range&& range, Act act) {                                               \
    return std::name(std::begin(range), std::end(range),                            \
                     [&act](auto&& element) { return std::invoke(act, element); }); \
  }
ROTORUB_RANGE_ALGORITHM(all_of)
ROTORUB_RANGE_ALGORITHM(any_of)
ROTORUB_RANGE_ALGORITHM(none_of)
ROTORUB_RANGE_ALGORITHM(count_if)
ROTORUB_RANGE_ALGORITHM(find_if)
ROTORUB_RANGE_ALGORITHM(for_each)
#undef ROTORUB_RANGE_ALGORITHM

template <class Range, class Value>
auto find(Range&& range, const Value& value) {
  return std::find(std::begin(range), std::end(range), value);
}

template <class Range, class To>
void copy(Range&& range, To to) {
  std::copy(std::begin(range), std::end(range), to);
}

template <class Range, class By>
auto max(Range&& range, less, By by) {
  return *std::max_element(std::begin(range), std::end(range), [&by](const auto& a, const auto& b) {
    return std::invoke(by, a) < std::invoke(by, b);
  });
}

template <class Range, class By>
void stable_sort(Range&& range, less, By by) {
  std::stable_sort(std::begin(range), std::end(range), [&by](const auto& a, const auto& b) {
    return std::invoke(by, a) < std::invoke(by, b);
  });
}

}  // namespace ranges
}  // namespace std
