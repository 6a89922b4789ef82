// `rotorub compare --measured` by its command line: its output, files and refusals.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

std::vector<std::string> comparison(const std::vector<std::string>& more) {
  return with({"compare", shipped("bench_ring"), "--end", "0.05", "--twins", "0",
               "--no-modes-ladder", "--no-video", "-o", "out"},
              more);
}

// A run's own series as measured by another clock: t + 0.25 s, in ms, x and y as sensors see them
// that stand a quarter turn on (x' = y, y' = -x).
void write_measurement(const Folder& folder, const std::string& name) {
  folder.done({"run", shipped("bench_ring"), "--integrator", "event", "--end", "0.05", "--set",
               "run.output_step=50us", "-o", "rig", "-q"});
  std::istringstream series(folder.text("rig/series.csv"));
  std::ofstream out(folder.path() / name);
  out << "# rig 1, made by a test\nt [ms];rotor_x [mm];rotor_y [mm]\n";
  out.precision(17);
  std::string line;
  std::getline(series, line);
  while (std::getline(series, line)) {
    double t = 0.0, x = 0.0, y = 0.0;
    char comma = 0;
    std::istringstream(line) >> t >> comma >> x >> comma >> y;
    out << 1e3 * (t + 0.25) << ';' << 1e3 * y << ';' << -1e3 * x << '\n';
  }
}

TEST(CliMeasured, IsLaidBesideTheRuns) {
  const Folder folder;
  write_measurement(folder, "rig.csv");
  const Outcome done = folder.run(comparison({"--measured", "rig.csv"}));
  EXPECT_LE(done.code, 1) << done.err;
  EXPECT_TRUE(contains(done.out,
                       {"measured: rig.csv, 1001 samples, 50 µs apart", "rotor's whirl, rms, µm"}));
  const json all = folder.json_in("out/compare.json").at("scenes")[0].at("measured");
  const json& alignment = all.at("alignment");
  // The integrators differ by some nm here, which corresponds to some ns.
  EXPECT_NEAR(alignment.at("shift").get<double>(), -0.25, 1e-6);
  EXPECT_NEAR(alignment.at("angle").get<double>(), 1.5707963, 1e-4);
  EXPECT_EQ(alignment.at("by"), json::array({"rotor"}));
  for (const char* run : {"native", "rigid", "coulomb", "cone", "cone-coulomb"}) {
    EXPECT_TRUE(all.at("columns").at("rotor_x").at("runs").contains(run)) << run;
    EXPECT_TRUE(all.at("figures").at("rotor_rms").at("runs").contains(run)) << run;
  }
  EXPECT_LT(all.at("columns").at("rotor_x").at("runs").at("native").at("share").get<double>(),
            1e-3);
  EXPECT_TRUE(folder.json_in("out/columns.json").contains("compare.json measured"));
  const std::string page = folder.text("out/report.html");
  EXPECT_TRUE(contains(page, {"\"title\":\"The measured run\"", "{\"id\":\"measured\"",
                              "\"label\":\"measured\",\"measured\":true"}));

  const Outcome told = folder.run(comparison(
      {"--measured", "rig.csv", "--measured-shift", "-249.9ms", "--measured-angle", "90deg"}));
  EXPECT_TRUE(contains(told.out, {"shift -249.900000 ms as given", "+90.000° as given"}));
}

// A record beside one native run, without MuJoCo; and two probes along the sensors' axes.
TEST(CliMeasured, IsLaidBesideOneRun) {
  const Folder folder;
  write_measurement(folder, "rig.csv");
  const std::vector<std::string> call{
      "run", shipped("bench_ring"), "--end",  "0.05", "--set", "run.output_step=50us", "-o",
      "out", "--measured",          "rig.csv"};
  const std::string table = folder.done(call).out;
  EXPECT_TRUE(contains(table, {"measured: rig.csv, 1001 samples", "sensors' x axis at +90.000°"}));
  const json measured =
      folder.json_of(with(call, {"--measured-probes", "90deg,180deg", "--json"})).at("measured");
  EXPECT_NEAR(measured.at("alignment").at("shift").get<double>(), -0.25, 1e-6);
  EXPECT_EQ(measured.at("alignment").at("angle_from"), "given");
  EXPECT_LT(measured.at("columns").at("rotor_x").at("runs").at("native").at("share").get<double>(),
            1e-3);
}

