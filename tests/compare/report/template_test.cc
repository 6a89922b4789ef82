#include "compare/report/page_frame.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace rotorub {
namespace {

using nlohmann::json;

TEST(Template, EscapesTextAndLeavesTheRestAlone) {
  EXPECT_EQ(fill_template("a {{x}} b", {{"x", "<b> & \"c\" 'd'"}}),
            "a &lt;b&gt; &amp; &quot;c&quot; &#39;d&#39; b");
  EXPECT_EQ(fill_template("{{{x}}}", {{"x", "<b>"}}), "<b>");
  EXPECT_EQ(fill_template("{{ n }}", {{"n", 3}}), "3");
  EXPECT_EQ(fill_template("no tags { } at all", json::object()), "no tags { } at all");
}

TEST(Template, RepeatsSections) {
  const json values = {{"rows", {{{"a", 1}}, {{"a", 2}}}}, {"b", "x"}};
  EXPECT_EQ(fill_template("{{#rows}}[{{a}}{{b}}]{{/rows}}", values), "[1x][2x]");
  EXPECT_EQ(fill_template("{{#list}}{{.}},{{/list}}", {{"list", {"p", "q"}}}), "p,q,");
}

TEST(Template, NestsSectionsOfTheSameName) {
  const json values = {{"s", {{{"s", {{{"v", 1}}, {{"v", 2}}}}}, {{"s", json::array()}}}}};
  EXPECT_EQ(fill_template("{{#s}}<{{#s}}{{v}}{{/s}}>{{/s}}", values), "<12><>");
}

TEST(Template, ShowsAndHides) {
  const json values = {{"yes", true}, {"no", false}, {"none", nullptr}, {"empty", json::array()}};
  EXPECT_EQ(fill_template("{{#yes}}a{{/yes}}{{#no}}b{{/no}}{{#none}}c{{/none}}"
                          "{{^no}}d{{/no}}{{^empty}}e{{/empty}}{{^yes}}f{{/yes}}",
                          values),
            "ade");
}

TEST(Template, ReadsMembers) { EXPECT_EQ(fill_template("{{a.b}}", {{"a", {{"b", "c"}}}}), "c"); }

TEST(Template, FillsPartialsWhereTheyStand) {
  const Partials partials = {{"row", "[{{a}}{{>end}}]"}, {"end", "!"}};
  EXPECT_EQ(
      fill_template("{{#rows}}{{>row}}{{/rows}}", {{"rows", {{{"a", 1}}, {{"a", 2}}}}}, partials),
      "[1!][2!]");
  EXPECT_THROW(fill_template("{{>row}}", json::object()), std::logic_error);
}

TEST(Template, RefusesItsOwnMistakes) {
  EXPECT_THROW(fill_template("{{missing}}", json::object()), std::logic_error);
  EXPECT_THROW(fill_template("{{#open}}", {{"open", true}}), std::logic_error);
  EXPECT_THROW(fill_template("{{/closed}}", {{"closed", true}}), std::logic_error);
  EXPECT_THROW(fill_template("{{half", {{"half", 1}}), std::logic_error);
  EXPECT_THROW(fill_template("{{list}}", {{"list", {1, 2}}}), std::logic_error);
}

}  // namespace
}  // namespace rotorub
