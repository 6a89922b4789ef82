// Python interpreters as child processes, each of which runs one user's law at a time
// (python_runner.h).
#pragma once

#include <sys/types.h>

#include <memory>
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

  // Sends one request and returns the answer, which stays valid until the next call. Throws
  // std::runtime_error if the interpreter has ended.
  std::string_view ask(std::string_view request);

 private:
  void send(std::string_view bytes) const;
  void receive(char* to, std::size_t count);
  std::string how_it_ended();

  pid_t pid_ = -1;
  int socket_ = -1;
  std::string message_;  // kept so that a step allocates nothing
};

// A process that has run the law of this file before and is free, or else a new one. A sweep thus
// starts Python, and imports what the law imports, once per thread. Throws as the constructor does.
std::unique_ptr<PythonProcess> process_for(const std::string& file);
// Keeps a process, whose law has ended, for the next law of the file.
void keep_process(const std::string& file, std::unique_ptr<PythonProcess> process);

}  // namespace rotorub
