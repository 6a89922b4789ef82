#include <fmt/format.h>

#include "compare/manual/program_text.h"

namespace rotorub {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

bool names_a_file(const std::string& value) {
  return value.find("FILE") != std::string::npos || value.find("DIR") != std::string::npos;
}

// What may follow each option that takes a value, as branches of a case on "command option".
std::string value_branches(const CommandText& command) {
  std::string text;
  for (const OptionText& option : command.options) {
    if (option.positional || option.value.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names)
      patterns.push_back("'" + command.name + " " + name + "'");
    const std::string words =
        option.words.empty() ? "" : fmt::format("-W '{}'", joined(option.words, " "));
    const char* files = names_a_file(option.value) ? "-f" : "";
    const std::string answer =
        words.empty() && *files == '\0'
            ? "return"
            : fmt::format("mapfile -t COMPREPLY < <(compgen {}{} -- \"$word\"); return", words,
                          files);
    text += fmt::format("    {}) {} ;;\n", joined(patterns, "|"), answer);
  }
  return text;
}

std::string option_branch(const CommandText& command) {
  std::vector<std::string> names;
  for (const OptionText& option : command.options) {
    if (!option.positional) names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return fmt::format("    {}) words='{}' ;;\n", command.name, joined(names, " "));
}

}  // namespace

std::string bash_completion(const ProgramText& program) {
  std::vector<std::string> commands, options;
  std::string values, names;
  for (const CommandText& command : program.commands) {
    commands.push_back(command.name);
    values += value_branches(command);
    names += option_branch(command);
  }
  for (const OptionText& option : program.options)
    options.insert(options.end(), option.names.begin(), option.names.end());
  return fmt::format(
      R"(# Completion of {0} in bash: commands, options, the words that an option takes, files.
_{0}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command='' words='' i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${{COMP_WORDS[i]}} in
    {1}) command=${{COMP_WORDS[i]}}; break ;;
    esac
  done
  if [[ -z $command ]]; then
    mapfile -t COMPREPLY < <(compgen -W '{2} help {3}' -- "$word")
    return
  fi
  case "$command $before" in
{4}  esac
  case $command in
{5}  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  elif [[ $before == help ]]; then
    mapfile -t COMPREPLY < <(compgen -W '{2}' -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F _{0} {0}
)",
      program.name, joined(commands, "|"), joined(commands, " "), joined(options, " "), values,
      names);
}

}  // namespace rotorub
