// Contacts by instances of the plugin "rotorub.contact" in <extension>: each document has an
// equivalent with <custom>.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>

#include "mjcf/writer.h"
#include "native_model/scene/reader.h"
#include "plugin/hooks.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/today/testspeed.h"

namespace rotorub::test {
namespace {

std::string extension(const std::string& instances) {
  return "<extension><plugin plugin=\"rotorub.contact\">" + instances + "</plugin></extension>";
}
std::string instance(const std::string& name, const std::map<std::string, std::string>& configs) {
  std::string text = "<instance name=\"" + name + "\">";
  for (const auto& [key, value] : configs) {
    text += "<config key=\"" + key + "\" value=\"" + value + "\"/>";
  }
  return text + "</instance>";
}

// Replaces <custom> by instances.
std::string by_instances(std::string document) {
  const std::regex name(
      R"re(<(?:text|numeric) name="(\w*?)rotorub_(rotor_geom|ring_geom|contact|clearance|radius|)re"
      R"re(friction_reference|friction|restitution|tangential_restitution|width|userdata|)re"
      R"re(cone_coulomb_pair)(\w*)" data="([^"]*)"/>)re");
  std::map<std::string, std::map<std::string, std::string>> contacts;
  std::smatch found;
  while (std::regex_search(document, found, name)) {
    contacts[found.str(1) + "contact" + found.str(3)][found.str(2)] = found.str(4);
    document = found.prefix().str() + found.suffix().str();
  }
  std::string instances;
  std::size_t body = 0;
  for (const auto& [of, configs] : contacts) {
    instances += instance(of, configs);
    body = document.find(">", document.find("<body", body)) + 1;
    document.insert(body, "<plugin instance=\"" + of + "\"/>");
  }
  EXPECT_EQ(document.find("rotorub_clearance"), document.npos);
  return replaced(document, "<worldbody>", extension(instances) + "<worldbody>");
}

class Instances : public MujocoTest {
 protected:
  // All sensors after each of `steps` steps, of a rotor that is thrown at its ring.
  static std::vector<double> run(const mjModel* m, int steps) {
    const DataPointer d = start(m);
    d->qvel[0] = 0.4;
    d->qvel[1] = 0.1;
    const int spin = mj_name2id(m, mjOBJ_JOINT, "spin");
    if (spin >= 0) d->qvel[m->jnt_dofadr[spin]] = 100.0;
    std::vector<double> all;
    for (int k = 0; k < steps; ++k) {
      mj_step(m, d.get());
      all.insert(all.end(), d->sensordata, d->sensordata + m->nsensordata);
    }
    const std::vector<double> end = state_of(m, d.get());
    all.insert(all.end(), end.begin(), end.end());
    return all;
  }
  static void expect_twins(const std::string& document) {
    const ModelPointer custom = load(document), instances = load(by_instances(document));
    ASSERT_GT(instances->nplugin, 0);
    const std::vector<double> wanted = run(custom.get(), 3000);
    EXPECT_EQ(run(instances.get(), 3000), wanted);
    EXPECT_GT(*std::max_element(wanted.begin(), wanted.end()), 10.0) << "no contact";
  }
  plugin::Hooks hooks_;
};

TEST_F(Instances, HaveTheBitsOfTheNamesInCustom) {
  expect_twins(own_model_example());
  for (const char* contact : {"rigid", "coulomb"}) {
    Machine x;
    x.contact = contact;
    x.friction = 0.2;
    expect_twins(document(x));
  }
  TwoRings two;
  two.friction = 0.15;
  expect_twins(document(two));
  two.custom = "<numeric name=\"rotorub_userdata\" data=\"20\"/>";
  expect_twins(document(two));
}

TEST_F(Instances, FrictionMayFallWithTheSlip) {
  const std::string falling =
      replaced(document(Machine{}), "data=\"0.000000\"", "data=\"0.3 0.1 0.05 0.001\"");
  const ModelPointer custom = load(falling), instances = load(by_instances(falling));
  EXPECT_EQ(run(instances.get(), 3000), run(custom.get(), 3000));
  EXPECT_NE(run(instances.get(), 3000), run(load(document(Machine{})).get(), 3000));
}

