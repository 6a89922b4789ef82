// Studies in a folder of their own, for tests.
#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include "compare/sweep/study_file.h"
#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub::test {

// A free Jeffcott rotor with unbalance: m = 2 kg, omega = 200 rad/s, zeta = 0.1, m e = 4e-5 kg m.
inline constexpr const char* kFreeRotor = R"(
[run]
end = 1.0
[rotor]
speed = 150.0
[rotor.modal]
mass = [2.0]
stiffness = [8e4]
damping = [80.0]
[contact]
radius = 0.05
clearance = "5 mm"
friction = 0.0
restitution = 0.0
[[force]]
kind = "unbalance"
static_moment = 4e-5
)";

class StudyFolder : public TemporaryFolder {
 public:
  sweep::Study study(const std::string& text) const {
    return sweep::read_study(write("study.toml", text));
  }
  // The message that refuses the study; empty if it is read.
  std::string refusal(const std::string& text) const {
    return message_of([&] { study(text); });
  }
};

// The first line of a study of bench_ring.
inline std::string of_ring() {
  return "scene = \"" + std::string(ROTORUB_MJCF_DIR) + "/bench_ring.toml\"\n";
}

// Its tables of a sample in which each key takes these values.
inline std::string sampled(
    const std::string& kind,
    std::initializer_list<std::pair<std::string, std::string>> keys_and_values) {
  std::string text = "[sample]\nkind = \"" + kind + "\"\n";
  for (const auto& [key, values] : keys_and_values)
    text += "[[vary]]\nkey = \"" + key + "\"\nvalues = " + values + "\n";
  return text;
}
inline std::string lasting(const std::string& end, const std::string& step) {
  return "[run]\nend = \"" + end + "\"\nstep = \"" + step + "\"\n";
}

}  // namespace rotorub::test
