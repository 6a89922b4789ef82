#include "compare/report/page_frame.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace rotorub {
namespace {

TEST(PageFrame, ReplacesEachNameOnce) {
  EXPECT_EQ(filled("<p>{{a}} and {{b}}, {{a}}</p>", {{"a", "{{b}}"}, {"b", "$1 \\"}}),
            "<p>{{b}} and $1 \\, {{b}}</p>");
  EXPECT_EQ(filled("no names { } at all", {}), "no names { } at all");
  EXPECT_THROW(filled("{{missing}}", {}), std::out_of_range);
}

TEST(PageFrame, EscapesWordsAndData) {
  const result::Section found{.parts = {result::line("a < b & c")}};
  const std::string page = laid_out_page({"<b>ring", "one \"run\"", "why?"}, found, "sweep",
                                         {{"text", "</script><script>"}}, "1 < 2");
  EXPECT_NE(page.find("<title>&lt;b&gt;ring: one &quot;run&quot; · rotorub</title>"),
            std::string::npos);
  EXPECT_NE(page.find("<noscript><pre>a &lt; b &amp; c\n</pre></noscript>"), std::string::npos);
  EXPECT_NE(page.find(R"({"page":{"kind":"sweep","parts":[{"text":"a \u003c b & c"}]},)"
                      R"("text":"\u003c/script>\u003cscript>"})"),
            std::string::npos);
  EXPECT_EQ(page.find("native-module"), std::string::npos) << "only with sliders";
}

}  // namespace
}  // namespace rotorub
