// The same bits on every processor: the C library is told that this one has neither AVX2 nor FMA,
// and then takes other versions of sin, cos, exp, pow, ...

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

// Names of glibc 2.36; a later one knows AVX2 and FMA alone and takes no notice of the others.
const Surroundings kOldProcessor{
    {{"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable"}},
    "standard_output"};

struct Case {
  const char* scene;
  const char* integrator;
  const char* end;
};

TEST(CliBits, AreThoseOfAnOlderProcessor) {
  for (const Case& c :
       {Case{"bench_ring", "event", "0.5"}, Case{"bench_ring", "verlet", "0.1"},
        Case{"paper_passive", "event", "50ms"}, Case{"paper_passive", "verlet", "20ms"}}) {
    const Folder folder;
    const auto run = [&](const std::string& to, const Surroundings& on) {
      const Outcome done = folder.done(
          {"run", shipped(c.scene), "--set", std::string("run.integrator=") + c.integrator, "--end",
           c.end, "--quiet", "-o", to},
          on);
    };
    run("new", {});
    run("old", kOldProcessor);
    for (const char* file : {"series.csv", "impacts.csv", "events.csv", "keyphasor.csv"}) {
      EXPECT_TRUE(folder.text(std::string("new/") + file) ==
                  folder.text(std::string("old/") + file))
          << c.scene << ", " << c.integrator << ": " << file;
    }
  }
}

// A shaft's modes, and the MJCF that is made of them.
TEST(CliBits, OfModesAndMjcfAreThoseOfAnOlderProcessor) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"mjcf", shipped("paper_passive")},
                                             {"mjcf", shipped("paper_passive"), "--set",
                                              "mujoco.rotor=segments", "--set", "rotor.modes=2"},
                                             {"modes", shipped("paper_passive"), "--json"}}) {
    const Folder folder;
    const Outcome here = folder.done(arguments);
    EXPECT_TRUE(here.out == folder.run(arguments, kOldProcessor).out) << arguments.back();
  }
}

}  // namespace
}  // namespace rotorub::test
