// What a stream is written to, and how far long work is.
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

#include "compare/base/palette.h"

namespace rotorub {

// Colours on a terminal that has them, unless NO_COLOR is set to something (no-color.org).
Palette palette_of(std::FILE* stream);

// The message line by line, each as a terminal can show it: a message may quote what the user
// wrote.
std::string printable_lines(const std::string& message);
// The same of a file or a folder that the user named, whole.
std::string printable_path(const std::filesystem::path& path);

// How far a long piece of work is, on standard error: on a terminal a bar, from two seconds on;
// elsewhere nothing, or with ROTORUB_PROGRESS=lines in the environment a line at once and every
// five seconds.
class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // share: done of the whole, in [0, 1]. Cheap to call often.
  void show(double share, const std::string& what);
  // Wipes the bar away, so that other text can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void show_line(double share, const std::string& what);

  bool on_terminal_, lines_;
  bool wrote_line_ = false;
  bool drawn_ = false;
  Clock::time_point start_, last_;
};

// A bar of at most so many columns: "[=====     ]  50 %  12 s  what", cut where it would wrap.
std::string progress_bar(double share, double seconds, const std::string& what, int columns);

}  // namespace rotorub
