// What the limit protects is the stack: it counts the dots of keys, whatever the values hold.
#include <gtest/gtest.h>

#include <string>

#include "native_model/scene/reader.h"
#include "native_model/scene/toml_source.h"
#include "tests/support/said.h"

namespace rotorub::scene {
namespace {

std::string times_over(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// A key of `dots` dots.
std::string deep_key(int dots) { return times_over("a.", dots) + "b"; }

bool toml_is_read(const std::string& text) {
  std::vector<Diagnostic> wrong;
  return parse_toml(text, "scene.toml", wrong).has_value();
}

TEST(KeyDepth, DotsOfValuesStringsAndCommentsDoNotCount) {
  const std::string times = "output_times = [" + times_over("0.0001, ", 1000) + "0.2]";
  const std::string table =
      "f = [" + times_over("[" + times_over("1.5, ", 40) + "1.5], ", 40) + "[0.5]]";
  const std::string text = times_over(".", 5000);
  for (const std::string& read :
       {times, table, "a = \"" + text + "\"", "a = '" + text + "'",
        "a = \"\"\"" + text + "\n" + text + "\"\"\"", "a = '''" + text + "\n" + text + "'''",
        "# " + text, "a.b = 1 # " + text, "a = [" + times_over("{b.c = 1.5}, ", 1500) + "]",
        "[x]\n" + times, deep_key(kDeepestKey) + " = 1", "[" + deep_key(kDeepestKey) + "]",
        "a.b.c = 1\n" + times_over("[[d.e.f]]\n", 1001)}) {
    EXPECT_EQ(line_of_too_deep_key(read), 0) << read.substr(0, 40);
    EXPECT_TRUE(toml_is_read(read)) << read.substr(0, 40);
  }
}

TEST(KeyDepth, DeepKeysAreRefusedWhereverTheyHide) {
  const std::string deep = deep_key(kDeepestKey + 1);
  const std::string half = deep_key(kDeepestKey / 2 + 1);
  for (const std::string& refused :
       {deep + " = 1", "[" + deep + "]", "[[" + deep + "]]", times_over("a . ", 1001) + "b = 1",
        "x = {" + deep + " = 1}", "x = [1.5, {" + deep + " = 1}]", half + " = {" + half + " = 1}",
        half + " = [0.5, {c = 1, " + half + " = 1}]", times_over("\"=\".", 1001) + "b = 1",
        times_over("'#'.", 1001) + "b = 1", "x = [\"\"\"\"\"\", {" + deep + " = 1}]",
        "x = [\"\"\"\n\"\"\", {" + deep + " = 1}]", "x = ['''a''''', {" + deep + " = 1}]",
        "x = [\"\\\"\", {" + deep + " = 1}]", "x = [\"\"\"\\\"\"\"\", {" + deep + " = 1}]",
        "x = [\n{" + half + " = [\n{" + half + " = 1}]}]"}) {
    EXPECT_EQ(line_of_too_deep_key("# first\n" + refused) > 1, true) << refused.substr(0, 40);
    EXPECT_FALSE(toml_is_read(refused)) << refused.substr(0, 40);
  }
}

TEST(KeyDepth, TheRefusalNamesTheLineAndWhatIsAccepted) {
  EXPECT_EQ(test::message_of([] {
              parse_scene("[run]\nend = 0.5\n" + deep_key(1001) + " = 1\n", "scene.toml");
            }),
            "scene.toml:3: a key of more than 1000 dots; accepted: up to 1000");
}

}  // namespace
}  // namespace rotorub::scene
