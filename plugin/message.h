// Words of a refusal. The preloaded library links no formatting library.
#pragma once

#include <mujoco/mujoco.h>

#include <cstdio>
#include <string>
#include <string_view>

#include "plugin/config.h"

namespace rotorub::plugin {

inline std::string text(std::string_view word) { return std::string(word); }
inline std::string text(double number) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.10g", number);
  return digits;
}
inline std::string text(int number) { return std::to_string(number); }

// The format with each {} replaced by the next of the values.
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

inline std::string text_element(const char* name) {
  return message("<custom><text name=\"{}\">", name);
}
inline std::string body_element(const mjModel* m, int body) {
  return message("<body name=\"{}\">", m->names + m->name_bodyadr[body]);
}
inline std::string joint_element(const mjModel* m, int joint) {
  return message("<joint name=\"{}\">", m->names + m->name_jntadr[joint]);
}
inline std::string joint_of_dof(const mjModel* m, int dof) {
  return joint_element(m, m->dof_jntid[dof]);
}

}  // namespace rotorub::plugin
