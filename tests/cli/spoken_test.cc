// The program repeats names and numbers as the user wrote them.
#include <fstream>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

const std::string kEscape = "\x1b[31m";

// A file name may contain terminal codes.
TEST(CliSpoken, NoEscapeSequenceOfANameIsEchoed) {
  const Folder folder;
  const std::string scene = "a" + kEscape + ".toml", out = "out" + kEscape;
  std::filesystem::copy_file(shipped("bench_ring"), folder.path() / scene);
  for (const std::vector<std::string>& call :
       std::vector<std::vector<std::string>>{{"run", scene, "--end", "1 ms", "-o", out},
                                             {"modes", scene, "-o", out + ".html"},
                                             {"mjcf", scene, "-o", out + ".xml"},
                                             {"plot", out},
                                             {"compare", scene, "--end", "1 ms", "--twins", "0",
                                              "--no-video", "--no-modes-ladder", "-o", out + "2"},
                                             {"run", scene, "--set", "contact.friction=-1"}}) {
    const Outcome done = folder.run(call);
    EXPECT_LT(done.code, 3) << done.err;
    EXPECT_FALSE(contains(done.out, "\x1b")) << call.front();
    EXPECT_FALSE(contains(done.err, "\x1b")) << call.front();
  }
  // The same for a text of a scene.
  const Outcome text =
      folder.run({"run", shipped("bench_ring"), "--set", "contact={name=\"a\\u001b[31m\"}"});
  EXPECT_EQ(text.code, 2);
  EXPECT_FALSE(contains(text.err, "\x1b"));
}

// The printed command that joins the shards can be pasted.
TEST(CliSpoken, TheHintOfSlurmIsQuoted) {
  const Folder folder;
  std::ofstream(folder.path() / "my study.toml")
      << "scene = \"" << shipped("bench_ring")
      << "\"\n[sample]\nkind = \"grid\"\n[[vary]]\nkey = \"contact.friction\"\nvalues = [0.1]\n"
         "[run]\nend = \"1 ms\"\n";
  std::filesystem::create_directory(folder.path() / "bin");
  std::ofstream(folder.path() / "bin/sbatch") << "#!/bin/sh\necho 7\n";
  std::filesystem::permissions(folder.path() / "bin/sbatch", std::filesystem::perms::owner_all);
  Surroundings around;
  around.environment.emplace_back("PATH", (folder.path() / "bin").string() + ":/usr/bin:/bin");
  const Outcome sent =
      folder.done({"sweep", "my study.toml", "-o", "out of $it", "--slurm"}, around);
  EXPECT_TRUE(
      contains(sent.out, "rotorub sweep 'my study.toml' -o 'out of $it' --merge 'out of $it'"));
}

TEST(CliSpoken, ASpeedWithoutAUnitIsNoted) {
  const Folder folder;
  const std::string note =
      "note: --speed = 3600 has no unit, so it is read as rad/s (34377 rpm); if you mean rpm, "
      "write "
      "\"3600 rpm\"";
  const std::vector<std::string> modes{"modes", shipped("bench_ring"), "--speed"};
  EXPECT_TRUE(contains(folder.done(with(modes, {"3600"})).err, note));
  EXPECT_TRUE(contains(folder.done({"init", "fast", "--speed", "3600"}).err, note));
  for (const char* meant : {"3600 rpm", "314.159", "3601"}) {
    EXPECT_FALSE(contains(folder.done(with(modes, {meant})).err, "has no unit")) << meant;
  }
}

// One sentence covers all coefficients of a bearing.
TEST(CliSpoken, NamesOfRossAreTranslated) {
  const Folder folder;
  folder.done({"init", "ross", "-q"});
  std::string text = folder.text("ross.toml");
  const std::string ours = "stiffness = ";
  text.insert(text.find(ours, text.find("[[rotor.bearing]]")), "kxx = 1e7\nkyy = 1e7\ncxx = 100\n");
  std::ofstream(folder.path() / "ross.toml") << text;
  const Outcome refused = folder.run({"run", "ross.toml"});
  EXPECT_EQ(refused.code, 2);
  const std::string said = "this is a name of ROSS. Write stiffness = [kxx, kyy]";
  EXPECT_TRUE(contains(refused.err, "rotor.bearing[0].kxx: unknown key; " + said));
  EXPECT_EQ(refused.err.find(said), refused.err.rfind(said)) << refused.err;
}

// A path with a blank is in quotes in the next command, which can be copied.
TEST(CliSpoken, QuotesAPathInTheNextCommand) {
  const Folder folder;
  EXPECT_TRUE(contains(folder.done({"init", "my rotor"}).out, "try: rotorub run 'my rotor.toml'"));
  EXPECT_TRUE(contains(folder.done({"init", "my rig", "--form", "controller"}).out,
                       {"-I 'my rig_controller' 'my rig_controller/follow.c' -o follow.so",
                        "rotorub run 'my rig.toml' --controller follow.so"}));
}

}  // namespace
}  // namespace rotorub::test
