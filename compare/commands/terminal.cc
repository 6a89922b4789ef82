#include "compare/commands/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "compare/base/format.h"

namespace rotorub {
namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

bool is_terminal(std::FILE* stream) { return isatty(fileno(stream)) == 1; }

Palette palette_of(std::FILE* stream) {
  return Palette(is_terminal(stream) && variable("NO_COLOR").empty() && variable("TERM") != "dumb");
}

int columns_of(std::FILE* stream) {
  winsize size{};
  if (ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return static_cast<int>(kTerminalWidth);
}

}  // namespace rotorub
