#include "tests/native_model/scene/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

// ROTORUB_UPDATE_REFERENCE=1 in the environment writes it instead.
TEST(Reference, StandsInTheReadmeAsTheSchemaHasIt) {
  const std::string path = std::string(ROTORUB_MJCF_DIR) + "/README.md";
  std::ifstream file(path);
  std::stringstream content;
  content << file.rdbuf();
  std::string readme = content.str();
  const std::size_t begin = readme.find(kReferenceBegin), end = readme.find(kReferenceEnd);
  ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << "no marks in " << path;

  const std::size_t first = begin + std::string(kReferenceBegin).size();
  const std::string expected = "\n" + reference_markdown();
  if (std::getenv("ROTORUB_UPDATE_REFERENCE") != nullptr) {
    std::ofstream(path) << readme.replace(first, end - first, expected);
    return;
  }
  EXPECT_EQ(readme.substr(first, end - first), expected)
      << path << " is behind the schema; run this test with ROTORUB_UPDATE_REFERENCE=1";
}

TEST(Schema, NamesEveryKeyOnceAndKeepsKindsAndWordsInStep) {
  std::set<std::string> names;
  for (const Table& table : tables()) {
    EXPECT_FALSE(table.meaning.empty() || table.when_absent.empty()) << table.path;
    const Key* kind = table.find("kind");
    for (const Key& key : table.keys) {
      const std::string path = std::string(table.path) + "." + std::string(key.name);
      EXPECT_TRUE(names.insert(path).second) << path << " stands twice";
      if (key.type != ValueType::kWhole) {  // which may have words beside its numbers
        EXPECT_EQ(key.type == ValueType::kWord, !key.words.empty()) << path;
      }
      EXPECT_NE(key.store, nullptr) << path;
      for (std::string_view word : key.kinds) {
        ASSERT_NE(kind, nullptr) << path;
        EXPECT_NE(std::find(kind->words.begin(), kind->words.end(), word), kind->words.end())
            << path << " is for a kind that is none: " << word;
      }
    }
  }
}

}  // namespace
}  // namespace rotorub::scene
