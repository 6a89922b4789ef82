#include "compare/manual/program_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace rotorub {
namespace {

// Escapes text for groff, so that hyphens stay hyphens and no line is read as a request.
std::string printed(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return (result.starts_with('.') || result.starts_with('\'') ? "\\&" : "") + result;
}

std::string bold(const std::string& text) { return "\\fB" + printed(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + printed(text) + "\\fR"; }

std::string option_entry(const OptionText& option) {
  std::string head;
  for (const std::string& name : option.names) {
    head += (head.empty() ? "" : ", ") + (option.positional ? italic(name) : bold(name));
  }
  if (!option.positional && !option.value.empty()) head += " " + italic(option.value);
  std::string text = ".TP\n" + head + "\n" + printed(option.description);
  if (!option.words.empty()) {
    std::string words;
    for (const std::string& word : option.words) words += (words.empty() ? "" : ", ") + bold(word);
    text += "\n.br\nOne of " + words + ".";
  }
  if (!option.standard.empty()) text += "\n.br\nDefault: " + bold(option.standard) + ".";
  const std::string conditions = conditions_of(option);
  if (!conditions.empty()) text += "\n.br\n" + printed(conditions);
  return text + "\n";
}

std::string synopsis(const std::string& program, const CommandText& command) {
  std::string text =
      ".br\n" + bold(program) + " " + bold(command.name) + " [" + italic("OPTIONS") + "]";
  for (const OptionText& option : command.options) {
    if (!option.positional) continue;
    const std::string name = italic(option.names.front()) + (option.repeats ? " ..." : "");
    text += option.required ? " " + name : " [" + name + "]";
  }
  return text + "\n";
}

constexpr const char* kExitStatus = R"(.SH EXIT STATUS
.TP
.B 0
Done. For
.BR compare :
within the tolerance.
.TP
.B 1
.BR compare :
outside the tolerance;
.BR check :
a native case violates its rules;
.BR tune :
no setting can be trusted.
.TP
.B 2
Usage or bad input, with file, line, key and reason.
.TP
.B 3
The run failed, or output could not be written.
.TP
.BR 130 ", " 143
Stopped by Ctrl-C or SIGTERM; the results so far are kept.
)";

constexpr const char* kRest = R"(.SH ENVIRONMENT
.TP
.B ROTORUB_CONTROLLER_PATH
Folders, separated by :, whose libraries a scene or an MJCF may load as controllers.
Without it a scene needs
.BR \-\-allow\-library ,
and an MJCF loads no library.
.SH FILES
.TP
.I SCENE.toml
One rotor, its auxiliary bearing and a run, in SI units;
.B rotorub init
writes one,
.B rotorub schema
lists every table and key.
.TP
.I librotorub_mujoco.so
Preloaded with LD_PRELOAD, the plugin lets any MuJoCo program run the output of
.BR "rotorub mjcf" .
.SH EXAMPLES
.nf
rotorub init rotor \-\-speed "3000 rpm"
rotorub run rotor.toml \-\-set contact.friction=0.3
rotorub compare rotor.toml \-o report
.fi
)";

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

bool names_a_file(const std::string& value) {
  return value.find("FILE") != std::string::npos || value.find("DIR") != std::string::npos;
}

// The values that may follow each option, as branches of a case on "command option".
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

std::string conditions_of(const OptionText& option) {
  std::string text;
  if (!option.needs.empty()) text += fmt::format("Only with {}.", fmt::join(option.needs, " and "));
  if (!option.excludes.empty()) {
    text +=
        fmt::format("{}Not with {}.", text.empty() ? "" : " ", fmt::join(option.excludes, " or "));
  }
  return text;
}

std::string man_page(const ProgramText& program) {
  std::string title = program.name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string text =
      fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", title, program.version);
  text += ".SH NAME\n" + program.name + " \\- " + printed(program.description) +
          "\n.SH SYNOPSIS\n" + bold(program.name) + " [" + bold("--help") + " | " +
          bold("--version") + "]\n";
  for (const CommandText& command : program.commands) text += synopsis(program.name, command);
  text += ".SH OPTIONS\n";
  for (const OptionText& option : program.options) text += option_entry(option);
  text += ".SH COMMANDS\n";
  for (const CommandText& command : program.commands) {
    text += ".SS " + command.name + "\n" + printed(command.description) + ".\n";
    for (const OptionText& option : command.options) text += option_entry(option);
  }
  return text + kExitStatus + kRest;
}

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
