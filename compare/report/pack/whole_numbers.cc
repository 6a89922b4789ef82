#include "compare/report/pack/whole_numbers.h"

#include <cassert>

namespace rotorub {

void put_column(const std::vector<std::int64_t>& numbers, std::string& bytes) {
  std::int64_t before = 0;
  for (const std::int64_t number : numbers) {
    const std::int64_t difference = number - before;
    before = number;
    auto rest = (static_cast<std::uint64_t>(difference) << 1) ^
                static_cast<std::uint64_t>(difference >> 63);
    for (; rest >= 128; rest >>= 7) bytes += static_cast<char>(0x80 | (rest & 0x7f));
    bytes += static_cast<char>(rest);
  }
}

std::vector<std::int64_t> take_column(std::string_view bytes, std::size_t& at, std::size_t count) {
  std::vector<std::int64_t> numbers;
  numbers.reserve(count);
  std::int64_t number = 0;
  while (numbers.size() < count) {
    std::uint64_t zigzag = 0;
    for (int shift = 0;; shift += 7) {
      assert(at < bytes.size());
      const auto byte = static_cast<std::uint8_t>(bytes[at++]);
      zigzag |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 128) break;
    }
    number += static_cast<std::int64_t>(zigzag >> 1) ^ -static_cast<std::int64_t>(zigzag & 1);
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace rotorub
