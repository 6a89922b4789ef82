// A page that needs no network and no further file.
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace rotorub::test {

// The page without the scripts of others, whose texts cite addresses.
inline std::string expect_self_contained(std::string page) {
  for (const char* script : {"<script id=\"plotly\"", "<script id=\"scripts\""}) {
    const std::size_t begin = page.find(script);
    if (begin != std::string::npos) page.erase(begin, page.find("</script>", begin) - begin);
  }
  for (const char* part : {"http:", "https:", "//cdn", "src=", "<link", "@import", "{{"})
    EXPECT_EQ(page.find(part), std::string::npos) << part;
  return page;
}

}  // namespace rotorub::test
