// MuJoCo's errors as exceptions. By itself mju_error waits for Enter and ends the process.
#pragma once

namespace rotorub::renders {

// While it lives, an error of MuJoCo is thrown as std::runtime_error. MuJoCo's handler is global to
// the process; the one before comes back at the end.
class MujocoErrors {
 public:
  MujocoErrors();
  ~MujocoErrors();
  MujocoErrors(const MujocoErrors&) = delete;
  MujocoErrors& operator=(const MujocoErrors&) = delete;

 private:
  void (*previous_)(const char*);
};

}  // namespace rotorub::renders
