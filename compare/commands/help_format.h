// The parser's help, no wider than a terminal of 80 columns.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace rotorub {

class HelpFormat : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

}  // namespace rotorub
