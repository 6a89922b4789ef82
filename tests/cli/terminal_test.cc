// The program on a terminal, and the wording of its command line.
#include <gtest/gtest.h>
#include <pty.h>

#include <sstream>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

// A pseudo-terminal whose other end is read here.
class Terminal {
 public:
  Terminal() {
    char name[128];
    EXPECT_EQ(openpty(&master_, &slave_, name, nullptr, nullptr), 0);
    name_ = name;
    fcntl(master_, F_SETFL, O_NONBLOCK);
  }
  ~Terminal() {
    close(master_);
    close(slave_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  std::string shown(const std::vector<std::string>& arguments,
                    std::vector<std::pair<std::string, std::string>> environment) {
    const Folder folder;
    const Outcome outcome = folder.done(arguments, {std::move(environment), name_});
    std::string text;
    char buffer[4096];
    for (ssize_t n = 0; (n = read(master_, buffer, sizeof buffer)) > 0;) {
      text.append(buffer, static_cast<std::size_t>(n));
    }
    return text;
  }

 private:
  int master_ = -1, slave_ = -1;
  std::string name_;
};

const std::vector<std::string> kShortRun{"run", shipped("bench_drop"), "--end", "1ms", "-o", "out"};

TEST(CliTerminal, OutcomesHaveColoursThere) {
  Terminal terminal;
  EXPECT_TRUE(contains(terminal.shown(kShortRun, {{"TERM", "xterm"}, {"NO_COLOR", ""}}),
                       "\033[1;32mok\033[0m"));
}

TEST(CliTerminal, OnlyATerminalGetsColours) {
  Terminal terminal;
  EXPECT_FALSE(contains(terminal.shown(kShortRun, {{"TERM", "xterm"}, {"NO_COLOR", "1"}}), "\033"));
  EXPECT_FALSE(contains(terminal.shown(kShortRun, {{"TERM", "dumb"}, {"NO_COLOR", ""}}), "\033"));
  const Folder folder;
  const Outcome file = folder.run(kShortRun, {{{"TERM", "xterm"}, {"NO_COLOR", ""}}});
  EXPECT_TRUE(contains(file.out, "bench_drop: ok"));
  EXPECT_FALSE(contains(file.out, "\033"));
}

TEST(CliTerminal, HelpFitsEightyColumns) {
  const Folder folder;
  for (const char* command : {"", "run", "compare", "modes", "mjcf", "render", "bench", "sweep",
                              "check", "tune", "plot", "init"}) {
    std::vector<std::string> words{"help"};
    if (*command) words.push_back(command);
    std::istringstream help(folder.run(words).out);
    int lines = 0;
    for (std::string line; std::getline(help, line); ++lines) {
      const auto wide =
          std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
      EXPECT_LE(wide, 80) << command << ": " << line;
    }
    EXPECT_GT(lines, 8) << command;
  }
}

TEST(CliTerminal, EventHasNoStepOfZero) {
  const Folder folder;
  const Outcome event = folder.run(kShortRun);
  EXPECT_FALSE(contains(event.out, "step 0 s"));
  EXPECT_TRUE(contains(event.out, "adaptive steps"));
  const Outcome verlet = folder.run(with(kShortRun, {"--integrator", "verlet", "--step", "10us"}));
  EXPECT_TRUE(contains(verlet.out, "step 10 µs"));
}

}  // namespace
}  // namespace rotorub::test
