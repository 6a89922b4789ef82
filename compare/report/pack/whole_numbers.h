// Columns of whole numbers in few bytes: differences, zigzag, base 128 (see Track::bytes).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rotorub {

// Appends the column.
void put_column(const std::vector<std::int64_t>& numbers, std::string& bytes);

// Reads `count` numbers from `at` on, which it moves. Asserts that they are there.
std::vector<std::int64_t> take_column(std::string_view bytes, std::size_t& at, std::size_t count);

}  // namespace rotorub
