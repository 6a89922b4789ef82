#include "compare/commands/help_format.h"

#include <fmt/format.h>

#include "compare/base/format.h"

namespace rotorub {
namespace {

constexpr std::size_t kColumn = 26;  // where the words about a name begin

// A name and its words, which begin on the next line where the name is long.
std::string entry(const std::string& name, const std::string& words) {
  std::string lead = fmt::format("  {:<{}}", name, kColumn - 2);
  std::string before;
  if (lead.size() > kColumn || lead.back() != ' ') {
    before = wrapped("  ", name, 6);
    lead.assign(kColumn, ' ');
  }
  return before + wrapped(lead, words);
}

}  // namespace

std::string HelpFormat::make_description(const CLI::App* app) const {
  const std::string words = app->get_description();
  return words.empty() ? words : wrapped("", words);
}

std::string HelpFormat::make_option(const CLI::Option* option, bool is_positional) const {
  return entry(make_option_name(option, is_positional) + make_option_opts(option),
               make_option_desc(option));
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  return entry(command->get_name(), command->get_description());
}

}  // namespace rotorub
