// Adds commands and options to the program's parser, CLI11. Only options.cc, command_line.cc and
// parser_text.cc include it, because it takes more than ten seconds to compile.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rotorub {

// "verlt: no such value, did you mean verlet? Choose from event, verlet, euler". meant: the word
// that is meant; empty: the nearest one, if one is near.
std::string no_such(std::string_view what, std::string_view word,
                    std::span<const std::string_view> accepted, std::string_view meant = {});

// An option that was added to a command. Each function adds a property and returns the option, so
// that calls can be chained.
class Option {
 public:
  Option(CLI::Option* option) : option_(option) {}

  Option required() const;
  Option type(const std::string& name) const;  // name of its value in the help, "TIME"
  Option shows_default() const;                // the help shows its present value
  Option repeats() const;                      // may be given several times, with one value each

  Option needs(const Option& other) const;
  Option excludes(const Option& other) const;

  // Restricts what is accepted. Checks run in the order in which they were added.
  Option one_of(const std::vector<std::string>& words) const;
  Option between(std::int64_t least, std::int64_t most) const;  // including both ends
  // The check returns an error message, or an empty string.
  Option check(const std::function<std::string(const std::string&)>& what_is_wrong) const;

  // Replaces the given text; the result is checked and stored.
  Option transform(const std::function<std::string(const std::string&)>& replacement) const;
  // Called with each value that passed the checks added before.
  Option each(const std::function<void(const std::string&)>& action) const;

 private:
  CLI::Option* option_;
};

CLI::App& add_command(CLI::App& program, const char* name, const std::string& words);

// names: "-o,--output", or "SCENE" for a positional. value: holds the default, and must live until
// the command has run. Value is a std::string, an int, or a std::vector of std::string or
// std::int64_t.
template <typename Value>
Option add_option(CLI::App& command, const char* names, Value& value, const std::string& words);
// The same, with `type` as the name of the value in the help.
template <typename Value>
Option add_value(CLI::App& command, const char* names, Value& value, const char* type,
                 const std::string& words) {
  return add_option(command, names, value, words).type(type);
}
// An option without a value; "!--no-NAME" sets false.
Option add_flag(CLI::App& command, const char* names, bool& value, const std::string& words);

}  // namespace rotorub
