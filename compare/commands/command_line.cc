#include "compare/commands/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string_view>

#include "compare/base/format.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

// A name and its words, which begin on the next line where the name is long.
std::string entry(const std::string& name, const std::string& words) {
  constexpr std::size_t kColumn = 26;  // where the words begin
  std::string lead = fmt::format("  {:<{}}", name, kColumn - 2);
  std::string before;
  if (lead.size() > kColumn || lead.back() != ' ') {
    before = wrapped("  ", name, 6);
    lead.assign(kColumn, ' ');
  }
  return before + wrapped(lead, words);
}

class HelpFormat : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override {
    const std::string words = app->get_description();
    return words.empty() ? words : wrapped("", words);
  }
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option));
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_name(), command->get_description());
  }
};

// The command that a word is a slip of, or the beginning of; empty: none.
std::string_view meant(std::string_view word, const std::vector<std::string_view>& commands) {
  const std::string_view near = scene::nearest(word, commands);
  if (!near.empty() || word.size() < 2) return near;
  const auto begun = std::find_if(commands.begin(), commands.end(), [&](std::string_view command) {
    return command.starts_with(word);
  });
  return begun == commands.end() ? std::string_view() : *begun;
}

}  // namespace

void set_help_format(CLI::App& program) { program.formatter(std::make_shared<HelpFormat>()); }

std::vector<std::string> with_help(std::vector<std::string> arguments) {
  if (arguments.empty() || arguments[0] != "help") return arguments;
  arguments.erase(arguments.begin());
  if (arguments.size() > 1) arguments.resize(1);
  arguments.push_back("--help");
  return arguments;
}

std::string unknown_command(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& commands) {
  const std::vector<std::string_view> words(commands.begin(), commands.end());
  const std::string all = scene::join(words);
  if (arguments.empty()) return "no command given; accepted are " + all;
  const std::string& word = arguments[0];
  if (word.starts_with("-") || std::find(words.begin(), words.end(), word) != words.end())
    return {};
  const std::string_view near = meant(word, words);
  return fmt::format("{}: no such command{}; accepted are {}", scene::printable(word),
                     near.empty() ? "" : fmt::format(", did you mean {}?", near), all);
}

}  // namespace rotorub
