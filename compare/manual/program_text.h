// What the program says of itself, apart from who parses it: the parser's description of commands
// and options is the one source of help, manual page and completion.
#pragma once

#include <string>
#include <vector>

namespace rotorub {

struct OptionText {
  std::vector<std::string> names;  // "-o", "--output"; of a positional its name alone
  std::string value;               // "DIR", "TIME"; empty: a flag
  std::vector<std::string> words;  // the only values that are taken; empty: others
  std::string standard;  // its value where it is not given; empty: none, or the description says
  std::string description;
  bool positional = false, required = false;
};

struct CommandText {
  std::string name, description;
  std::vector<OptionText> options;  // positionals first
};

struct ProgramText {
  std::string name, description, version;
  std::vector<OptionText> options;
  std::vector<CommandText> commands;
};

// rotorub.1, for man: groff with the macros of man(7).
std::string man_page(const ProgramText& program);
// For bash: to be sourced, or installed to share/bash-completion/completions/rotorub.
std::string bash_completion(const ProgramText& program);

}  // namespace rotorub
