// Every shipped machine turned by an odd angle, as an FMU: its outputs must be those of the
// original FMU, turned.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/cli/fmu/importer.h"
#include "tests/cli/program.h"
#include "tests/support/every_third.h"
#include "tests/support/symmetry.h"

namespace rotorub::test {
namespace {

constexpr double kInterval = 0x1p-11;  // s
constexpr int kIntervals = 64;
// The largest difference, relative to the largest value of the output over the run; in SI units for
// outputs that are 0 but for round-off.
constexpr double kSame = 1e-5, kZero = 1e-9;

// The outputs of a plant over time, by name.
using Outputs = std::map<std::string, std::vector<double>>;

// The run is under a load on the rotor, N, that is turned as well.
Outputs outputs_of(const UnpackedFmu& fmu, const Eigen::Vector2d& load) {
  Plant plant(fmu);
  EXPECT_EQ(plant.initialize(0.0, true, kIntervals * kInterval), kFmiOK) << plant.said;
  EXPECT_EQ(plant.set("load_x", load.x()), kFmiOK);
  EXPECT_EQ(plant.set("load_y", load.y()), kFmiOK);
  Outputs all;
  for (int k = 0; k < kIntervals; ++k) {
    EXPECT_EQ(plant.step(k * kInterval, kInterval).status, kFmiOK) << plant.said;
    for (const auto& [name, output] : fmu.outputs) all[name].push_back(plant.get(name));
  }
  return all;
}

// The name of the output along y, of one along x: "rotor_vy" of "rotor_vx", "y_1" of "x_1".
std::optional<std::string> partner(const std::string& name) {
  static const std::regex along_x("(^|.*_)(v?)x(_[0-9]+)?");
  std::smatch parts;
  if (!std::regex_match(name, parts, along_x)) return std::nullopt;
  return parts[1].str() + parts[2].str() + "y" + parts[3].str();
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

void expect_turned(const Outputs& plain, const Outputs& turned, const Transformed& by) {
  std::set<std::string> along_y;
  for (const auto& [name, x] : plain) {
    const auto other = partner(name);
    if (!other) continue;
    along_y.insert(*other);
    const std::vector<double>& y = plain.at(*other);
    const double bound = kSame * std::max(largest(x), largest(y)) + kZero;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Eigen::Vector2d image = by.of({x[k], y[k]});
      ASSERT_NEAR(image.x(), turned.at(name)[k], bound) << name << ", step " << k;
      ASSERT_NEAR(image.y(), turned.at(*other)[k], bound) << *other << ", step " << k;
    }
  }
  EXPECT_TRUE(along_y.contains("rotor_vy") && along_y.contains("y_1"));
  for (const auto& [name, values] : plain) {
    if (partner(name) || along_y.contains(name)) continue;
    const std::vector<double>& image = turned.at(name);
    // The machine is turned with its mark.
    const double turn = name == "spin_angle" ? image[0] - values[0] : 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      ASSERT_NEAR(values[k] + turn, image[k], kSame * largest(values) + kZero)
          << name << ", step " << k;
    }
  }
}

void expect_turned_outputs(const std::string& name) {
  const std::string file = shipped(name);
  const Transformed by(scene::read_scene(file), Symmetry::kAskew);
  if (!by.not_expressible().empty()) return;
  const Folder folder;
  std::vector<std::string> plain{"fmu", file, "--modal", "-q", "-o", "plain.fmu"};
  std::vector<std::string> turned{"fmu", file, "--modal", "-q", "-o", "turned.fmu"};
  for (const std::string& text : by.overrides()) turned.insert(turned.end(), {"--set", text});
  folder.done(plain);
  folder.done(turned);
  const UnpackedFmu one(folder.path() / "plain.fmu", folder.path() / "plain"),
      other(folder.path() / "turned.fmu", folder.path() / "turned");
  const Eigen::Vector2d load(3.0, -1.0);
  expect_turned(outputs_of(one, load), outputs_of(other, by.of(load)), by);
}

class LongTurnedFmu : public testing::TestWithParam<std::string> {};
TEST_P(LongTurnedFmu, GivesTheTurnedOutputs) { expect_turned_outputs(GetParam()); }

class NightlyTurnedFmu : public testing::TestWithParam<std::string> {};
TEST_P(NightlyTurnedFmu, GivesTheTurnedOutputs) { expect_turned_outputs(GetParam()); }

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(ROTORUB_MJCF_DIR)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Shipped, LongTurnedFmu, testing::ValuesIn(every_third(scenes())),
                         [](const auto& scene) { return scene.param; });
INSTANTIATE_TEST_SUITE_P(Shipped, NightlyTurnedFmu, testing::ValuesIn(scenes()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace rotorub::test
