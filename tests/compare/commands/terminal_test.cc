// Output on a terminal: progress that fits its width, colours, and help for misspelt commands.
#include <gtest/gtest.h>

#include "compare/base/palette.h"
#include "compare/commands/command_line.h"
#include "compare/commands/terminal.h"

namespace rotorub {
namespace {

using Words = std::vector<std::string>;

TEST(ProgressBar, FitsTheTerminal) {
  const std::string what =
      "paper_passive: mujoco coulomb, implicit, a quarter of the step, twin 7 of 20";
  for (const int columns : {200, 80, 60, 50, 46, 20, 1}) {
    const std::string bar = progress_bar(0.5, 123.0, what, columns);
    EXPECT_LT(bar.size(), static_cast<std::size_t>(columns)) << bar;
  }
  EXPECT_EQ(progress_bar(0.5, 12.0, "modes", 80),
            "[==============              ]  50 %  12 s  modes");
  EXPECT_NE(progress_bar(2.0, 0.0, "", 80).find(" 100 %"), std::string::npos)
      << "never more than all";
}

TEST(Palette, ColoursNothingWhereItHasNone) {
  const Palette none, some(true);
  EXPECT_EQ(none.paint(Tone::kBad, "no"), "no");
  EXPECT_EQ(none.paint_first(Tone::kBad, "rigid no", "no"), "rigid no");
  EXPECT_EQ(some.paint(Tone::kPlain, "no"), "no");
  EXPECT_EQ(some.paint_first(Tone::kBad, "rigid no, no", "no"), "rigid \033[1;31mno\033[0m, no");
  EXPECT_EQ(some.paint_first(Tone::kGood, "rigid", "no"), "rigid");
}

TEST(CommandLine, NamesTheNearestCommand) {
  const Words commands{"run",   "compare", "modes", "mjcf", "render",
                       "bench", "sweep",   "check", "tune"};
  const auto wrong = [&](const char* word) { return unknown_command({word, "a.toml"}, commands); };
  EXPECT_EQ(wrong("run"), "");
  EXPECT_EQ(wrong("--help"), "");
  EXPECT_NE(unknown_command({}, commands).find("no command is given; choose from run"),
            std::string::npos);
  EXPECT_NE(wrong("comapre").find("did you mean compare?"), std::string::npos) << wrong("comapre");
  EXPECT_NE(wrong("comp").find("did you mean compare?"), std::string::npos) << wrong("comp");
  EXPECT_NE(wrong("mode").find("did you mean modes?"), std::string::npos) << wrong("mode");
  EXPECT_EQ(wrong("elephant").find("did you mean"), std::string::npos) << wrong("elephant");
  EXPECT_NE(wrong("elephant").find("choose from run, compare"), std::string::npos);
  EXPECT_EQ(wrong("a\033[31m\n").find('\033'), std::string::npos)
      << "nothing that a terminal obeys";
}

TEST(CommandLine, HelpIsAnOptionOfEveryCommand) {
  EXPECT_EQ(with_help({"help"}), Words{"--help"});
  EXPECT_EQ(with_help({"help", "run"}), (Words{"run", "--help"}));
  EXPECT_EQ(with_help({"run", "help"}), (Words{"run", "help"})) << "a scene may be called so";
}

}  // namespace
}  // namespace rotorub
