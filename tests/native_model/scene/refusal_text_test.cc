// The text of a refused scene: all errors at once, one line each, short and printable; also for
// files that are not scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"
#include "tests/native_model/scene/scene_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"

namespace rotorub::scene {
namespace {

TEST(Refusal, NamesTheLineOfASyntaxError) {
  expect_refused({
      {"unit without quotes", modal("\"0.5 mm\"", "0.5 mm"), 8, "contact.clearance", "\"0.5 mm\""},
      {"word without quotes", full("\"linear\"", "linear"), 22, "drive.kind",
       "put a word in quotes"},
      {"decimal comma", modal("0.15", "0,15"), 9, "contact.friction",
       "; write a decimal point: 0.15"},
      {"no value", modal("0.15", ""), 9, "contact.friction", "TOML"},
      {"key given twice", modal("friction = 0.15", "friction = 0.15\nfriction = 0.2"), 10,
       "contact.friction", "given twice"},
      {"table given twice", modal_and("[contact]\nradius = 1\n"), 11, "contact", "given twice"},
      {"table not closed", modal("[contact]", "[contact"), 6, "", "TOML"},
      {"in the second force", full("vector = [0.0, -20.0]", "vector = 1 N"), 48, "force[1].vector",
       "TOML"},
      {"three brackets", modal_and("[[[a]]]\n"), 11, "", "TOML"},
      {"not UTF-8", modal_and("# \xff\n"), 11, "", "TOML"},
  });
}

TEST(Refusal, TellsEverythingAtOnceInTheOrderOfTheFile) {
  const std::string text = R"([run]
end = -1
stepp = 1e-5
[rotor]
speed = "50 mm"
[rotor.modal]
mass = [2.0, 1.0]
stiffness = [2e5]
[contact]
radius = 0.05
clearance = 0.5 mm
friction = 0.15
friction = 0.2
restitution = 1.5
[initial]
stator = [1, 2]
[actuator]
)";
  const std::vector<std::pair<int, std::string>> expected = {{2, "run.end"},
                                                             {3, "run.stepp"},
                                                             {5, "rotor.speed"},
                                                             {8, "rotor.modal.stiffness"},
                                                             {11, "contact.clearance"},
                                                             {13, "contact.friction"},
                                                             {14, "contact.restitution"},
                                                             {16, "initial.stator"},
                                                             {17, "actuator"}};
  const std::vector<Diagnostic> found = refusal(text);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].line, expected[i].first);
    EXPECT_EQ(found[i].key, expected[i].second);
  }
}

TEST(Refusal, WritesOneLineAProblem) {
  EXPECT_EQ(test::message_of([] { parse_scene(modal("0.15", "-1") + "[zzz]\n", "dir/s.toml"); }),
            "dir/s.toml:9: contact.friction: out of range: expected a pure number, >= 0, got -1\n"
            "dir/s.toml:11: zzz: unknown table; choose from run, rotor, drive, force, base, "
            "magnetic_bearing, magnetic_control, contact, stator, actuator, controller, gravity, "
            "initial, mujoco, check");
}

// The user's words are quoted and cut, so that no escape code and no megabyte reaches the terminal.
TEST(Refusal, QuotesAreShortAndPrintable) {
  const std::string code = "\x1b[31m", written = "\\u001b[31m";  // as TOML can hold it
  const std::string much(200'000, 'x');
  struct Quoted {
    std::string text;
    std::vector<std::string> overrides;
  };
  const std::string sample(kModalSample);
  for (const Quoted& q : std::vector<Quoted>{{modal("\"50 Hz\"", "\"" + written + "\""), {}},
                                             {modal("\"50 Hz\"", "\"1 " + written + "\""), {}},
                                             {modal("\"50 Hz\"", "\"1 m " + written + "\""), {}},
                                             {modal("\"50 Hz\"", "\"" + much + "\""), {}},
                                             {modal("\"50 Hz\"", "\"1 " + much + "\""), {}},
                                             {modal("\"50 Hz\"", much), {}},
                                             {modal("\"50 Hz\"", code), {}},
                                             {sample + "\"" + written + "\" = 1\n", {}},
                                             {sample + "\"" + much + "\" = 1\n", {}},
                                             {sample + much + " = 1\n", {}},
                                             {sample + much + " = 1\n" + much + " = 2\n", {}},
                                             {sample + "[\"" + written + "\"]\n", {}},
                                             {sample + "[" + much + "]\n[" + much + "]\n", {}},
                                             {sample + code, {}},
                                             {sample + "\xff\xfe = 1\n", {}},
                                             {sample + "[drive]\nkind = \"" + written + "\"\n", {}},
                                             {sample + "[drive]\nkind = \"" + much + "\"\n", {}},
                                             {sample, {code}},
                                             {sample, {much}},
                                             {sample, {code + "=1"}},
                                             {sample, {much + "=1"}},
                                             {sample, {"contact." + code + "=1"}},
                                             {sample, {"contact.friction=" + code}},
                                             {sample, {"contact.friction=" + much}},
                                             {sample, {"contact.friction." + code + "=" + much}},
                                             {sample, {"rotor.speed=\"1 " + code + "\""}}}) {
    const std::string message =
        test::message_of<SceneError>([&] { parse_scene(q.text, "s.toml", q.overrides); });
    EXPECT_FALSE(message.empty()) << "accepted: " << q.text.substr(0, 200);
    EXPECT_LT(message.size(), 1500u) << message.substr(0, 300);
    for (const char c : message) {
      EXPECT_TRUE(c == '\n' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f)) << message;
    }
  }
}

