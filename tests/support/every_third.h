// The scenes that a daily test takes of a long list; its nightly test takes all of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rotorub::test {

// The first of each three, in order.
inline std::vector<std::string> every_third(const std::vector<std::string>& all) {
  std::vector<std::string> some;
  for (std::size_t k = 0; k < all.size(); k += 3) some.push_back(all[k]);
  return some;
}

}  // namespace rotorub::test
