// Every number of every shipped scene at its smallest legal value, one at a time, by every engine:
// each run ends well or says why not, stays finite and in its ring, and engines of one law agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/schema.h"
#include "tests/compare/shipped/engines.h"
#include "tests/support/order.h"

namespace rotorub::test {
namespace {

struct GivenKey {
  std::string path;  // "rotor.disc[1].mass"
  const scene::Key* key;
};

// The keys that stand in the scene's file and have a smallest value, but for those of the run
// itself.
std::vector<GivenKey> bounded_keys(const std::string& name) {
  std::ifstream file(std::string(ROTORUB_MJCF_DIR) + name + ".toml");
  const std::regex header(R"(^\s*\[(\[?)([\w.]+)\]\]?.*)"), entry(R"(^\s*(\w+)\s*=.*)");
  std::map<std::string, int> count;
  std::vector<GivenKey> keys;
  std::string line, path;
  const scene::Table* table = nullptr;
  while (std::getline(file, line)) {
    std::smatch match;
    if (std::regex_match(line, match, header)) {
      path = match[2];
      table = scene::find_table(path);
      if (match[1].length() > 0) path += "[" + std::to_string(count[path]++) + "]";
      if (path == "run" || path.starts_with("check") || path.starts_with("mujoco")) table = nullptr;
    } else if (table && std::regex_match(line, match, entry)) {
      const scene::Key* key = table->find(match[1].str());
      const bool number =
          key && (key->type == scene::ValueType::kNumber || key->type == scene::ValueType::kPlanes);
      if (number && std::isfinite(key->range.low))
        keys.push_back({path + "." + std::string(key->name), key});
    }
  }
  return keys;
}

// Each key in two scenes, the small ones first: the rigs of the paper are one machine.
std::map<std::string, std::vector<GivenKey>> cases() {
  std::vector<std::string> names = scenes_of("");
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return !name.starts_with("/paper"); });
  const std::regex index(R"(\[\d+\])");
  std::map<std::string, int> taken;
  std::map<std::string, std::vector<GivenKey>> chosen;
  for (const std::string& name : names) {
    for (const GivenKey& given : bounded_keys(name)) {
      if (taken[std::regex_replace(given.path, index, "")]++ < 2) chosen[name].push_back(given);
    }
  }
  return chosen;
}

std::vector<std::string> scenes_with_cases() {
  std::vector<std::string> names;
  for (const auto& [name, keys] : cases()) names.push_back(name);
  return names;
}

constexpr std::size_t kEvent = 0, kVerlet = 1, kRigid = 4;  // of engines()
constexpr double kSameScheme = 1e-6;   // of the clearance: `rigid` is `verlet`'s step
constexpr double kSamePhysics = 1e-2;  // of the clearance, at a coarse step

// The smallest value itself, or one not far above: 1e-7 in SI, of a time 10 us, half a step, as
// below that MuJoCo's own sum of steps is no longer a time.
std::string smallest(const scene::Key& key) {
  const double above = key.quantity.unit == "s" ? 1e-5 : 1e-7;
  return scene::number_text(key.range.low + (key.range.low_open ? above : 0.0));
}

class LongSmallestValues : public ::testing::TestWithParam<std::string> {};

TEST_P(LongSmallestValues, RunAlikeOrSayWhyNot) {
  const auto all_engines = engines();
  const std::vector<GivenKey> keys = cases()[GetParam()];
  for (const GivenKey& given : keys) {
    const std::string override_ = given.path + "=" + smallest(*given.key);
    const std::vector<std::string> overrides{"run.end=0.112", override_};
    std::optional<scene::Scene> scene;
    try {
      scene = shipped(GetParam(), overrides);
    } catch (const scene::SceneError& error) {
      EXPECT_FALSE(error.diagnostics().front().reason.empty()) << override_;
      continue;
    }
    std::vector<std::optional<Trajectory>> runs;
    for (const NamedEngine& e : all_engines) {
      runs.push_back(run(e, GetParam(), overrides));
      const auto& t = runs.back();
      if (!t) continue;
      const std::string what = override_ + ", " + e.engine->name() + " " + e.override_;
      // A sound run has nothing to say but which keys a soft contact leaves out.
      const bool leaves_out = t->message.find("has no part in") != std::string::npos;
      EXPECT_EQ(t->status == Status::kOk, t->message.empty() || leaves_out)
          << what << ": " << t->message;
      for (const Column& column : t->series) {
        for (const double v : column.values)
          ASSERT_TRUE(std::isfinite(v)) << what << ": " << column.name;
      }
    }
    const auto ended = [&](std::size_t i) { return runs[i] && runs[i]->status == Status::kOk; };
    const double clearance = scene->first().contact->clearance;
    // Difference of two starts that differ by some units in the last place: no method can follow
    // the motion beyond it.
    const auto scatter = [&](std::size_t i) {
      return rotor_error(*runs[i], *run(all_engines[i], GetParam(), overrides, 8));
    };
    if (ended(kVerlet) && ended(kRigid)) {
      const double apart = rotor_error(*runs[kVerlet], *runs[kRigid]);
      EXPECT_TRUE(apart < kSameScheme * clearance || apart < 1e4 * scatter(kVerlet))
          << override_ << ": verlet and rigid are " << apart / clearance << " clearances apart";
    }
    if (ended(kEvent) && ended(kVerlet)) {
      const double apart = rotor_error(*runs[kEvent], *runs[kVerlet]);
      if (apart < kSamePhysics * clearance) continue;
      const auto finer = run(all_engines[kVerlet], GetParam(), overrides, 0, kStep / 16);
      EXPECT_TRUE(rotor_error(*runs[kEvent], *finer) < 0.25 * apart ||
                  scatter(kEvent) > 1e-9 * clearance)
          << override_ << ": event and verlet are " << apart / clearance
          << " clearances apart, at a 16th of the step "
          << rotor_error(*runs[kEvent], *finer) / clearance << ", twins "
          << scatter(kEvent) / clearance;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, LongSmallestValues, ::testing::ValuesIn(scenes_with_cases()),
                         [](const auto& shown) { return shown.param.substr(1); });

}  // namespace
}  // namespace rotorub::test
