// Words to replace a value: numbers, units, values of other types, terminal codes.
#pragma once

#include <array>
#include <sstream>
#include <string>
#include <vector>

namespace rotorub::test {

inline std::vector<std::string> between_bars(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> all;
  for (std::string part; std::getline(in, part, '|');) all.push_back(part);
  return all;
}

inline const std::vector<std::string> kNumbers = between_bars(
    "0|-0.0|-1|1|1e-3|-1e-3|1e3|1e6|1e9|1e12|1e17|2.1e17|1e30|-1e30|1e154|1e200|1e308|-1e308|"
    "1e400|1e-30|1e-308|5e-324|nan|-nan|inf|-inf|9223372036854775807|99999999999999999999|"
    "0x7fffffffffffffff|0.1|0.999999999|1.0000000001|1e-12|7|64|300");
inline constexpr std::array kUnits{"mm",  "um",    "m",      "s",    "ms",      "us", "Hz",
                                   "rpm", "rad/s", "deg",    "N",    "kN",      "kg", "g",
                                   "N/m", "N s/m", "parsec", "%",    "kg m^2",  "",   " ",
                                   "m/",  "/s",    "^2",     "m^99", "mm mm mm"};
inline const std::vector<std::string> kTypes = between_bars(
    "true|\"text\"|[1.0, 2.0]|[]|[[1.0]]|{a = 1}|{}|1979-05-27|[1, \"a\"]|07:32:00|[nan]|"
    "[[]]|[1, 2, 3, 4, 5, 6, 7, 8, 9]|\"\"|'''|\"\"\"|none");
// Terminal codes for colour, window title and cursor; a mark that reverses the direction of
// writing; an 8-bit control character.
inline const std::vector<std::string> kCodes = between_bars(
    "\x1b[31m|\x1b]0;title\x07|\x1b[2J|\r\x1b[K|\xe2\x80\xae|\xc2\x9b"
    "31m|\x7f|\b\b\b");

}  // namespace rotorub::test
