#include "compare/sweep/shard.h"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

namespace rotorub::sweep {

std::string Shard::file() const {
  return whole() ? "results.sqlite" : fmt::format("results.{}-of-{}.sqlite", number, count);
}

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.number);
  bool good = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  if (good) {
    const auto second = std::from_chars(first.ptr + 1, end, shard.count);
    good = second.ec == std::errc() && second.ptr == end;
  }
  if (!good || shard.count < 1 || shard.count > kMostShards || shard.number < 1 ||
      shard.number > shard.count) {
    throw std::invalid_argument(
        fmt::format("--shard {}: accepted is i/n, part i of n, as 1/4 to 4/4 (n at most {})", text,
                    kMostShards));
  }
  return shard;
}

std::int64_t Batches::points_of(const Shard& shard) const {
  const std::int64_t batches = count(), n = shard.count;
  if (batches < shard.number) return 0;
  const std::int64_t mine = (batches - shard.number) / n + 1;
  const bool has_last = shard.has(batches - 1);
  return mine * size - (has_last ? batches * size - points : 0);
}

}  // namespace rotorub::sweep
