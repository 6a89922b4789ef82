// Runs a program with limits of time, memory and disk, because it may hang, fill them, or crash.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rotorub::test {

struct Limits {
  // Limits of processor time and of clock time. The first one decides, so that a busy machine
  // causes no failure; the second one ends a program that only waits.
  int processor_s = 10, clock_s = 90;
  std::size_t memory = std::size_t{6} << 30u;     // bytes of addresses
  std::size_t file_size = std::size_t{1} << 28u;  // bytes
};

struct Ended {
  int code = -1;         // exit code; -1: none
  int signal = 0;        // what ended it; SIGXCPU and SIGALRM: its limits of time
  std::string out, err;  // the first 16 MiB of each
};

// Runs in `folder`; standard output and standard error go to files beside it (`folder` + ".out",
// ".err").
Ended bounded_run(const std::filesystem::path& folder, std::vector<std::string> words,
                  const Limits& limits = {});

}  // namespace rotorub::test
