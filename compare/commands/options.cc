#include "compare/commands/options.h"

#include <CLI/CLI.hpp>

namespace rotorub {

Option Option::required() const {
  option_->required();
  return *this;
}

Option Option::type(const std::string& name) const {
  option_->type_name(name);
  return *this;
}

Option Option::shows_default() const {
  option_->capture_default_str();
  return *this;
}

Option Option::repeats() const {
  option_->expected(1)->take_all()->allow_extra_args(false);
  return *this;
}

Option Option::needs(const Option& other) const {
  option_->needs(other.option_);
  return *this;
}

Option Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

Option Option::one_of(const std::vector<std::string>& words) const {
  option_->check(CLI::IsMember(words));
  return *this;
}

Option Option::between(std::int64_t least, std::int64_t most) const {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option Option::existing_file() const {
  option_->check(CLI::ExistingFile);
  return *this;
}

Option Option::check(const std::function<std::string(const std::string&)>& what_is_wrong) const {
  option_->check(what_is_wrong);
  return *this;
}

Option Option::transform(const std::function<std::string(const std::string&)>& replacement) const {
  option_->transform(replacement);
  return *this;
}

Option Option::each(const std::function<void(const std::string&)>& action) const {
  option_->each(action);
  return *this;
}

CLI::App& add_command(CLI::App& program, const char* name, const std::string& words) {
  return *program.add_subcommand(name, words);
}

template <typename Value>
Option add_option(CLI::App& command, const char* names, Value& value, const std::string& words) {
  return Option(*command.add_option(names, value, words));
}
template Option add_option(CLI::App&, const char*, std::string&, const std::string&);
template Option add_option(CLI::App&, const char*, int&, const std::string&);
template Option add_option(CLI::App&, const char*, std::vector<std::string>&, const std::string&);
template Option add_option(CLI::App&, const char*, std::vector<std::int64_t>&, const std::string&);

Option add_flag(CLI::App& command, const char* names, bool& value, const std::string& words) {
  return Option(*command.add_flag(names, value, words));
}

Option add_flag_callback(CLI::App& command, const char* names, const std::function<void()>& action,
                         const std::string& words) {
  return Option(*command.add_flag_callback(names, action, words));
}

Option get_option(CLI::App& command, const char* name) { return Option(*command.get_option(name)); }

}  // namespace rotorub
