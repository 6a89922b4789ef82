// Starts the built program as a user would, and examines its output and files.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub::test {

using nlohmann::json;

struct Outcome {
  int code = -1;  // exit code; 128 + signal
  std::string out, err;
};

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in.good()) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

// Differences between the program's environment and that of the test.
struct Surroundings {
  std::vector<std::pair<std::string, std::string>> environment;  // variables set beside the own
  std::string out = "standard_output";                           // file of standard output
  bool obeys_modes = false;  // root too may only write what the modes of files and folders allow
};

// The program, running in its own folder.
class Program {
 public:
  Program(std::filesystem::path folder, const std::vector<std::string>& arguments,
          Surroundings surroundings = {})
      : folder_(std::move(folder)), surroundings_(std::move(surroundings)) {
    std::vector<std::string> words{ROTORUB_BINARY};
    words.insert(words.end(), arguments.begin(), arguments.end());
    process_ = fork();
    if (process_ == 0) become(words);
  }

  void interrupt(int signal = SIGINT) const { kill(process_, signal); }
  pid_t process() const { return process_; }
  Outcome kill_and_wait() const {
    kill(process_, SIGKILL);
    return wait();
  }

  Outcome wait() const {
    int status = 0;
    waitpid(process_, &status, 0);
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (surroundings_.out == kOut) outcome.out = read_text(folder_ / kOut);
    outcome.err = read_text(folder_ / kErr);
    return outcome;
  }

  static constexpr const char* kOut = "standard_output";
  static constexpr const char* kErr = "standard_error";

 private:
  [[noreturn]] void become(std::vector<std::string>& words) const {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    if (chdir(folder_.c_str()) != 0) _exit(127);
    if (surroundings_.obeys_modes) prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE);
    for (const auto& [name, value] : surroundings_.environment) {
      setenv(name.c_str(), value.c_str(), 1);
    }
    for (const auto& [name, stream] :
         {std::pair{surroundings_.out.c_str(), 1}, std::pair{kErr, 2}}) {
      dup2(open(name, O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
    }
    execv(argv[0], argv.data());
    _exit(127);
  }

  std::filesystem::path folder_;
  Surroundings surroundings_;
  pid_t process_ = -1;
};

// An empty folder in which the program runs.
class Folder : public TemporaryFolder {
 public:
  Outcome run(const std::vector<std::string>& arguments, Surroundings surroundings = {}) const {
    return Program(path(), arguments, std::move(surroundings)).wait();
  }
  // The same for a command that must succeed, and its JSON output.
  Outcome done(const std::vector<std::string>& arguments, Surroundings surroundings = {}) const {
    Outcome outcome = run(arguments, std::move(surroundings));
    EXPECT_EQ(outcome.code, 0) << testing::PrintToString(arguments) << outcome.out << outcome.err;
    return outcome;
  }
  // Refused: exit code 2, nothing on standard output, and a message that has these parts.
  void refuses(const std::vector<std::string>& arguments,
               std::initializer_list<std::string_view> parts = {}) const {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const Outcome refused = run(arguments);
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_EQ(refused.out, "");
    EXPECT_NE(refused.err, "");
    EXPECT_TRUE(contains(refused.err, parts));
  }
  json json_of(const std::vector<std::string>& arguments, Surroundings surroundings = {}) const {
    return json::parse(done(arguments, std::move(surroundings)).out);
  }
  json json_in(const std::string& file) const { return json::parse(text(file)); }
  std::string text(const std::string& file) const { return read_text(path() / file); }
  bool has(const std::string& file) const { return std::filesystem::exists(path() / file); }

  // All files below the folder, relative and sorted, except the program's own output.
  std::vector<std::string> files() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path())) {
      const std::string name = std::filesystem::relative(entry.path(), path()).string();
      if (!entry.is_regular_file() || name == Program::kOut || name == Program::kErr) continue;
      all.push_back(name);
    }
    std::sort(all.begin(), all.end());
    return all;
  }
};

inline std::string shipped(const std::string& scene) {
  return std::string(ROTORUB_MJCF_DIR) + "/" + scene + ".toml";
}

inline std::vector<std::string> with(std::vector<std::string> words,
                                     const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

inline std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// Expects that no temporary file is left.
inline void expect_whole_files(const Folder& folder) {
  for (const std::string& file : folder.files()) {
    EXPECT_FALSE(contains(file, ".part"));
  }
}

}  // namespace rotorub::test
