#include "tests/bad_input/bounded_run.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

namespace rotorub::test {
namespace {

void limit(int resource, rlim_t value) {
  const rlimit both{value, value};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

void redirect(const std::string& file, int stream) {
  dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
}

[[noreturn]] void become(const std::filesystem::path& folder, std::vector<std::string>& words,
                         const Limits& limits) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  redirect(folder.string() + ".out", STDOUT_FILENO);
  redirect(folder.string() + ".err", STDERR_FILENO);
  if (chdir(folder.c_str()) != 0) _exit(127);
  limit(RLIMIT_CPU, static_cast<rlim_t>(limits.processor_s));
  limit(RLIMIT_AS, limits.memory);
  limit(RLIMIT_FSIZE, limits.file_size);
  limit(RLIMIT_CORE, 0);
  alarm(static_cast<unsigned>(limits.clock_s));  // kept over exec
  execv(argv[0], argv.data());
  _exit(127);
}

std::string beginning(const std::string& file) {
  constexpr std::streamsize kMost = std::streamsize{16} << 20;
  std::string text(static_cast<std::size_t>(kMost), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), kMost);
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

Ended bounded_run(const std::filesystem::path& folder, std::vector<std::string> words,
                  const Limits& limits) {
  const pid_t process = fork();
  if (process == 0) become(folder, words, limits);
  int status = 0;
  waitpid(process, &status, 0);
  Ended ended;
  if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
  // The soft and the hard limit of RLIMIT_CPU are equal, so the kernel ends the program by SIGKILL.
  if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status) == SIGKILL ? SIGXCPU : WTERMSIG(status);
  ended.out = beginning(folder.string() + ".out");
  ended.err = beginning(folder.string() + ".err");
  return ended;
}

}  // namespace rotorub::test
