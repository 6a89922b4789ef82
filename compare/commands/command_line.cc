#include "compare/commands/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "native_model/scene/printable.h"

namespace rotorub {
namespace {

// Insertions, deletions and replacements from one to the other (Levenshtein).
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> with_help(std::vector<std::string> arguments) {
  if (arguments.empty() || arguments[0] != "help") return arguments;
  arguments.erase(arguments.begin());
  if (arguments.size() > 1) arguments.resize(1);
  arguments.push_back("--help");
  return arguments;
}

std::string unknown_command(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& commands) {
  std::string all;
  for (const std::string& command : commands) all += (all.empty() ? "" : ", ") + command;
  if (arguments.empty()) return "no command given; accepted are " + all;
  if (arguments[0].starts_with("-")) return {};
  const std::string& word = arguments[0];
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) return {};
  std::string nearest;
  std::size_t least = 3;  // more than two slips is another word
  for (const std::string& command : commands) {
    const std::size_t slips = distance(word.substr(0, 20), command);
    const bool starts = word.size() > 1 && command.starts_with(word);
    if (slips < least && slips < command.size()) {
      least = slips;
      nearest = command;
    } else if (starts && nearest.empty()) {
      nearest = command;
    }
  }
  return fmt::format("{}: no such command{}; accepted are {}", scene::printable(word),
                     nearest.empty() ? "" : fmt::format(", did you mean {}?", nearest), all);
}

}  // namespace rotorub
