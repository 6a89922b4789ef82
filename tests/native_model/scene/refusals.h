// Bad scenes as samples with a part replaced or added, and what is said of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/native_model/scene/scene_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"

namespace rotorub::scene {

inline std::vector<Diagnostic> refusal(const std::string& text) {
  return test::refusals([&] { parse_scene(text, "s.toml"); });
}

inline std::string replaced(std::string_view sample, const std::string& from,
                            const std::string& to) {
  std::string text(sample);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

struct Wrong {
  const char* why;
  std::string text;
  int line;
  const char* key;
  const char* reason;  // must stand in the message
};

inline void expect_refused(const std::vector<Wrong>& cases) {
  for (const Wrong& wrong : cases) {
    const std::vector<Diagnostic> found = refusal(wrong.text);
    ASSERT_EQ(found.size(), 1u) << wrong.why << (found.empty() ? "" : ": " + to_string(found[0]));
    EXPECT_EQ(found[0].file, "s.toml") << wrong.why;
    EXPECT_EQ(found[0].line, wrong.line) << wrong.why;
    EXPECT_EQ(found[0].key, wrong.key) << wrong.why;
    EXPECT_TRUE(test::contains(found[0].reason, wrong.reason)) << wrong.why;
  }
}

inline std::string modal(const std::string& from, const std::string& to) {
  return replaced(kModalSample, from, to);
}
inline std::string geometry(const std::string& from, const std::string& to) {
  return replaced(kGeometrySample, from, to);
}
inline std::string full(const std::string& from, const std::string& to) {
  return replaced(kFullModalScene, from, to);
}
inline std::string modal_and(const std::string& more) { return std::string(kModalSample) + more; }
inline std::string geometry_and(const std::string& more) {
  return std::string(kGeometrySample) + more;
}

}  // namespace rotorub::scene
