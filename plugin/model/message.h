// Texts of refusals. They are built without a formatting library, because the preloaded library
// must not link one.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "plugin/model/config.h"

namespace rotorub::plugin {

inline std::string text(std::string_view word) { return std::string(word); }
inline std::string text(double number) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.10g", number);
  return digits;
}
inline std::string text(int number) { return std::to_string(number); }

// The format with each {} replaced by the next value.
template <typename... Values>
std::string message(std::string_view format, const Values&... values) {
  std::string out;
  const auto put = [&](const std::string& value) {
    const std::size_t at = format.find("{}");
    out += format.substr(0, at);
    out += value;
    format.remove_prefix(at == std::string_view::npos ? format.size() : at + 2);
  };
  (put(text(values)), ...);
  return out.append(format);
}

[[noreturn]] inline void refuse(const std::string& element, const std::string& reason) {
  throw ConfigError("rotorub: " + element + ": " + reason);
}

// Collects all errors of a model, so that the user reads them at once.
class Refusals {
 public:
  // Runs the check. False if it throws ConfigError.
  template <typename Check>
  bool attempt(Check check) {
    try {
      check();
      return true;
    } catch (const ConfigError& error) {
      const std::string line = error.what();
      if (text_.find(line) != text_.npos) return false;
      text_ += (text_.empty() ? "" : "\n") + line;
      return false;
    }
  }
  void raise() const {
    if (!text_.empty()) throw ConfigError(text_);
  }

 private:
  std::string text_;
};

// MuJoCo cuts an error that is raised while a model is loaded after about 500 characters, MuJoCo 2
// after 285. Copies as many whole lines as fit, and the number of the lines left out.
template <std::size_t kSize>
void copy_lines(std::string_view text, char (&to)[kSize]) {
  constexpr std::size_t kRoom = mjVERSION_HEADER < 300 ? 260 : 440;
  std::size_t end = text.size();
  if (text.size() > kRoom) {
    const std::size_t last = text.rfind('\n', kRoom);
    if (last != text.npos) end = last;
  }
  const auto left = std::count(text.begin() + static_cast<std::ptrdiff_t>(end), text.end(), '\n');
  const std::string shown(text.substr(0, end));
  if (left == 0) {
    std::snprintf(to, kSize, "%s", shown.c_str());
  } else {
    std::snprintf(to, kSize, "%s\nrotorub: and %d more", shown.c_str(), static_cast<int>(left));
  }
}

inline std::string text_element(const char* name) {
  return message("<custom><text name=\"{}\">", name);
}
inline std::string body_element(const mjModel* m, int body) {
  return message("<body name=\"{}\">", m->names + m->name_bodyadr[body]);
}
// A joint without a name is found by its body.
inline std::string joint_element(const mjModel* m, int joint) {
  const char* name = m->names + m->name_jntadr[joint];
  if (*name) return message("<joint name=\"{}\">", name);
  return message("{} of {}", m->jnt_type[joint] == mjJNT_FREE ? "the free joint" : "a joint",
                 body_element(m, m->jnt_bodyid[joint]));
}
inline std::string joint_of_dof(const mjModel* m, int dof) {
  return joint_element(m, m->dof_jntid[dof]);
}

}  // namespace rotorub::plugin
