#include "tests/support/mujoco_fixture.h"

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "native_model/scene/reader.h"
#include "plugin/model/mujoco_versions.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

void on_error(const char* message) { throw std::runtime_error(message); }
// Many tests try named pairs with MuJoCo's default, the pyramid, on purpose.
void on_warning(const char* message) {
  if (!std::strstr(message, "cone=\"elliptic\"")) ADD_FAILURE() << "MuJoCo warns: " << message;
}

}  // namespace

MujocoTest::MujocoTest() : previous_error_(mju_user_error), previous_warning_(mju_user_warning) {
  mju_user_error = on_error;
  mju_user_warning = on_warning;
}

MujocoTest::~MujocoTest() {
  mju_user_error = previous_error_;
  mju_user_warning = previous_warning_;
}

ModelPointer try_load(const std::string& given, std::string& error) {
  const std::string document = for_this_mujoco(given);
  char message[1000] = "";
  ModelPointer model(plugin::load_text(document, message, sizeof message));
  error = message;
  return model;
}

ModelPointer load(const std::string& document) {
  std::string error;
  ModelPointer model = try_load(document, error);
  if (!model || !error.empty()) {
    ADD_FAILURE() << "mj_loadXML: " << error;
    throw std::runtime_error(error);
  }
  return model;
}

std::string load_refusal(const std::string& document) {
  std::string error;
  return try_load(document, error) ? "" : error;
}

void expect_refused(const std::string& document, std::string_view named) {
  EXPECT_TRUE(contains(load_refusal(document), named));
}

DataPointer start(const mjModel* m) {
  DataPointer d(mj_makeData(m));
  const int key = mj_name2id(m, mjOBJ_KEY, "start");
  if (key >= 0) mj_resetDataKeyframe(m, d.get(), key);
  return d;
}

std::vector<double> state_of(const mjModel* m, const mjData* d) {
  std::vector<double> state(d->qpos, d->qpos + m->nq);
  state.insert(state.end(), d->qvel, d->qvel + m->nv);
  return state;
}

std::string state_bits(const mjModel* m, const mjData* d) {
  std::string line;
  const auto add = [&line](double value) {
    char text[20];
    std::snprintf(text, sizeof text, "%016" PRIx64 " ", std::bit_cast<std::uint64_t>(value));
    line += text;
  };
  add(d->time);
  for (const double value : state_of(m, d)) add(value);
  return line;
}

std::vector<double> state_after(const mjModel* m, int steps) {
  const DataPointer d = start(m);
  for (int k = 0; k < steps; ++k) mj_step(m, d.get());
  return state_of(m, d.get());
}

double sensor(const mjModel* m, const mjData* d, const char* name) {
  const int id = mj_name2id(m, mjOBJ_SENSOR, name);
  if (id < 0) throw std::runtime_error(std::string("no sensor ") + name);
  return d->sensordata[m->sensor_adr[id]];
}

scene::Scene parsed(const std::string& text, const std::vector<std::string>& overrides) {
  return scene::parse_scene(text, "test.toml", overrides);
}

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(ROTORUB_MJCF_DIR)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string own_model_example() {
  return scene::file_text(ROTORUB_MJCF_DIR "/examples/own_model.xml");
}

}  // namespace rotorub::test
