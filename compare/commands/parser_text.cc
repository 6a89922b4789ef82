#include "compare/commands/parser_text.h"

#include <CLI/CLI.hpp>
#include <boost/algorithm/string/split.hpp>
#include <string>
#include <utility>
#include <vector>

#include "compare/base/version.h"

namespace rotorub {
namespace {

// The parser describes a type as "TEXT:{native,mujoco}": the name of the value, and the accepted
// words.
void set_type(OptionText& option, const std::string& type) {
  const std::size_t words = type.find(":{");
  option.value = type.substr(0, words);
  if (words == std::string::npos) return;
  const std::string listed = type.substr(words + 2, type.find('}', words) - words - 2);
  boost::split(option.words, listed, [](char c) { return c == ','; });
}

std::vector<OptionText> options_of(const CLI::App& app) {
  std::vector<OptionText> positionals, options;
  for (const CLI::Option* option : app.get_options()) {
    OptionText text = option_text(*option);
    (text.positional ? positionals : options).push_back(std::move(text));
  }
  positionals.insert(positionals.end(), options.begin(), options.end());
  return positionals;
}

}  // namespace

OptionText option_text(const CLI::Option& option) {
  OptionText text;
  text.positional = option.get_positional();
  if (text.positional) {
    text.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  const bool flag = option.get_type_size() == 0;
  if (!flag) set_type(text, option.get_type_name());
  if (!flag) text.standard = option.get_default_str();
  for (const CLI::Option* other : option.get_needs()) text.needs.push_back(other->get_name());
  for (const CLI::Option* other : option.get_excludes()) text.excludes.push_back(other->get_name());
  text.description = option.get_description();
  text.required = option.get_required();
  text.repeats = text.positional && option.get_items_expected_max() > 1;
  return text;
}

ProgramText program_text(const CLI::App& program) {
  ProgramText text{program.get_name(),
                   program.get_description(),
                   "rotorub " + program_version(),
                   options_of(program),
                   {}};
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    text.commands.push_back(
        {command->get_name(), command->get_description(), options_of(*command)});
  }
  return text;
}

}  // namespace rotorub