TEST(Refusal, OfAHundredFaultsIsEnough) {
  std::string text(kModalSample);
  for (int i = 0; i < 2'000; ++i) text += "wrong" + std::to_string(i) + " = 1\n";
  try {
    parse_scene(text, "s.toml");
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.diagnostics().size(), 2'000u);
    const std::string message = error.what();
    EXPECT_LT(message.size(), 16u << 10u);
    const auto lines = static_cast<std::size_t>(std::count(message.begin(), message.end(), '\n'));
    EXPECT_GT(lines, 50u);
    EXPECT_TRUE(message.ends_with("and " + std::to_string(2'000 - lines) + " more"))
        << message.substr(message.size() - 200);
  }
}

TEST(Refusal, OfFilesThatCannotBeRead) {
  for (const std::string& path :
       {std::string("/no/such/scene.toml"), std::string("/"), std::string()}) {
    const auto all = test::refusals([&] { read_scene(path); });
    ASSERT_EQ(all.size(), 1u) << path;
    EXPECT_EQ(all[0].file, path);
    EXPECT_EQ(all[0].line, 0);
  }
  EXPECT_THROW(read_scene("/dev/zero"), SceneError);  // ends at the largest size
}

// A rotor that starts on the ring, to round-off, starts in contact and not outside.
TEST(Refusal, NotOfAStartOnTheRing) {
  EXPECT_NO_THROW(parse_scene(modal_and("[initial]\nx = [3e-4, 0]\ny = [4e-4, 0]\n"), "s.toml"));
}

// ---------------------------------------------------------------- printable
TEST(Printable, LeavesPlainTextAsItIs) {
  for (const std::string& text : std::vector<std::string>{
           "", "0.5 mm", "50 \xc2\xb5m", "\xe2\x82\xac, \xf0\x9f\x98\x80", "a\\b\"c"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, EscapesWhatATerminalObeys) {
  EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(printable("\x1b[31mred\x7f"), "\\x1b[31mred\\x7f");
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\u009b31m");  // CSI in one character
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "abc"),
            "\\u202eabc");                          // from right to left
  EXPECT_EQ(printable("\xe2\x80\xa8"), "\\u2028");  // line separator
}

TEST(Printable, EscapesBytesThatAreNoText) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3");                             // cut within a character
  EXPECT_EQ(printable("\xc0\x80"), "\\xc0\\x80");                    // overlong
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half of a pair
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond Unicode
}

TEST(Printable, CutsBetweenCharacters) {
  EXPECT_EQ(printable("abcdef", 6), "abcdef");
  EXPECT_EQ(printable("abcdefg", 6), "abcdef...");
  EXPECT_EQ(printable("abcde\xc2\xb5", 6), "abcde...");
  EXPECT_EQ(printable("abcd\x1b", 6), "abcd...");
  EXPECT_EQ(printable(std::string(1'000'000, 'x')).size(), kQuotedLength + 3);
}

// Printable text is not changed again.
TEST(Printable, Twice) {
  const std::string once = printable("\x1b[31m\n\xff\xc2\x9b");
  EXPECT_EQ(printable(once), once);
}

}  // namespace
}  // namespace rotorub::scene
