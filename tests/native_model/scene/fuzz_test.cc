// Nasty input: any text gives a scene or a SceneError, never another exception or the end of the
// program.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "native_model/scene/schema.h"
#include "tests/native_model/scene/scene_samples.h"

namespace rotorub::scene {
namespace {

enum class Outcome { kScene, kRefused };

Outcome outcome(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    const Scene scene = parse_scene(text, "s.toml", overrides);
    // A scene that is read is usable.
    EXPECT_TRUE(scene.rotor.geometry.has_value() != scene.rotor.modal.has_value());
    EXPECT_TRUE(std::isfinite(scene.run.end) && scene.run.end > 0.0);
    EXPECT_TRUE(std::isfinite(scene.rotor.speed));
    EXPECT_TRUE(!scene.first().contact || scene.first().contact->clearance > 0.0);
    return Outcome::kScene;
  } catch (const SceneError& error) {
    EXPECT_FALSE(error.diagnostics().empty());
    for (const Diagnostic& diagnostic : error.diagnostics()) EXPECT_NE(diagnostic.reason, "");
    return Outcome::kRefused;
  }
}

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

TEST(Fuzz, NastyTextIsRefused) {
  const std::vector<std::string> cases = {
      "",
      " ",
      "\n\n",
      std::string(1, '\0'),
      "[",
      "]",
      "[[",
      "[[a",
      "[a]]",
      "[[a]",
      "[[[a]]]",
      "[[[[[[",
      "=",
      "a",
      "a=",
      "a=[",
      "a={",
      "a={b=",
      "a=\"",
      "a='''",
      "a=\"\"\"",
      "a.b=1\na=2",
      "a=1\n[a]",
      "[a]\n[a]\n[a]",
      "[[a]]\n[a]",
      "a=1e999999999",
      "a=99999999999999999999999",
      "a=0x",
      "a=1__0",
      "a=\"\\uD800\"",
      "a=\"\\UFFFFFFFF\"",
      "a=\"\\q\"",
      "\xff\xfe",
      "\xef\xbb\xbf",
      "\xc3",
      "a = 1\xc7\xbd"
      "2",  // letters of Latin scripts where none may stand
      "\xc3\xa9 = 1",
      "a = \xc3\xa9",
      "a=1 b=2",
      "a=1979-13-45",
      "rotor = []",
      "[[rotor]]",
      "[[rotor]]\nmodal = 1",
      "[rotor]\nmodal = []",
      "[rotor]\nmodal = [{}]",
      "[rotor]\nsection = 3",
      "[rotor]\nsection = []\nlength = 1\nE = 1\nrho = 1\nmodes = 1",
      "rotor.modal.mass = \"\\u0001 faulty\"",
      "force = [[[[]]]]\n" + std::string(kModalSample),
      "a = " + repeated("[", 100000),
      "a = " + repeated("{b=", 100000),
      repeated("a.", 100000) + "a = 1",
      "[" + repeated("a.", 100000) + "a]",
      repeated("[a]\n", 2000),
      repeated("a = x\n", 2000),
      std::string(kModalSample) + repeated("k", 1000000) + " = 1",
      std::string(kModalSample) + "friction = " + repeated("9", 100000),
  };
  for (const std::string& text : cases) {
    EXPECT_EQ(outcome(text), Outcome::kRefused) << text.substr(0, 60);
  }
}

// One byte changed, cut or doubled at random in a good scene.
TEST(Fuzz, DamagedScenesAreReadOrRefused) {
  std::mt19937 random(20240607);
  const std::string bytes = "[]{}=\"'.,#\n\r\t -+_eE0159ainfx\\\x01\x7f\xc3\xff";
  int refused = 0;
  constexpr int kRounds = 4000;
  for (int round = 0; round < kRounds; ++round) {
    std::string text(round % 2 == 0 ? kFullModalScene : kGeometrySample);
    const int damages = 1 + static_cast<int>(random() % 3);
    for (int i = 0; i < damages; ++i) {
      const std::size_t at = random() % text.size();
      const std::size_t span = 1 + random() % std::min<std::size_t>(12, text.size() - at);
      switch (random() % 4) {
        case 0:
          text[at] = bytes[random() % bytes.size()];
          break;
        case 1:
          text.insert(at, 1, bytes[random() % bytes.size()]);
          break;
        case 2:
          text.erase(at, span);
          break;
        default:
          text.insert(at, text.substr(at, span));
          break;
      }
      if (text.empty()) text = "x";
    }
    if (outcome(text) == Outcome::kRefused) ++refused;
  }
  // Both outcomes occur: the damage is neither always harmless nor always fatal.
  EXPECT_GT(refused, kRounds / 4);
  EXPECT_LT(refused, kRounds);
}

TEST(Fuzz, NastyOverridesAreReadOrRefused) {
  std::mt19937 random(7);
  const std::vector<std::string> pieces = {
      "force", "[0]",   "[1]",  ".",   "=",   "none", "contact", "kind", "free", "x",
      "rotor", "modal", "mass", "[",   "]",   "{",    "}",       "\n",   "\"",   "1",
      " mm",   "'",     ",",    "run", "end", "[9]",  "\xff",    "drive"};
  for (int round = 0; round < 4000; ++round) {
    std::string text;
    const int length = 1 + static_cast<int>(random() % 9);
    for (int i = 0; i < length; ++i) text += pieces[random() % pieces.size()];
    outcome(std::string(kFullModalScene), {text});
  }
}

// Every part of a scene is replaced by a value that is not a table.
TEST(Fuzz, PartsThatAreNoTablesAreReadOrRefused) {
  for (const std::string_view sample : {kModalSample, kGeometrySample, kFullModalScene}) {
    for (const Table& table : tables()) {
      const std::string part(table.path);
      for (const char* value : {"=3", "=\"x\"", "=true", "=[1, 2]", "=[]"}) {
        outcome(std::string(sample), {part + value});
        outcome(std::string(sample), {part + "=none", part + value});
      }
    }
  }
}

// The text after any overrides can be read again; otherwise the scene would not survive its MJCF.
TEST(Fuzz, OddTextSurvivesRewriting) {
  const std::string text = "# \u00e4 comment\n" + std::string(kFullModalScene);
  const std::vector<std::string> overrides = {"contact.friction=1e-320", "run.end=0x10"};
  const Scene first = parse_scene(text, "s.toml", overrides);
  const Scene again = parse_scene(first.text, "s.toml");
  EXPECT_EQ(again.first().contact->friction.coefficient, 1e-320);
  EXPECT_EQ(again.run.end, 16.0);
}

}  // namespace
}  // namespace rotorub::scene
