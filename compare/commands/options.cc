#include "compare/commands/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"

namespace rotorub {

std::string no_such(std::string_view what, std::string_view word,
                    std::span<const std::string_view> accepted, std::string_view meant) {
  if (meant.empty()) meant = scene::nearest(word, accepted);
  return fmt::format("{}: no such {}{}hoose from {}", scene::printable(word), what,
                     meant.empty() ? "; c" : fmt::format(", did you mean {}? C", meant),
                     scene::join(accepted));
}

Option Option::required() const { return option_->required(); }
Option Option::type(const std::string& name) const { return option_->type_name(name); }
Option Option::shows_default() const { return option_->capture_default_str(); }
Option Option::repeats() const { return option_->expected(1)->take_all()->allow_extra_args(false); }
Option Option::needs(const Option& other) const { return option_->needs(other.option_); }
Option Option::excludes(const Option& other) const { return option_->excludes(other.option_); }

Option Option::one_of(const std::vector<std::string>& words) const {
  const std::vector<std::string> accepted = words;
  const auto wrong = [accepted](const std::string& given) -> std::string {
    const std::vector<std::string_view> all(accepted.begin(), accepted.end());
    if (std::find(all.begin(), all.end(), given) != all.end()) return {};
    return no_such("value", given, all);
  };
  return option_->check(CLI::Validator(wrong, fmt::format("{{{}}}", fmt::join(words, ","))));
}

Option Option::between(std::int64_t least, std::int64_t most) const {
  const auto wrong = [least, most](const std::string& given) -> std::string {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(given.data(), given.data() + given.size(), value);
    const bool whole = error == std::errc() && end == given.data() + given.size();
    if (whole && value >= least && value <= most) return {};
    return fmt::format("{}: expected a whole number from {} to {}", scene::printable(given), least,
                       most);
  };
  return option_->check(CLI::Validator(wrong, ""));
}

Option Option::check(const std::function<std::string(const std::string&)>& what_is_wrong) const {
  return option_->check(what_is_wrong);
}

Option Option::transform(const std::function<std::string(const std::string&)>& replacement) const {
  return option_->transform(replacement);
}

Option Option::each(const std::function<void(const std::string&)>& action) const {
  return option_->each(action);
}

CLI::App& add_command(CLI::App& program, const char* name, const std::string& words) {
  return *program.add_subcommand(name, words);
}

template <typename Value>
Option add_option(CLI::App& command, const char* names, Value& value, const std::string& words) {
  return command.add_option(names, value, words);
}
template Option add_option(CLI::App&, const char*, std::string&, const std::string&);
template Option add_option(CLI::App&, const char*, int&, const std::string&);
template Option add_option(CLI::App&, const char*, std::vector<std::string>&, const std::string&);
template Option add_option(CLI::App&, const char*, std::vector<std::int64_t>&, const std::string&);

Option add_flag(CLI::App& command, const char* names, bool& value, const std::string& words) {
  return command.add_flag(names, value, words);
}

}  // namespace rotorub
