#include "native_model/control/python_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "native_model/control/python_runner.h"

namespace rotorub {
namespace {

constexpr int kSocketOfRunner = 3;
constexpr int kSecondsToEnd = 2;

std::string interpreter() {
  const char* chosen = std::getenv("ROTORUB_PYTHON");
  return chosen != nullptr && *chosen != '\0' ? chosen : "python3";
}

// The environment of this process, except that sets and dicts of texts have the same order in every
// run, and that what is preloaded here is not preloaded there.
std::vector<std::string> environment_of_runner() {
  std::vector<std::string> all;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    if (text.starts_with("PYTHONHASHSEED=") || text.starts_with("LD_PRELOAD=")) continue;
    all.emplace_back(text);
  }
  all.emplace_back("PYTHONHASHSEED=0");
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Starts the interpreter in a process group of its own, so that a signal to the group of this
// process (Ctrl-C) does not end it. Returns 0, or the error number.
int spawn(pid_t* pid, const std::string& program, int socket) {
  std::vector<std::string> words{program, "-u", "-c", std::string(python_runner()),
                                 std::to_string(kSocketOfRunner)};
  std::vector<std::string> environment = environment_of_runner();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, socket, kSocketOfRunner);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  const int error = posix_spawnp(pid, program.c_str(), &actions, &attributes,
                                 pointers_to(words).data(), pointers_to(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

// The interpreter, the working directory and the file of a law. A process may serve only laws for
// which all three are the same.
std::string surroundings_of(const std::string& file) {
  std::error_code unknown;
  return interpreter() + '\n' + std::filesystem::current_path(unknown).string() + '\n' + file;
}

// All processes, and what each depends on.
struct Processes {
  std::mutex mutex;
  std::vector<std::pair<std::string, std::shared_ptr<PythonProcess>>> all;
};
Processes& processes() {
  static Processes every;
  return every;
}

std::size_t most_processes() { return 4 * std::max(1u, std::thread::hardware_concurrency()); }

}  // namespace

PythonProcess::PythonProcess() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::runtime_error(std::string("no connection to Python: ") + std::strerror(errno));
  const std::string program = interpreter();
  const int error = spawn(&pid_, program, ends[1]);
  close(ends[1]);
  socket_ = ends[0];
  if (error == 0) return;
  close(socket_);
  throw std::runtime_error("a law in Python needs Python 3, but " + program +
                           " cannot be started (" + std::strerror(error) +
                           "); install python3, or set ROTORUB_PYTHON to an interpreter");
}

PythonProcess::~PythonProcess() {
  // The runner ends when it reads the end of the requests; its own end of the socket closes then.
  shutdown(socket_, SHUT_WR);
  const timeval patience{kSecondsToEnd, 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  char rest;
  ssize_t read;
  do read = recv(socket_, &rest, 1, 0);
  while (read > 0 || (read < 0 && errno == EINTR));
  if (read < 0) kill(pid_, SIGKILL);
  close(socket_);
  if (pid_ > 0) waitpid(pid_, nullptr, 0);
}

std::string PythonProcess::how_it_ended() {
  int status = 0;
  const bool known = waitpid(pid_, &status, 0) == pid_;
  pid_ = -1;
  if (known && WIFSIGNALED(status))
    return std::string("its Python process was ended by a signal: ") + strsignal(WTERMSIG(status));
  if (known)
    return "its Python process ended with exit code " + std::to_string(WEXITSTATUS(status));
  return "its Python process has ended";
}

void PythonProcess::send(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno != EINTR) {
      return;  // the runner has ended; receive() says so
    }
  }
}

void PythonProcess::receive(char* to, std::size_t count) {
  while (count > 0) {
    const ssize_t read = recv(socket_, to, count, 0);
    if (read > 0) {
      to += read;
      count -= static_cast<std::size_t>(read);
    } else if (read == 0 || errno != EINTR) {
      throw std::runtime_error(how_it_ended());
    }
  }
}

std::string PythonProcess::ask(std::string_view request) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (pid_ < 0) throw std::runtime_error("its Python process has ended");
  auto length = static_cast<std::uint32_t>(request.size());
  std::string message(reinterpret_cast<const char*>(&length), sizeof length);
  message += request;
  send(message);
  receive(reinterpret_cast<char*>(&length), sizeof length);
  message.resize(length);
  receive(message.data(), length);
  return message;
}

std::uint32_t PythonProcess::next_law() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return laws_++;
}

bool PythonProcess::has_ended() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return pid_ < 0;
}

std::shared_ptr<PythonProcess> process_for(const std::string& file) {
  Processes& known = processes();
  const std::lock_guard<std::mutex> lock(known.mutex);
  auto& all = known.all;
  std::erase_if(all, [](const auto& entry) { return entry.second->has_ended(); });
  // The list itself is one owner; each law is another.
  const auto is_free = [](const auto& entry) { return entry.second.use_count() == 1; };
  const std::string wanted = surroundings_of(file);
  auto best = all.end();
  for (auto entry = all.begin(); entry != all.end(); ++entry) {
    if (entry->first != wanted) continue;
    if (best == all.end() || entry->second.use_count() < best->second.use_count()) best = entry;
  }
  const bool full = all.size() >= most_processes();
  if (best != all.end() && (is_free(*best) || full)) return best->second;
  if (full) {
    const auto unused = std::find_if(all.begin(), all.end(), is_free);
    if (unused != all.end()) all.erase(unused);
  }
  return all.emplace_back(wanted, std::make_shared<PythonProcess>()).second;
}

}  // namespace rotorub
