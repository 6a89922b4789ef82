#include "compare/report/page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "compare/base/plot_points.h"
#include "compare/report/assets.h"

namespace rotorub {
namespace {

TEST(Page, ReplacesEachNameOnce) {
  EXPECT_EQ(filled("<p>{{a}} and {{b}}, {{a}}</p>", {{"a", "{{b}}"}, {"b", "$1 \\"}}),
            "<p>{{b}} and $1 \\, {{b}}</p>");
  EXPECT_EQ(filled("no names { } at all", {}), "no names { } at all");
  EXPECT_THROW(filled("{{missing}}", {}), std::out_of_range);
}

TEST(Page, EscapesWordsAndData) {
  const result::Section found{.parts = {result::line("a < b & c"), result::Data{"k", 1}}};
  const std::string page = page_of("sweep", "<b>\"ring\"", found, {{"text", "</script><script>"}});
  EXPECT_NE(page.find("<title>&lt;b&gt;&quot;ring&quot; · rotorub</title>"), std::string::npos);
  EXPECT_NE(page.find("<noscript><pre>a &lt; b &amp; c\n</pre></noscript>"), std::string::npos);
  EXPECT_NE(
      page.find(R"({"page":{"found":{"k":1},"kind":"sweep","names":"\u003cb>\"ring\"","parts":)"
                R"([{"text":"a \u003c b & c"}]},"text":"\u003c/script>\u003cscript>"})"),
      std::string::npos);
  EXPECT_EQ(page.find("native-module"), std::string::npos) << "only with sliders";
}

TEST(Page, NeedsNoNetworkAndNoOtherFile) {
  std::string page = page_of("sweep", "ring", {}, nlohmann::json::object());
  const std::string plotly = base64(packed_plotly_js());
  page.erase(page.find(plotly), plotly.size());
  for (const char* outside : {"http:", "https:", "@import", "src=", "<link", "{{"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

}  // namespace
}  // namespace rotorub
