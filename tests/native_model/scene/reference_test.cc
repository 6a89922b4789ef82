#include "native_model/scene/reference.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

TEST(Reference, StandsInTheReadmeAsTheSchemaHasIt) {
  std::ifstream file(std::string(ROTORUB_MJCF_DIR) + "/README.md");
  std::stringstream readme;
  readme << file.rdbuf();
  const std::string expected = kReferenceBegin + ("\n" + reference_markdown()) + kReferenceEnd;
  EXPECT_NE(readme.str().find(expected), std::string::npos)
      << "mjcf/README.md is behind the schema; between its marks it should hold\n"
      << expected;
}

TEST(Schema, NamesEveryKeyOnceAndKeepsKindsAndWordsInStep) {
  std::set<std::string> names;
  for (const Table& table : tables()) {
    EXPECT_FALSE(table.meaning.empty() || table.when_absent.empty()) << table.path;
    const Key* kind = table.find("kind");
    for (const Key& key : table.keys) {
      const std::string path = std::string(table.path) + "." + std::string(key.name);
      EXPECT_TRUE(names.insert(path).second) << path << " stands twice";
      EXPECT_EQ(key.type == ValueType::kWord, !key.words.empty()) << path;
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
