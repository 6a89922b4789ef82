#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace rotorub::test {

// The contents of a file; empty if it does not exist.
inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace rotorub::test
