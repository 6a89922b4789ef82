// A small importer of FMUs: the archive unpacked, modelDescription.xml read, the binary opened, and
// the functions of FMI 3.0 for Co-Simulation declared after the standard's text (2.2, 2.3, 4.2).
#pragma once

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <zip.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rotorub::test {

// The leak checker finds memory that a module's variables hold only while the module is loaded.
#ifdef __SANITIZE_ADDRESS__
inline constexpr int kOpening = RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE;
#else
inline constexpr int kOpening = RTLD_NOW | RTLD_LOCAL;
#endif

using Reference = std::uint32_t;
constexpr int kFmiOK = 0, kFmiError = 3;

class UnpackedFmu {
 public:
  UnpackedFmu(const std::filesystem::path& file, std::filesystem::path folder)
      : folder_(std::move(folder)) {
    zip_t* zip = zip_open(file.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, nullptr);
    if (zip == nullptr) throw std::runtime_error("no archive: " + file.string());
    for (zip_int64_t i = 0; i < zip_get_num_entries(zip, 0); ++i) {
      zip_stat_t about;
      zip_stat_index(zip, static_cast<zip_uint64_t>(i), 0, &about);
      std::string bytes(about.size, '\0');
      zip_file_t* entry = zip_fopen_index(zip, static_cast<zip_uint64_t>(i), 0);
      EXPECT_EQ(zip_fread(entry, bytes.data(), bytes.size()),
                static_cast<zip_int64_t>(bytes.size()));
      EXPECT_EQ(zip_fclose(entry), 0) << "its checksum";
      const std::filesystem::path to = folder_ / about.name;
      std::filesystem::create_directories(to.parent_path());
      std::ofstream(to, std::ios::binary) << bytes;
      names_.push_back(about.name);
    }
    zip_close(zip);
    std::ifstream in(folder_ / "modelDescription.xml");
    description_.assign(std::istreambuf_iterator<char>(in), {});
    const std::regex variable(
        R"re(<(\w+) name="([^"]+)" valueReference="(\d+)"[^>]* causality="(\w+)")re");
    for (std::sregex_iterator at(description_.begin(), description_.end(), variable), end;
         at != end; ++at) {
      const auto reference = static_cast<Reference>(std::stoul((*at)[3]));
      if ((*at)[4] == "input") inputs[(*at)[2]] = reference;
      if ((*at)[4] == "parameter") parameters[(*at)[2]] = {reference, start_of((*at)[2])};
      if ((*at)[4] == "output") outputs[(*at)[2]] = {reference, (*at)[1] == "Int32"};
    }
  }

  struct Output {
    Reference reference;
    bool whole;
  };
  struct Parameter {
    Reference reference;
    double start;
  };
  std::map<std::string, Reference> inputs;
  std::map<std::string, Parameter> parameters;
  std::map<std::string, Output> outputs;

  const std::string& description() const { return description_; }
  std::string attribute(const std::string& name) const {
    std::smatch found;
    std::regex_search(description_, found, std::regex(" " + name + "=\"([^\"]*)\""));
    return found[1];
  }
  std::string resources() const { return (folder_ / "resources" / "").string(); }
  std::filesystem::path binary() const {
    for (const std::string& name : names_) {
      if (name.starts_with("binaries/")) return folder_ / name;
    }
    return {};
  }

 private:
  double start_of(const std::string& name) const {
    const std::size_t at = description_.find("name=\"" + name + "\"");
    const std::string start = " start=\"";
    return std::stod(description_.substr(description_.find(start, at) + start.size()));
  }

  std::filesystem::path folder_;
  std::vector<std::string> names_;
  std::string description_;
};

// An instance of an FMU of FMI 3.0.
class Plant {
 public:
  explicit Plant(const UnpackedFmu& fmu, bool events = false) : fmu_(fmu) {
    library_ = dlopen(fmu.binary().c_str(), kOpening);
    if (library_ == nullptr) throw std::runtime_error(dlerror());
    using Instantiate = void* (*)(const char*, const char*, const char*, bool, bool, bool, bool,
                                  const Reference*, std::size_t, void*, Log, void*);
    instance_ = function<Instantiate>("InstantiateCoSimulation")(
        "plant", fmu.attribute("instantiationToken").c_str(), fmu.resources().c_str(), false, false,
        events, events, nullptr, 0, this, log, nullptr);
  }
  ~Plant() {
    if (instance_) function<void (*)(void*)>("FreeInstance")(instance_);
    dlclose(library_);
  }
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;

  template <class Function>
  Function function(const std::string& name) const {
    void* symbol = dlsym(library_, ("fmi3" + name).c_str());
    EXPECT_NE(symbol, nullptr) << name;
    return reinterpret_cast<Function>(symbol);
  }
  // A function of the instance alone.
  int call(const std::string& name) { return function<int (*)(void*)>(name)(instance_); }

  int enter_initialization(double start, bool has_stop, double stop) {
    return function<int (*)(void*, bool, double, double, bool, double)>("EnterInitializationMode")(
        instance_, false, 0.0, start, has_stop, stop);
  }
  int initialize(double start, bool has_stop, double stop) {
    const int entered = enter_initialization(start, has_stop, stop);
    return entered == kFmiOK ? call("ExitInitializationMode") : entered;
  }
  struct Step {
    int status = kFmiError;
    bool event = false, ends = false, early = false;
    double time = 0.0;
  };
  Step step(double from, double length) {
    Step did;
    did.status = function<int (*)(void*, double, double, bool, bool*, bool*, bool*, double*)>(
        "DoStep")(instance_, from, length, false, &did.event, &did.ends, &did.early, &did.time);
    return did;
  }
  int pass_event() {
    EXPECT_EQ(call("EnterEventMode"), kFmiOK);
    bool again, ends, nominals, values, defined;
    double next;
    const int status = function<int (*)(void*, bool*, bool*, bool*, bool*, bool*, double*)>(
        "UpdateDiscreteStates")(instance_, &again, &ends, &nominals, &values, &defined, &next);
    EXPECT_FALSE(again || ends);
    return status == kFmiOK ? call("EnterStepMode") : status;
  }
  int set(const std::string& name, double value) {
    const Reference reference =
        fmu_.inputs.contains(name) ? fmu_.inputs.at(name) : fmu_.parameters.at(name).reference;
    return function<int (*)(void*, const Reference*, std::size_t, const double*, std::size_t)>(
        "SetFloat64")(instance_, &reference, 1, &value, 1);
  }
  double get(const std::string& name) {
    const bool parameter = fmu_.parameters.contains(name);
    const UnpackedFmu::Output output =
        parameter ? UnpackedFmu::Output{fmu_.parameters.at(name).reference, false}
                  : fmu_.outputs.at(name);
    double number = 0.0;
    std::int32_t whole = 0;
    const auto ask = [&](const char* type, auto* value) {
      using Value = decltype(value);
      EXPECT_EQ((function<int (*)(void*, const Reference*, std::size_t, Value, std::size_t)>(type)(
                    instance_, &output.reference, 1, value, 1)),
                kFmiOK)
          << name;
    };
    output.whole ? ask("GetInt32", &whole) : ask("GetFloat64", &number);
    return output.whole ? whole : number;
  }
  void* state = nullptr;
  int of_state(const char* name) {
    return function<int (*)(void*, void**)>(name)(instance_, &state);
  }
  int set_state() { return function<int (*)(void*, void*)>("SetFMUState")(instance_, state); }

  explicit operator bool() const { return instance_ != nullptr; }
  std::string said;

 private:
  using Log = void (*)(void*, int, const char*, const char*);
  static void log(void* plant, int, const char*, const char* message) {
    static_cast<Plant*>(plant)->said += message;
  }

  const UnpackedFmu& fmu_;
  void *library_ = nullptr, *instance_ = nullptr;
};

}  // namespace rotorub::test
