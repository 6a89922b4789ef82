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

}  // namespace
}  // namespace rotorub::test
