// The program's description of its commands and options, independent of the parser. Help, manual
// page and completion all come from it.
#pragma once

#include <string>
#include <vector>

namespace rotorub {

struct OptionText {
  std::vector<std::string> names;  // "-o", "--output"; for a positional only its name
  std::string value;               // "DIR", "TIME"; empty for a flag
  std::vector<std::string> words;  // the only accepted values; empty if there are others
  std::string standard;            // default; empty if there is none or the description states it
  std::vector<std::string> needs, excludes;  // names of options that must, or must not, be given
  std::string description;
  bool positional = false, required = false;
  bool repeats = false;  // a positional that may be given several times
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

// "Only with --output." and "Not with --gif or --png."; empty for an option that stands alone.
std::string conditions_of(const OptionText& option);

// rotorub.1, for man: groff with the macros of man(7).
std::string man_page(const ProgramText& program);
// For bash: to be sourced or installed as share/bash-completion/completions/rotorub.
std::string bash_completion(const ProgramText& program);

}  // namespace rotorub
