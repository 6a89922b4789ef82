// rotorub fmu: the plant in an importer that uses only the archive.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/cli/fmu/importer.h"
#include "tests/cli/program.h"

namespace rotorub::test {
namespace {

// The rows of series.csv by column; modes as the plant's numbers.
std::map<std::string, std::vector<double>> series_in(const Folder& folder,
                                                     const std::string& file) {
  std::istringstream lines(folder.text(file));
  std::map<std::string, std::vector<double>> series;
  std::vector<std::string> names;
  std::string line, word;
  for (int row = 0; std::getline(lines, line); ++row) {
    std::istringstream words(line);
    for (std::size_t k = 0; std::getline(words, word, ','); ++k) {
      if (row == 0) {
        names.push_back(word);
        continue;
      }
      const std::map<std::string, double> modes{{"free", 0.0}, {"slide", 1.0}, {"stick", 2.0}};
      series[names[k]].push_back(modes.contains(word) ? modes.at(word) : std::stod(word));
    }
  }
  return series;
}

// The FMU of a shipped scene, unpacked.
UnpackedFmu fmu_of(const Folder& folder, const std::string& scene,
                   const std::vector<std::string>& more = {}) {
  folder.done(with({"fmu", shipped(scene), "-q", "-o", "plant.fmu"}, more));
  return {folder.path() / "plant.fmu", folder.path() / "unpacked"};
}

// Steps of a power of two, whose multiples are exact.
constexpr double kStep = 0x1p-11;

class FmuOfScene : public testing::TestWithParam<const char*> {};

TEST_P(FmuOfScene, GivesTheBitsOfARunAndStepsBackByASavedState) {
  const Folder folder;
  const std::vector<std::string> sets{"--set", "run.end=0.0625", "--set",
                                      "run.output_step=0.00048828125"};
  folder.done(with({"run", shipped(GetParam()), "--integrator", "event", "-q", "-o", "out"}, sets));
  const auto series = series_in(folder, "out/series.csv");
  const UnpackedFmu fmu = fmu_of(folder, GetParam(), with(sets, {"--modal"}));
  Plant plant(fmu);
  ASSERT_TRUE(static_cast<bool>(plant)) << plant.said;
  ASSERT_EQ(plant.initialize(0.0, true, 0.0625), kFmiOK) << plant.said;

  constexpr std::size_t kSaved = 37;
  const std::size_t rows = series.at("t").size();
  ASSERT_EQ(rows, 129u);
  const auto expect_rows = [&](std::size_t from) {
    for (std::size_t row = from; row < rows; ++row) {
      if (row > 0) {
        const Plant::Step did = plant.step(static_cast<double>(row - 1) * kStep, kStep);
        ASSERT_EQ(did.status, kFmiOK) << plant.said;
        EXPECT_FALSE(did.event || did.ends || did.early);
        EXPECT_EQ(did.time, series.at("t")[row]);
      }
      for (const auto& [name, column] : series) {
        if (name == "t") continue;
        ASSERT_EQ(plant.get(name), column[row]) << name << ", row " << row;
      }
      if (row == kSaved && from == 0) {
        ASSERT_EQ(plant.of_state("GetFMUState"), kFmiOK);
      }
    }
  };
  expect_rows(0);
  for (int again = 0; again < 2; ++again) {
    ASSERT_EQ(plant.set_state(), kFmiOK);
    expect_rows(kSaved + 1);
  }
  EXPECT_EQ(plant.of_state("FreeFMUState"), kFmiOK);
  EXPECT_EQ(plant.state, nullptr);
  // Starts again.
  ASSERT_EQ(plant.call("Reset"), kFmiOK);
  ASSERT_EQ(plant.initialize(0.0, false, 0.0), kFmiOK);
  expect_rows(0);
  EXPECT_EQ(plant.of_state("FreeFMUState"), kFmiOK);
}
INSTANTIATE_TEST_SUITE_P(Scenes, FmuOfScene,
                         testing::Values("paper_passive", "paper_sliding_sampled", "two_catchers",
                                         "amb_machine"),
                         [](const auto& scene) { return std::string(scene.param); });

// ------------------------------------------------------------------ parameters

// The last values of the columns of a run that ends at 0.0625 s with these overrides.
std::map<std::string, double> end_of_run(const Folder& folder, const std::string& scene,
                                         const std::vector<std::string>& sets) {
  std::vector<std::string> call{"run",
                                shipped(scene),
                                "--integrator",
                                "event",
                                "-q",
                                "-o",
                                "changed",
                                "--set",
                                "run.end=0.0625",
                                "--set",
                                "run.output_step=0.0625"};
  for (const std::string& change : sets) call = with(call, {"--set", change});
  folder.done(call);
  std::map<std::string, double> last;
  for (const auto& [name, column] : series_in(folder, "changed/series.csv"))
    last[name] = column.back();
  return last;
}

// In the notation of --set: "force[0].vector.x" is an element of the list force[0].vector.
std::string override_of(const UnpackedFmu& fmu, const std::string& name, double value) {
  std::ostringstream change;
  change.precision(17);
  const std::string vector = name.substr(0, name.size() - 2);
  if (name.ends_with(".x"))
    change << vector << "=[" << value << ", " << fmu.parameters.at(vector + ".y").start << "]";
  else if (name.ends_with(".y"))
    change << vector << "=[" << fmu.parameters.at(vector + ".x").start << ", " << value << "]";
  else
    change << name << "=" << value;
  return change.str();
}

class FmuParameters : public testing::TestWithParam<const char*> {};

// Each parameter is the key of its name: it gives the bits of `rotorub run --set` with the same
// value.
TEST_P(FmuParameters, GiveTheBitsOfARunWithTheSameValues) {
  const Folder folder;
  const UnpackedFmu fmu = fmu_of(folder, GetParam(), {"--set", "run.end=0.0625"});
  EXPECT_TRUE(fmu.parameters.contains("contact.friction") ||
              fmu.parameters.contains("contact[0].friction"));
  EXPECT_GE(fmu.parameters.size(), 5u) << "friction, clearance, restitution, a load";
  Plant plant(fmu);
  const auto expect_run = [&](const std::vector<std::string>& sets) {
    for (double t = 0.0; t < 0.0625; t += 0x1p-8)
      ASSERT_EQ(plant.step(t, 0x1p-8).status, kFmiOK) << plant.said;
    for (const auto& [name, value] : end_of_run(folder, GetParam(), sets)) {
      if (name != "t" && fmu.outputs.contains(name)) {
        EXPECT_EQ(plant.get(name), value) << name << " with " << testing::PrintToString(sets);
      }
    }
  };
  for (const auto& [name, parameter] : fmu.parameters) {
    const double value = parameter.start == 0.0 ? 0.015625 : 0.9375 * parameter.start;
    const std::string change = override_of(fmu, name, value);
    ASSERT_EQ(plant.call("Reset"), kFmiOK);
    EXPECT_EQ(plant.get(name), parameter.start);
    ASSERT_EQ(plant.enter_initialization(0.0, true, 0.0625), kFmiOK);
    ASSERT_EQ(plant.set(name, value), kFmiOK) << plant.said;
    EXPECT_EQ(plant.get(name), value);
    ASSERT_EQ(plant.call("ExitInitializationMode"), kFmiOK) << plant.said;
    expect_run({change});
  }
  // All of them at once, set before the initialization.
  ASSERT_EQ(plant.call("Reset"), kFmiOK);
  std::vector<std::string> all;
  for (const auto& [name, parameter] : fmu.parameters) {
    if (name.ends_with(".x") || name.ends_with(".y")) continue;
    const double value = parameter.start == 0.0 ? 0.015625 : 0.9375 * parameter.start;
    all.push_back(override_of(fmu, name, value));
    ASSERT_EQ(plant.set(name, value), kFmiOK);
  }
  ASSERT_EQ(plant.initialize(0.0, true, 0.0625), kFmiOK) << plant.said;
  expect_run(all);
  // Without parameters it is the plant of the scene.
  ASSERT_EQ(plant.call("Reset"), kFmiOK);
  ASSERT_EQ(plant.initialize(0.0, true, 0.0625), kFmiOK);
  expect_run({});
}
INSTANTIATE_TEST_SUITE_P(Scenes, FmuParameters,
                         testing::Values("paper_passive", "paper_sliding_sampled", "two_catchers",
                                         "bench_drop", "bench_ring"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(Fmu, ParametersAreRefusedWithAWord) {
  const Folder folder;
  const UnpackedFmu fmu = fmu_of(folder, "bench_ring");
  Plant plant(fmu);
  const auto refuses = [&](int status, std::initializer_list<std::string_view> words) {
    EXPECT_EQ(status, kFmiError);
    EXPECT_TRUE(contains(plant.said, words));
    plant.said.clear();
  };
  ASSERT_EQ(plant.set("contact.friction", -0.1), kFmiOK) << "values are judged together";
  refuses(plant.initialize(0.0, false, 0.0), {"parameter contact.friction", ">= 0"});
  ASSERT_EQ(plant.set("contact.friction", 0.1), kFmiOK);
  refuses(plant.set("contact.clearance", std::nan("")), {"contact.clearance is not finite"});
  ASSERT_EQ(plant.initialize(0.0, false, 0.0), kFmiOK) << plant.said;
  refuses(plant.set("contact.friction", 0.2), {"contact.friction is fixed", "initialization"});
  EXPECT_EQ(plant.get("contact.friction"), 0.1);
}

// A saved state belongs to the parameters with which it was saved.
TEST(Fmu, ASavedStateKeepsItsParameters) {
  const Folder folder;
  const UnpackedFmu fmu = fmu_of(folder, "bench_ring");
  Plant plant(fmu);
  const auto rotor_after = [&] {
    EXPECT_EQ(plant.step(0.03125, 0.03125).status, kFmiOK) << plant.said;
    return plant.get("rotor_x");
  };
  ASSERT_EQ(plant.set("contact.friction", 0.05), kFmiOK);
  ASSERT_EQ(plant.initialize(0.0, false, 0.0), kFmiOK);
  ASSERT_EQ(plant.step(0.0, 0.03125).status, kFmiOK);
  ASSERT_EQ(plant.of_state("GetFMUState"), kFmiOK);
  const double with_less = rotor_after();
  ASSERT_EQ(plant.call("Reset"), kFmiOK);
  ASSERT_EQ(plant.set("contact.friction", 0.25), kFmiOK);
  ASSERT_EQ(plant.initialize(0.0, false, 0.0), kFmiOK);
  ASSERT_EQ(plant.step(0.0, 0.03125).status, kFmiOK);
  EXPECT_NE(rotor_after(), with_less);
  ASSERT_EQ(plant.set_state(), kFmiOK);
  EXPECT_EQ(plant.get("contact.friction"), 0.05);
  EXPECT_EQ(rotor_after(), with_less);
  EXPECT_EQ(plant.of_state("FreeFMUState"), kFmiOK);
}

// Coordinates of single modes are shown on request; shown variables always keep their reference.
TEST(Fmu, ShowsModalCoordinatesOnRequest) {
  const Folder folder;
  folder.done({"fmu", shipped("paper_passive"), "-q", "-o", "named.fmu"});
  folder.done({"fmu", shipped("paper_passive"), "--modal", "-q", "-o", "modal.fmu"});
  const UnpackedFmu named(folder.path() / "named.fmu", folder.path() / "named"),
      modal(folder.path() / "modal.fmu", folder.path() / "modal");
  for (const char* name : {"x_1", "vy_8", "torsion_1", "torsion_speed_1"}) {
    EXPECT_TRUE(modal.outputs.contains(name)) << name;
    EXPECT_FALSE(named.outputs.contains(name)) << name;
  }
  for (const char* name : {"rotor_x", "gap", "normal_force", "normal_impulse", "impacts"})
    EXPECT_EQ(named.outputs.at(name).reference, modal.outputs.at(name).reference) << name;
}

TEST(Fmu, ReturnsAtEventsToAnImporterThatHandlesThem) {
  const Folder folder;
  folder.done({"run", shipped("bench_drop"), "--end", "0.0625", "-q", "-o", "out"});
  const auto impacts = series_in(folder, "out/impacts.csv");
  const UnpackedFmu fmu = fmu_of(folder, "bench_drop", {"--set", "run.end=0.0625"});
  Plant plant(fmu, true);
  ASSERT_EQ(plant.initialize(0.0, true, 0.0625), kFmiOK);
  std::size_t met = 0;
  for (double t = 0.0; t < 0.0625 && met < 5;) {
    const Plant::Step did = plant.step(t, 0.0625 - t);
    ASSERT_EQ(did.status, kFmiOK) << plant.said;
    t = did.time;
    if (!did.event) continue;
    EXPECT_TRUE(did.early);
    EXPECT_EQ(t, impacts.at("t")[met]);
    EXPECT_NEAR(plant.get("gap_rate"), impacts.at("gap_rate_before")[met], 1e-12);
    ASSERT_EQ(plant.pass_event(), kFmiOK);
    EXPECT_NEAR(plant.get("gap_rate"), impacts.at("gap_rate_after")[met], 1e-12);
    EXPECT_EQ(plant.get("impacts"), static_cast<double>(++met));
  }
  EXPECT_EQ(met, 5u);
}

// A law outside, step by step: its commands reach the plant, within the actuator's limit.
TEST(Fmu, TakesTheCommandOfALawOutside) {
  const Folder folder;
  const UnpackedFmu fmu = fmu_of(folder, "paper_passive", {"--set", "actuator.force_limit=50"});
  Plant plant(fmu);
  ASSERT_EQ(plant.initialize(0.0, false, 0.0), kFmiOK) << plant.said;
  // m, root of the mean square of the ring's deflection, half of it in the rub from 106 ms on.
  const auto moved = [&](double stiffness) {
    constexpr double kSample = 0x1p-12;
    double sum = 0.0;
    for (int k = 0; k < 900; ++k) {
      EXPECT_EQ(plant.step(kSample * k, kSample).status, kFmiOK) << plant.said;
      for (const char* axis : {"x", "y"}) {
        EXPECT_LE(std::abs(plant.get(std::string("control_") + axis)), 50.0 * std::sqrt(2.0));
        const double at = plant.get(std::string("stator_") + axis);
        sum += at * at;
        EXPECT_EQ(plant.set(std::string("command_") + axis, -stiffness * at), kFmiOK);
      }
    }
    return std::sqrt(sum / 900.0);
  };
  const double free = moved(0.0);
  ASSERT_EQ(plant.call("Reset"), kFmiOK);
  ASSERT_EQ(plant.initialize(0.0, false, 0.0), kFmiOK);
  const double held = moved(5e4);
  EXPECT_GT(free, 1e-5);
  EXPECT_LT(held, 0.9 * free) << "a stiffer ring moves less";
}

// The binary has every function that the standard declares, and refuses unsupported calls with a
// message.
TEST(Fmu, HasEveryFunctionAndRefusesWithAWord) {
  const Folder folder;
  const UnpackedFmu fmu = fmu_of(folder, "bench_ring");
  Plant plant(fmu);
  std::istringstream names(
      R"(GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation
InstantiateScheduledExecution FreeInstance EnterInitializationMode ExitInitializationMode
EnterEventMode Terminate Reset GetFloat32 GetFloat64 GetInt8 GetUInt8 GetInt16 GetUInt16
GetInt32 GetUInt32 GetInt64 GetUInt64 GetBoolean GetString GetBinary GetClock SetFloat32
SetFloat64 SetInt8 SetUInt8 SetInt16 SetUInt16 SetInt32 SetUInt32 SetInt64 SetUInt64
SetBoolean SetString SetBinary SetClock GetNumberOfVariableDependencies
GetVariableDependencies GetFMUState SetFMUState FreeFMUState SerializedFMUStateSize
SerializeFMUState DeserializeFMUState GetDirectionalDerivative GetAdjointDerivative
EnterConfigurationMode ExitConfigurationMode GetIntervalDecimal GetIntervalFraction
GetShiftDecimal GetShiftFraction SetIntervalDecimal SetIntervalFraction SetShiftDecimal
SetShiftFraction EvaluateDiscreteStates UpdateDiscreteStates EnterContinuousTimeMode
CompletedIntegratorStep SetTime SetContinuousStates GetContinuousStateDerivatives
GetEventIndicators GetContinuousStates GetNominalsOfContinuousStates
GetNumberOfEventIndicators GetNumberOfContinuousStates EnterStepMode GetOutputDerivatives
DoStep ActivateModelPartition)");
  for (std::string name; names >> name;) {
    plant.function<void*>(name);
  }
  const auto refuses = [&](int status, const char* word) {
    EXPECT_EQ(status, kFmiError);
    EXPECT_TRUE(contains(plant.said, word));
    plant.said.clear();
  };
  EXPECT_STREQ(plant.function<const char* (*)()>("GetVersion")(), "3.0");
  refuses(plant.initialize(1.0, false, 0.0), "begins at t = 0");
  ASSERT_EQ(plant.initialize(0.0, false, 0.0), kFmiOK);
  refuses(plant.step(0.5, 1e-3).status, "the plant is at t = 0");
  refuses(plant.step(0.0, 0.0).status, "above 0");
  refuses(plant.set("load_x", std::nan("")), "not finite");
  refuses(plant.call("EnterEventMode"), "eventModeUsed");
  refuses(plant.call("EnterConfigurationMode"), "does not offer");
}

TEST(Fmu, BelongsToTheSceneThatItsDescriptionNames) {
  const Folder folder;
  const UnpackedFmu fmu = fmu_of(folder, "bench_ring");
  std::ofstream(folder.path() / "unpacked/resources/scene.toml", std::ios::app) << "# another\n";
  Plant plant(fmu);
  EXPECT_FALSE(static_cast<bool>(plant));
  EXPECT_TRUE(contains(plant.said, "is of another scene"));
}

TEST(Fmu, IsAnArchiveOfTheSameBytesEveryTime) {
  const Folder folder;
  const json said = folder.json_of({"fmu", shipped("bench_ring"), "--json"});
  EXPECT_EQ(said.at("file"), "bench_ring.fmu");
  EXPECT_EQ(said.at("fmi_version"), "3.0");
  EXPECT_EQ(said.at("inputs")[0].at("name"), "command_x");
  folder.done({"fmu", shipped("bench_ring"), "-q", "-o", "again.fmu"});
  EXPECT_EQ(folder.text("bench_ring.fmu"), folder.text("again.fmu"));
  expect_whole_files(folder);
  folder.refuses({"fmu", shipped("finite_impacts"), "-o", "none.fmu"},
                 {"contact.compression_time"});
  EXPECT_FALSE(folder.has("none.fmu"));
}

// The same plant through the functions of FMI 2.0.
TEST(Fmu, OfVersionTwoGivesTheSameNumbers) {
  const Folder folder;
  for (const char* version : {"3.0", "2.0"}) {
    folder.done({"fmu", shipped("paper_passive"), "--fmi", version, "-q", "-o",
                 std::string(version) + ".fmu"});
  }
  const UnpackedFmu three(folder.path() / "3.0.fmu", folder.path() / "3"),
      two(folder.path() / "2.0.fmu", folder.path() / "the second");
  Plant plant(three);
  ASSERT_EQ(plant.initialize(0.0, true, 0.05), kFmiOK);

  void* library = dlopen(two.binary().c_str(), kOpening);
  ASSERT_NE(library, nullptr);
  const auto function = [&]<class F>(const char* name, F) {
    return reinterpret_cast<F>(dlsym(library, name));
  };
  using OfInstance = int (*)(void*);
  const struct {
    void (*log)(void*, const char*, int, const char*, const char*, ...);
    void* (*allocate)(std::size_t, std::size_t);
    void (*release)(void*);
    void (*finished)(void*, int);
    void* environment;
  } callbacks{nullptr, calloc, free, nullptr, nullptr};
  std::string location = "file://" + two.resources();
  location.replace(location.find(' '), 1, "%20");
  using Instantiate = void* (*)(const char*, int, const char*, const char*, const void*, int, int);
  void* instance = function("fmi2Instantiate", Instantiate{})(
      "plant", 1, two.attribute("guid").c_str(), location.c_str(), &callbacks, 0, 0);
  ASSERT_NE(instance, nullptr);
  using SetUpExperiment = int (*)(void*, int, double, double, int, double);
  ASSERT_EQ(function("fmi2SetupExperiment", SetUpExperiment{})(instance, 0, 0.0, 0.0, 1, 0.05),
            kFmiOK);
  for (const char* name : {"fmi2EnterInitializationMode", "fmi2ExitInitializationMode"})
    ASSERT_EQ(function(name, OfInstance{})(instance), kFmiOK);
  // The description of 2.0 writes a variable as an element around its type, in the same order.
  for (const auto& [name, output] : three.outputs)
    EXPECT_TRUE(contains(two.description(), "name=\"" + name + "\" valueReference=\"" +
                                                std::to_string(output.reference) + "\""));
  for (int k = 0; k < 50; ++k) {
    ASSERT_EQ(plant.step(1e-3 * k, 1e-3).status, kFmiOK);
    using DoStep = int (*)(void*, double, double, int);
    ASSERT_EQ(function("fmi2DoStep", DoStep{})(instance, 1e-3 * k, 1e-3, 1), kFmiOK);
    for (const auto& [name, output] : three.outputs) {
      if (output.whole) continue;
      double value = 0.0;
      using GetReal = int (*)(void*, const Reference*, std::size_t, double*);
      ASSERT_EQ(function("fmi2GetReal", GetReal{})(instance, &output.reference, 1, &value), kFmiOK);
      ASSERT_EQ(value, plant.get(name)) << name;
    }
  }
  function("fmi2FreeInstance", static_cast<void (*)(void*)>(nullptr))(instance);
  dlclose(library);
}

}  // namespace
}  // namespace rotorub::test
