// How far a long piece of work is, and with what.
#pragma once

#include <functional>
#include <string>

namespace rotorub::bench {

using Progress = std::function<void(double share, const std::string& what)>;

}  // namespace rotorub::bench
