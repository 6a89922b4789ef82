#include "compare/sweep/shard.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace rotorub::sweep {

std::string Shard::file() const {
  return whole() ? "results.sqlite" : fmt::format("results.{}-of-{}.sqlite", number, count);
}

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.number);
  bool good = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  if (good) {
    const auto second = std::from_chars(first.ptr + 1, end, shard.count);
    good = second.ec == std::errc() && second.ptr == end;
  }
  if (!good || shard.count < 1 || shard.count > kMostShards || shard.number < 1 ||
      shard.number > shard.count) {
    throw std::invalid_argument(fmt::format(
        "--shard {}: expected i/n, part i of n, as 1/4 to 4/4 (n at most {})", text, kMostShards));
  }
  return shard;
}

namespace {

// Runs a command in the shell and returns its output and exit code.
std::pair<std::string, int> output_of(const std::string& command) {
  const auto close = [](std::FILE*) {};
  const std::unique_ptr<std::FILE, decltype(close)> pipe(popen(command.c_str(), "r"), close);
  if (!pipe) throw std::runtime_error("cannot start a shell for: " + command);
  std::string text;
  char block[4096];
  for (std::size_t n = 0; (n = std::fread(block, 1, sizeof block, pipe.get())) > 0;) {
    text.append(block, n);
  }
  const int status = pclose(pipe.get());
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return {text, WIFEXITED(status) ? WEXITSTATUS(status) : 128};
}

}  // namespace

std::string shell_word(const std::string& text) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  if (std::none_of(text.begin(), text.end(), control)) {
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
    return word + "'";
  }
  // In bash's form $'...' the word stays on one line, also within a comment.
  std::string word = "$'";
  for (const char c : text) {
    if (control(c)) {
      word += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      word += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
  }
  return word + "'";
}

std::string slurm_script(const SlurmJob& job) {
  std::string command =
      fmt::format("exec {} sweep {} \\\n  -o {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" --jobs {}",
                  shell_word(job.program.string()), shell_word(job.study.string()),
                  shell_word(job.folder.string()), job.tasks, job.jobs);
  if (job.allow_library) command += " --allow-library";
  for (const std::string& text : job.overrides) command += " \\\n  --set " + shell_word(text);
  return fmt::format(
      R"(#!/bin/bash
# Each task is a shard of the sweep with a file of its own; one that was stopped goes on.
#   all again:   sbatch sweep.sbatch           one of them:  sbatch --array=3 sweep.sbatch
#   join them:   {program} sweep {study} -o {folder} --merge {folder}
#SBATCH --job-name=rotorub-sweep
#SBATCH --array=1-{tasks}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={jobs}
#SBATCH --open-mode=append
#SBATCH --requeue
{command}
)",
      fmt::arg("program", shell_word(job.program.string())),
      fmt::arg("study", shell_word(job.study.string())),
      fmt::arg("folder", shell_word(job.folder.string())), fmt::arg("tasks", job.tasks),
      fmt::arg("jobs", job.jobs), fmt::arg("command", command));
}

std::string submit(const std::filesystem::path& script, const std::vector<int>& tasks) {
  std::string list;
  for (const int task : tasks) list += (list.empty() ? "" : ",") + std::to_string(task);
  // In a file name for sbatch, % begins a pattern and %% is a literal %.
  std::string log = (script.parent_path() / "slurm-").string();
  for (std::size_t at = log.find('%'); at != std::string::npos; at = log.find('%', at + 2)) {
    log.insert(at, "%");
  }
  const auto [text, code] =
      output_of(fmt::format("sbatch --parsable --array={} --output={} {} 2>&1", list,
                            shell_word(log + "%a.log"), shell_word(script.string())));
  if (code == 127) {
    throw std::runtime_error("sbatch is not found: --slurm needs Slurm's commands on the PATH; " +
                             script.string() + " is written");
  }
  if (code != 0) throw std::runtime_error("sbatch failed: " + text);
  return text.substr(0, text.find(';'));
}

}  // namespace rotorub::sweep
