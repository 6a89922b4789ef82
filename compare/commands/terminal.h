// The properties of an output stream, and a progress bar.
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>

#include "compare/base/palette.h"

namespace rotorub {

// Colours on a terminal that supports them, unless NO_COLOR is set and not empty (no-color.org).
Palette palette_of(std::FILE* stream);

// The full path of a file or folder from the user, made printable.
std::string printable_path(const std::filesystem::path& path);

// The command that this process runs, "run": its messages on standard error begin with
// "rotorub run: ". Before the first call they begin with "rotorub: ".
void set_command_name(const std::string& command);
// Writes the message to standard error after those words, line by line printable.
void print_message(const std::string& message);
// Writes each line, which is printable already, after those words.
void print_diagnostics(const std::string& message);

// Progress of a long task on standard error. On a terminal it is a bar, shown after two seconds.
// Elsewhere nothing is shown, or with ROTORUB_PROGRESS=lines in the environment a line at once and
// then every five seconds.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // share: fraction done, in [0, 1]. Cheap to call often.
  void show(double share, const std::string& what);
  // A function that shows the fraction done of the k-th of n equal parts, "ring: event".
  std::function<void(double, const std::string&)> part(std::size_t k, std::size_t n,
                                                       const std::string& name);
  // Erases the bar, so that other text can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void show_line(double share, const std::string& what);

  bool on_terminal_, lines_;
  bool wrote_line_ = false;
  bool drawn_ = false;
  Clock::time_point start_, last_;
};

// A bar of at most `columns` columns: "[=====     ]  50 %  12 s  what", truncated if necessary.
std::string progress_bar(double share, double seconds, const std::string& what, int columns);

}  // namespace rotorub
