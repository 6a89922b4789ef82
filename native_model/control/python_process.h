// Python interpreters as child processes, which run users' laws (python_runner.h).
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace rotorub {

// The interpreter is $ROTORUB_PYTHON, or else python3 on the PATH. It ends with this object, or
// when this process ends. What the law prints goes to standard error.
class PythonProcess {
 public:
  // Throws std::runtime_error if the interpreter cannot be started.
  PythonProcess();
  ~PythonProcess();
  PythonProcess(const PythonProcess&) = delete;
  PythonProcess& operator=(const PythonProcess&) = delete;

  // Sends one request and returns the answer. Several threads may ask. Throws std::runtime_error if
  // the interpreter has ended.
  std::string ask(std::string_view request);
  // The number of a law that is new to this process.
  std::uint32_t next_law();
  bool has_ended() const;

 private:
  void send(std::string_view bytes) const;
  void receive(char* to, std::size_t count);
  std::string how_it_ended();

  mutable std::mutex mutex_;
  pid_t pid_ = -1;
  int socket_ = -1;
  std::uint32_t laws_ = 0;
};

// The process for one more law of this file. Processes stay for later laws, so that a sweep starts
// Python, and imports what the law imports, once per thread. Laws share a process only when there
// are many of them at a time. Throws as the constructor does.
std::shared_ptr<PythonProcess> process_for(const std::string& file);

}  // namespace rotorub
