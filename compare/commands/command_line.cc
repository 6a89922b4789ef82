#include "compare/commands/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <string_view>
#include <utility>

#include "compare/base/format.h"
#include "compare/base/version.h"
#include "compare/commands/options.h"
#include "compare/commands/parser_text.h"
#include "compare/commands/terminal.h"
#include "native_model/control/library_file.h"
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
  std::string make_option(const CLI::Option* option, bool) const override {
    const OptionText text = option_text(*option);
    std::string name = fmt::format("{}", fmt::join(text.names, ","));
    if (!text.words.empty()) {
      name += fmt::format(" {}", fmt::join(text.words, "|"));
    } else if (!text.positional && !text.value.empty()) {
      name += " " + text.value;
    }
    std::string words = text.description;
    if (!text.standard.empty()) words += fmt::format(" (default: {})", text.standard);
    const std::string conditions = conditions_of(text);
    if (!conditions.empty()) words += (words.ends_with('.') ? " " : ". ") + conditions;
    return entry(name, words);
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
      if (value.empty() || value == "=")
        return option->get_name() + ": the value is empty; give one, or leave the option out";
      if (value.starts_with('='))
        return fmt::format("{0}{1}: write {0} {2}", option->get_name(), value, value.substr(1));
    }
  }
  return {};
}

// Describes the first argument that the command does not know.
std::string unknown_argument(const CLI::App& command, const std::vector<std::string>& unknown) {
  const auto option = std::find_if(unknown.begin(), unknown.end(),
                                   [](const std::string& word) { return word.starts_with('-'); });
  // "--set KEY VALUE": the parser takes VALUE as an argument of its own.
  const CLI::Option* set = command.get_option_no_throw("--set");
  if (option == unknown.end() && set != nullptr && !set->results().empty() &&
      set->results().back().find('=') == std::string::npos) {
    return fmt::format("write --set {}={}", scene::printable(set->results().back()),
                       scene::printable(unknown.front()));
  }
  if (option == unknown.end())
    return fmt::format("{}: unexpected argument", scene::printable(unknown.front()));
  const std::string word = option->substr(0, option->find('='));
  std::vector<std::string> names;
  for (const CLI::Option* one : command.get_options()) {
    const OptionText text = option_text(*one);
    if (!text.positional) names.insert(names.end(), text.names.begin(), text.names.end());
  }
  if (word == "--controller" && command.get_name() == "fmu") {
    return "fmu does not load controllers; export the scene and connect yours to command_x and "
           "command_y";
  }
  const std::string_view near =
      scene::nearest(word, std::vector<std::string_view>(names.begin(), names.end()));
  return fmt::format("{}: no such option{}", scene::printable(word),
                     near.empty() ? "" : fmt::format(", did you mean {}?", near));
}

// The parser's message about the options of a command, in the words of this program.
std::string parser_message(const CLI::App& command, const CLI::ParseError& error) {
  const std::string said = error.what(), kind = error.get_name();
  if (kind == "ValidationError") return said;
  // The messages begin with the option's name, or have it after these words.
  constexpr std::string_view kConversion = "Could not convert: ";
  if (kind == "ConversionError" && said.starts_with(kConversion)) {
    const std::string rest = said.substr(kConversion.size());
    const std::size_t sign = rest.find(" = ");
    return fmt::format("{} {}: expected a whole number", rest.substr(0, sign),
                       sign == std::string::npos ? "" : scene::printable(rest.substr(sign + 3)));
  }
  std::string message = said;
  const std::string name = said.substr(0, said.find_first_of(": "));
  const CLI::Option* option = command.get_option_no_throw(name);
  if (const std::vector<std::string> unknown = command.remaining(true); !unknown.empty()) {
    message = unknown_argument(command, unknown);
  } else if (kind == "ArgumentMismatch" && option) {
    message = fmt::format("{}: the value {} is missing", name, option_text(*option).value);
  } else if (const std::size_t at = said.find(" excludes "); kind == "ExcludesError" && option) {
    message = fmt::format("Give either {} or {}, not both", name, said.substr(at + 10));
  } else if (kind == "RequiredError" && option) {
    message = fmt::format("the argument {} is missing", name);
  }
  const bool is_command = command.get_parent() != nullptr;
  return fmt::format("{}{} `rotorub help{}{}` shows the usage", message,
                     message.ends_with('?') ? "" : ".", is_command ? " " : "",
                     is_command ? command.get_name() : "");
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
  if (arguments.empty()) return "no command is given; choose from " + scene::join(words);
  const std::string& word = arguments[0];
  if (word.starts_with("-") || std::find(words.begin(), words.end(), word) != words.end())
    return {};
  return no_such("command", word, words, meant(word, words));
}

std::shared_ptr<CLI::App> new_program() {
  auto program = std::make_shared<CLI::App>(
      "Simulates a flexible rotor that rubs in its auxiliary bearing, in MuJoCo and in a "
      "native "
      "model with rigid contact",
      "rotorub");
  // Before the commands, so that they inherit it.
  program->formatter(std::make_shared<HelpFormat>());
  program->set_version_flag("--version", version_line());
  program->require_subcommand(1);
  return program;
}

Action parse(CLI::App& program, const std::vector<Command>& commands,
             std::vector<std::string> arguments) {
  // Set after the commands, so that they do not inherit it.
  program.footer("`rotorub help COMMAND` lists the options of a command.");
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.app->get_name());
  arguments = with_help(std::move(arguments));
  if (const std::string wrong = unknown_command(arguments, names); !wrong.empty())
    throw UsageError(wrong);
  const std::string first = arguments[0];
  std::reverse(arguments.begin(), arguments.end());  // the parser expects them reversed
  const auto named = std::find_if(commands.begin(), commands.end(), [&](const Command& command) {
    return command.app->get_name() == first;
  });
  if (named != commands.end()) set_command_name(first);
  try {
    program.parse(std::move(arguments));
  } catch (const CLI::Success& wish) {
    const int code = program.exit(wish, std::cout, std::cerr);
    return [code] { return code; };
  } catch (const CLI::ParseError& error) {
    throw UsageError(parser_message(named == commands.end() ? program : *named->app, error));
  }
  const auto parsed = std::find_if(commands.begin(), commands.end(),
                                   [](const Command& command) { return command.app->parsed(); });
  if (const std::string wrong = empty_value(*parsed->app); !wrong.empty()) throw UsageError(wrong);
  const CLI::Option* allow = parsed->app->get_option_no_throw("--allow-library");
  if (!allow) set_scene_libraries(SceneLibraries::kLeftOut);
  if (allow && allow->count() > 0) set_scene_libraries(SceneLibraries::kAllowed);
  return parsed->action;
}

}  // namespace rotorub