// MuJoCo's cone between any two geoms, corrected for sliding (plugin/contact/cone.h).
TEST_F(Instances, NameAPairToBeCorrected) {
  const auto sliding = [](const std::string& head, const std::string& box,
                          const std::string& custom) {
    return "<mujoco><option timestep=\"1e-4\"/><size nuserdata=\"32\"/>" + head + R"(<worldbody>
      <geom name="floor" type="plane" size="5 5 0.1"/>
      <body name="box" pos="0 0 0.05">)" +
           box + R"(<freejoint/><geom name="box" type="box" size="0.1 0.1 0.05"/></body>
    </worldbody>
    <contact><pair name="sliding" geom1="box" geom2="floor" friction="0.3 0.3 0 0 0"/></contact>)" +
           custom + "</mujoco>";
  };
  const ModelPointer plain = load(sliding("", "", ""));
  const ModelPointer custom = load(sliding(
      "", "", "<custom><text name=\"rotorub_cone_coulomb_pair\" data=\"sliding\"/></custom>"));
  const ModelPointer instances =
      load(sliding(extension(instance("contact", {{"cone_coulomb_pair", "sliding"}})),
                   "<plugin instance=\"contact\"/>", ""));
  const auto end = [](const mjModel* m) {
    const DataPointer d = start(m);
    d->qvel[0] = 20.0;
    for (int k = 0; k < 500; ++k) mj_step(m, d.get());
    return state_of(m, d.get());
  };
  EXPECT_EQ(end(instances.get()), end(custom.get()));
  EXPECT_NE(end(instances.get()), end(plain.get()));
}

#if mjVERSION_HEADER >= 3005000
// A machine that is attached twice by MuJoCo keeps its contacts.
TEST_F(Instances, KeepTheirContactsWhenAttached) {
  std::string machine =
      replaced(by_instances(document(Machine{})), "nuserdata=\"32\"", "nuserdata=\"34\"");
  machine = replaced(machine, "collision=\"predefined\"", "");
  for (const char* geom : {"name=\"disc\"", "name=\"bore\""}) {
    machine = replaced(machine, geom, std::string(geom) + " contype=\"0\" conaffinity=\"0\"");
  }
  const std::string both =
      R"(<mujoco><option timestep="1e-5" gravity="0 0 0"/><size nuserdata="34"/>
    <asset><model name="machine" file="machine.xml"/></asset>
    <worldbody><attach model="machine" prefix="left_"/><attach model="machine" prefix="right_"/>
    </worldbody></mujoco>)";
  mjVFS files;
  mj_defaultVFS(&files);
  mj_addBufferVFS(&files, "machine.xml", machine.data(), static_cast<int>(machine.size()));
  mj_addBufferVFS(&files, "both.xml", both.data(), static_cast<int>(both.size()));
  char error[500] = "";
  const ModelPointer m(mj_loadXML("both.xml", &files, error, sizeof error));
  mj_deleteVFS(&files);
  ASSERT_NE(m, nullptr) << error;
  const DataPointer d = start(m.get());
  d->qvel[0] = 0.4;
  d->qvel[5] = 0.2;
  double pressed[2] = {0.0, 0.0};
  for (int k = 0; k < 3000; ++k) {
    mj_step(m.get(), d.get());
    pressed[0] = std::max(pressed[0], sensor(m.get(), d.get(), "left_normal_force"));
    pressed[1] = std::max(pressed[1], sensor(m.get(), d.get(), "right_normal_force"));
  }
  EXPECT_GT(pressed[0], 1.2 * pressed[1]);
  EXPECT_GT(pressed[1], 10.0);
}
#endif

// In its body an instance has no name: it is the first contact.
TEST_F(Instances, MayStandInABody) {
  const std::string plain = document(Machine{});
  std::string inline_ = replaced(by_instances(plain), "<instance name=\"contact\">", "<!--");
  inline_ = replaced(inline_, "</instance>", "-->");
  inline_ = replaced(inline_, "<plugin instance=\"contact\"/>", "");
  inline_ = replaced(inline_, "<body name=\"ring\">", R"(<body name="ring">
    <plugin plugin="rotorub.contact"><config key="rotor_geom" value="disc"/>
      <config key="ring_geom" value="bore"/><config key="clearance" value="5e-4"/>
      <config key="restitution" value="0.5"/></plugin>)");
  EXPECT_EQ(run(load(inline_).get(), 3000), run(load(plain).get(), 3000));
}

