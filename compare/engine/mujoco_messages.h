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

// While it lives, errors are thrown as MujocoError and warnings are collected. MuJoCo's handlers
// are global: one at a time, warnings of all threads come together.
class MujocoMessages {
 public:
  MujocoMessages();
  ~MujocoMessages();
  MujocoMessages(const MujocoMessages&) = delete;
  MujocoMessages& operator=(const MujocoMessages&) = delete;

  std::vector<std::string> warnings() const;

 private:
  void (*previous_error_)(const char*);
  void (*previous_warning_)(const char*);
};

}  // namespace rotorub
