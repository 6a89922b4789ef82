#include "compare/commands/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>

#include "compare/base/format.h"
#include "compare/base/version.h"
#include "compare/commands/terminal.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

// A name and its description, which begins on the next line if the name is long.
std::string entry(const std::string& name, const std::string& words) {
  constexpr std::size_t kColumn = 26;  // where descriptions begin
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

// The command that the word is a misspelling or the beginning of; empty if there is none.
std::string_view meant(std::string_view word, const std::vector<std::string_view>& commands) {
  const std::string_view near = scene::nearest(word, commands);
  if (!near.empty() || word.size() < 2) return near;
  const auto begun = std::find_if(commands.begin(), commands.end(), [&](std::string_view command) {
    return command.starts_with(word);
  });
  return begun == commands.end() ? std::string_view() : *begun;
}

// Detects an empty value, for example from an unset variable in a script, and "-o=DIR", which would
// name a folder "=DIR". Empty if there is none.
std::string empty_value(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      if (value.empty() || value == "=") return option->get_name() + ": its value is empty";
      if (value.starts_with('='))
        return fmt::format("{0} {1}: accepted is {0} {2}", option->get_name(), value,
                           value.substr(1));
    }
  }
  return {};
}

// The parser's messages: help and version on standard output, errors on standard error.
int parser_exit(const CLI::App& program, const CLI::ParseError& error) {
  std::ostringstream out, err;
  const int code = program.exit(error, out, err) == 0 ? kDone : kBadInput;
  std::cout << out.str();
  if (!err.str().empty()) std::cerr << printable_lines(err.str()) << "\n";
  return code;
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

CommandLine::CommandLine()
    : program_(std::make_unique<CLI::App>(
          "A flexible rotor rubbing in an active auxiliary bearing, in MuJoCo and in a "
          "native rigid-contact model",
          "rotorub")) {
  // Before the commands, so that they inherit it.
  program_->formatter(std::make_shared<HelpFormat>());
  program_->set_version_flag("--version", version_line());
  program_->require_subcommand(1);
}

CommandLine::~CommandLine() = default;

CommandLine::Request CommandLine::parse(const std::vector<Command>& commands,
                                        std::vector<std::string> arguments) {
  // Set after the commands, so that they do not inherit it.
  program_->footer("`rotorub help COMMAND` lists the options of a command.");
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.app->get_name());
  arguments = with_help(std::move(arguments));
  if (const std::string wrong = unknown_command(arguments, names); !wrong.empty())
    throw UsageError(wrong);
  std::reverse(arguments.begin(), arguments.end());  // the parser expects them reversed
  try {
    program_->parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    return {nullptr, parser_exit(*program_, error)};
  }
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    if (const std::string wrong = empty_value(*command.app); !wrong.empty())
      throw UsageError(wrong);
    return {&command, kDone};
  }
  return {};
}

}  // namespace rotorub
