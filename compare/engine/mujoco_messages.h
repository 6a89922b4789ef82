// MuJoCo's errors and warnings as C++ sees them. By itself mju_error waits for Enter, ends the
// process and writes a log file.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace rotorub {

// What mju_error said.
class MujocoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// While one lives, errors are thrown as MujocoError and warnings are collected, each in its thread.
// MuJoCo's handlers are global: several may live at a time, in any threads; the first installs and
// the last one restores. A thread's newest has that thread's warnings since it was made.
class MujocoMessages {
 public:
  MujocoMessages();
  ~MujocoMessages();
  MujocoMessages(const MujocoMessages&) = delete;
  MujocoMessages& operator=(const MujocoMessages&) = delete;

  std::vector<std::string> warnings() const;
};

}  // namespace rotorub
