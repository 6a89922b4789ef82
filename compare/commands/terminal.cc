#include "compare/commands/terminal.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "compare/base/format.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

using namespace std::chrono_literals;
constexpr auto kPatience = 2s;  // shorter tasks show nothing
constexpr auto kRefresh = 100ms;
constexpr auto kLineEvery = 5s;
constexpr int kWidth = 28;

std::string lead = "rotorub: ";  // of messages on standard error

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

bool is_terminal(std::FILE* stream) { return isatty(fileno(stream)) == 1; }

// Width of the terminal; 80 if it is unknown.
int columns_of(std::FILE* stream) {
  winsize size{};
  if (ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return static_cast<int>(kTerminalWidth);
}

// The message line by line, with each line made printable, because it may quote the user's input.
std::string printable_lines(const std::string& message) {
  constexpr std::size_t kLongestLine = 1000;  // bytes
  std::istringstream lines(message);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    text += (text.empty() ? "" : "\n") + scene::printable(line, kLongestLine);
  }
  return text;
}

}  // namespace

Palette palette_of(std::FILE* stream) {
  return Palette(is_terminal(stream) && variable("NO_COLOR").empty() && variable("TERM") != "dumb");
}

std::string printable_path(const std::filesystem::path& path) {
  constexpr std::size_t kLongestPath = 4096;  // bytes, as PATH_MAX
  return scene::printable(path.string(), kLongestPath);
}

void set_command_name(const std::string& command) { lead = fmt::format("rotorub {}: ", command); }

void print_message(const std::string& message) { print_diagnostics(printable_lines(message)); }

void print_diagnostics(const std::string& message) {
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);) fmt::print(stderr, "{}{}\n", lead, line);
}

std::string progress_bar(double share, double seconds, const std::string& what, int columns) {
  share = std::clamp(share, 0.0, 1.0);
  const auto full = static_cast<std::size_t>(share * kWidth);
  const std::string bar = fmt::format("[{}{}] {:3.0f} %  {:.0f} s  ", std::string(full, '='),
                                      std::string(kWidth - full, ' '), 100.0 * share, seconds);
  // The last column stays free, because some terminals wrap as soon as it is written.
  const auto room = static_cast<std::size_t>(std::max(columns - 1, 0));
  constexpr std::size_t kCut = 3;  // "..."
  if (bar.size() + kCut >= room) return bar.substr(0, room);
  return bar + scene::printable(what, room - bar.size() - kCut);
}

ProgressBar::ProgressBar(bool quiet)
    : on_terminal_(!quiet && is_terminal(stderr)),
      lines_(!quiet && !on_terminal_ && variable("ROTORUB_PROGRESS") == "lines"),
      start_(Clock::now()),
      last_(start_) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(double share, const std::string& what) {
  if (lines_) show_line(share, what);
  if (!on_terminal_) return;
  const auto now = Clock::now();
  if (now - last_ < kRefresh || now - start_ < kPatience) return;
  last_ = now;
  const double passed = std::chrono::duration<double>(now - start_).count();
  fmt::print(stderr, "\r\033[K{}", progress_bar(share, passed, what, columns_of(stderr)));
  drawn_ = true;
  std::fflush(stderr);
}

std::function<void(double, const std::string&)> ProgressBar::part(std::size_t k, std::size_t n,
                                                                  const std::string& name) {
  return [this, k, n, name](double share, const std::string& what) {
    show((static_cast<double>(k) + share) / static_cast<double>(n), name + ": " + what);
  };
}

void ProgressBar::show_line(double share, const std::string& what) {
  const auto now = Clock::now();
  if (wrote_line_ && now - last_ < kLineEvery) return;
  wrote_line_ = true;
  last_ = now;
  fmt::print(stderr, "{:3.0f} %  {}\n", 100.0 * std::clamp(share, 0.0, 1.0),
             scene::printable(what, kTerminalWidth));
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace rotorub