// Column names of a data logger.
TEST(CliMeasured, TakesTheColumnsByTheFilesNames) {
  const Folder folder;
  write_measurement(folder, "rig.csv");
  std::string text = folder.text("rig.csv");
  const std::string header = "t [ms];rotor_x [mm];rotor_y [mm]";
  text.replace(text.find(header), header.size(), "Time;Probe A;Probe B");
  std::ofstream(folder.path() / "log.csv") << text;
  const std::vector<std::string> call{"run",    shipped("bench_ring"),  "--end",  "0.05",
                                      "--set",  "run.output_step=50us", "-o",     "out",
                                      "--json", "--measured",           "log.csv"};
  folder.refuses(call);
  const json measured = folder
                            .json_of(with(call, {"--measured-column", "Time = t [ms]",
                                                 "--measured-column", "Probe A = rotor_x [mm]",
                                                 "--measured-column", "Probe B=rotor_y [mm]"}))
                            .at("measured");
  EXPECT_NEAR(measured.at("alignment").at("shift").get<double>(), -0.25, 1e-6);
}

// The friction of a run, found from its own series.
TEST(CliIdentify, FindsWhatTheRunHad) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "0.05", "--set", "run.output_step=50us",
               "--set", "contact.friction=0.23", "-o", "rig", "-q"});
  const std::vector<std::string> call{"identify",
                                      shipped("bench_ring"),
                                      "--end",
                                      "0.05",
                                      "--measured",
                                      "rig/series.csv",
                                      "--measured-shift",
                                      "0s",
                                      "--fit",
                                      "contact.friction=0.05:0.4",
                                      "-o",
                                      "found.toml"};
  const std::string table = folder.done(call).out;
  EXPECT_TRUE(contains(table, {"contact.friction", "written to found.toml"}));
  const json found = folder.json_of(with(call, {"--json"})).at("parameters")[0];
  EXPECT_NEAR(found.at("value").get<double>(), 0.23, 1e-4);
  EXPECT_TRUE(contains(folder.text("found.toml"), "friction = 0.2"));
  folder.done({"run", "found.toml", "-o", "again", "-q"});
}

TEST(CliIdentify, RefusalsSayWhatIsAccepted) {
  const Folder folder;
  folder.done({"run", shipped("bench_ring"), "--end", "0.05", "-o", "rig", "-q"});
  const auto refuses = [&](const std::string& fit, const std::string& said) {
    folder.refuses(
        {"identify", shipped("bench_ring"), "--measured", "rig/series.csv", "--fit", fit}, {said});
  };
  refuses("contact.friction", "this is not a key with a range");
  refuses("contact.friction=0.4:0.05", "FROM must be below TO");
  refuses("contact.frction=0.05:0.4", "did you mean `contact.friction`?");
  refuses("contact.clearance=1 N:2 N", "expected a length");
  refuses("run.integrator=0:1", "does not take a number");
}

struct Bad {
  std::vector<std::string> words;
  const char* says;
};

TEST(CliMeasured, RefusalsSayWhyAndLeaveNothing) {
  const Folder folder;
  std::ofstream(folder.path() / "bad.csv") << "t [ms], rotor [um]\n0,1\n";
  std::ofstream noise(folder.path() / "noise.csv");
  noise << "t [ms],rotor_x [um],rotor_y [um]\n";
  unsigned state = 1;
  for (int k = 0; k < 500; ++k) {
    noise << 0.1 * k;
    for (int c = 0; c < 2; ++c) {
      state = state * 1664525U + 1013904223U;
      noise << ',' << (state >> 16U) % 1000U;
    }
    noise << '\n';
  }
  noise.close();
  const std::vector<Bad> all = {
      {{"--measured", "none.csv"}, "none.csv: cannot be read"},
      {{"--measured", "bad.csv"}, "bad.csv:1: rotor: no such column"},
      {{"--measured", "noise.csv", "--measured-shift", "3 mm"}, "--measured-shift"},
      {{"--measured", "noise.csv", "--measured-angle", "3 mm"}, "--measured-angle"},
      {{"--measured-shift", "3ms"}, "--measured"},
      {{shipped("bench_drop"), "--measured", "noise.csv"}, "takes a single scene"},
      {{"--measured", "noise.csv"}, "no shift makes the record agree with the native run"},
      {{"--measured", "noise.csv", "--measured-shift", "7s"}, "samples in common"},
  };
  for (const Bad& bad : all) {
    SCOPED_TRACE(bad.says);
    const Outcome refused = folder.run(comparison(bad.words));
    EXPECT_EQ(refused.code, 2) << refused.out;
    EXPECT_TRUE(contains(refused.err, bad.says));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "compare.json"));
  }
}

}  // namespace
}  // namespace rotorub::test