TEST_F(Instances, AreCheckedWhenTheModelIsLoaded) {
  const std::string good = by_instances(document(TwoRings{}));
  load(good);
  const auto changed = [&](const std::string& from, const std::string& to) {
    return replaced(good, from, to);
  };
  const std::string clearance = "<config key=\"clearance\" value=\"0.00050000000000000001\"/>";
  expect_refused(changed("key=\"clearance\"", "key=\"clearence\""), "clearence");  // MuJoCo's words
  const std::string named = "rotorub: <instance name=\"contact\"><config key=\"clearance\">: ";
  for (const char* value : {"0.5 mm", "5e-4 5e-4", "wide", "nan", "1e999"}) {
    const std::string said = std::string("<config key=\"clearance\" value=\"") + value + "\"/>";
    expect_refused(changed(clearance, said),
                   named + "\"" + value + "\" must be a number without a unit");
  }
  expect_refused(changed(clearance, "<config key=\"clearance\" value=\"-1\"/>"),
                 named + "-1 must be > 0");
  expect_refused(changed(clearance, ""), named + "missing");
  expect_refused(changed("value=\"disc\"", "value=\"disk\""), "did you mean \"disc\"?");
  expect_refused(replaced(changed("name=\"contact_2\"", "name=\"far\""), "instance=\"contact_2\"",
                          "instance=\"far\""),
                 "<instance name=\"far\">: its name determines the contact");
  expect_refused(changed("<plugin instance=\"contact\"/>", ""),
                 "<instance name=\"contact\">: no body refers to it; put <plugin instance=");
  expect_refused(changed("value=\"rigid\"", "value=\"stiff\""),
                 "<config key=\"contact\">: \"stiff\" is not a contact model; choose from ");
  expect_refused(changed("<config key=\"ring_geom\" value=\"ring\"/>", ""),
                 "<config key=\"ring_geom\">: missing");
}

TEST_F(Instances, StandAlone) {
  const auto with_instance = [](const std::string& plain, const std::string& body) {
    return replaced(replaced(plain, "<worldbody>",
                             extension(instance("contact", {{"friction", "0.1"}})) + "<worldbody>"),
                    body, body + "<plugin instance=\"contact\"/>");
  };
  expect_refused(with_instance(document(Machine{}), "<body name=\"shaft\">"),
                 "rotorub_friction is in <custom> too; remove one of them");
  expect_refused(with_instance(mjcf(shipped("bench_ring"), built_for()), "<body name=\"rotor\">"),
                 "<extension>: has a contact beside the contact of the scene's text");
}

// Linked, the plugin works while its Hooks exist, and is never silent afterwards.
TEST(InstancesWithoutHooks, AreRefused) {
  class Quiet : public MujocoTest {
    void TestBody() override {}
  } quiet;
  ModelPointer m;
  {
    const plugin::Hooks hooks;
    m = load(by_instances(document(Machine{})));
  }
  EXPECT_THROW(mj_makeData(m.get()), std::runtime_error);
}

class InstancesInTestspeed : public TestspeedTest {};

TEST_F(InstancesInTestspeed, NeedThePlugin) {
  const std::string machine = replaced(own_model_example(), "qvel=\"0 0 300", "qvel=\"1 0 300");
  EXPECT_EQ(last(by_instances(machine), 5000), last(machine, 5000));
  EXPECT_TRUE(run(by_instances(machine), 10, {.plugin = false}).empty());
  EXPECT_NE(said_.find("rotorub.contact"), std::string::npos) << said_;
}

// The example of plugin/README.md.
TEST_F(Instances, OfTheReadme) {
  const std::string readme = scene::file_text(ROTORUB_SOURCE_DIR "/plugin/README.md");
  const auto between = [&](const std::string& from, const std::string& to) {
    const std::size_t at = readme.find(from), end = readme.find(to, at);
    EXPECT_NE(end, readme.npos) << from;
    return readme.substr(at, end - at);
  };
  const std::string shown = between("<extension>", "```");
  const std::string body = between("<body name=\"disc\">", "```");
  const std::string example = own_model_example();
  const std::size_t custom = example.rfind("<custom>");
  const std::string asked =
      replaced(example.substr(0, custom), "<body name=\"disc\">", body) + shown + "</mujoco>";
  EXPECT_EQ(run(load(asked).get(), 2000), run(load(example).get(), 2000));
}

}  // namespace
}  // namespace rotorub::test
