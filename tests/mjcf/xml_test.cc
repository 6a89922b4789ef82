#include "mjcf/xml.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

TEST(XmlEscape, ReplacesWhatXmlWouldRead) {
  EXPECT_EQ(xml_escape("a<b>&\"c\"\n\t\r"), "a&lt;b&gt;&amp;&quot;c&quot;&#10;&#9;&#13;");
  EXPECT_EQ(xml_escape("plain text, 'quotes' = 1.5e-3"), "plain text, 'quotes' = 1.5e-3");
}

TEST(XmlEscape, RefusesControlCharacters) {
  EXPECT_THROW(xml_escape(std::string("a\0b", 3)), std::invalid_argument);
  EXPECT_THROW(xml_escape("bell \a"), std::invalid_argument);
}

class XmlInMujoco : public MujocoTest {};

TEST_F(XmlInMujoco, TextComesBackToTheByte) {
  const std::string text =
      "# comment with <tags> & \"quotes\" 'single'\n\n[run]\tend = 1 # \xC2\xB5m, &#10; &amp;\n"
      "  s = \"\"\"two\r\nlines\"\"\"\n\n";
  const ModelPointer m = load("<mujoco><custom><text name=\"t\" data=\"" + xml_escape(text) +
                              "\"/></custom><worldbody/></mujoco>");
  ASSERT_EQ(m->ntext, 1);
  EXPECT_EQ(std::string(m->text_data + m->text_adr[0]), text);
}

TEST(XmlWriter, IndentsWhatIsOpen) {
  XmlWriter xml;
  xml.open("<a>");
  xml.line("<b/>");
  xml.close("a");
  EXPECT_EQ(xml.take(), "<a>\n  <b/>\n</a>\n");
}

TEST(XmlWriter, RefusesNumbersThatAreNone) {
  for (const char* element : {R"(<geom size="inf 1"/>)", R"(<geom size="1 -inf"/>)",
                              R"(<key name="a" qpos="0 nan 1"/>)", R"(<joint damping="-nan"/>)"}) {
    EXPECT_THROW(XmlWriter().line(element), NotFinite) << element;
    EXPECT_THROW(XmlWriter().open(element), NotFinite) << element;
  }
  for (const char* element : {R"(<geom name="inf" size="1 2"/>)", R"(<text data="off = inf"/>)",
                              R"(<geom rgba="info nano"/>)", R"(<mujoco model="nan">)",
                              "<!-- inf -->", R"(<geom size=""/>)"}) {
    EXPECT_NO_THROW(XmlWriter().line(element)) << element;
  }
}

}  // namespace
}  // namespace rotorub::test
