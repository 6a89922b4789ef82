// MuJoCo in tests: a warning fails the test, except the warning of the pyramidal cone, and an error
// is thrown.
#pragma once

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/scene.h"
#include "plugin/hooks.h"
#include "plugin/model/user_data.h"
#include "tests/support/native_run.h"

namespace rotorub::test {

struct MujocoDelete {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using ModelPointer = std::unique_ptr<mjModel, MujocoDelete>;
using DataPointer = std::unique_ptr<mjData, MujocoDelete>;

// Null with MuJoCo's message in `error` if it refuses the document.
ModelPointer try_load(const std::string& document, std::string& error);
// A refusal fails the test and throws.
ModelPointer load(const std::string& document);
// MuJoCo's message if it refuses the document; otherwise empty.
std::string load_refusal(const std::string& document);
void expect_refused(const std::string& document, std::string_view named);

// mjData at the keyframe "start"; without one, as mj_makeData initialises it.
DataPointer start(const mjModel* m);

// The plugin's memory of the first contact in a model whose memory begins at userdata[0].
inline const plugin::ContactEntries& first_contact(const mjData* d) {
  return plugin::entries<plugin::ModelEntries>(d, 0).contact;
}

// qpos followed by qvel.
std::vector<double> state_of(const mjModel* m, const mjData* d);
std::vector<double> state_after(const mjModel* m, int steps);
// Time and state as bits, in the format of support/step_log.
std::string state_bits(const mjModel* m, const mjData* d);

double sensor(const mjModel* m, const mjData* d, const char* name);

// Reads a scene that is written in the test; for shipped scenes see native_run.h.
scene::Scene parsed(const std::string& text, const std::vector<std::string>& overrides = {});
std::vector<std::string> shipped_names();  // of every mjcf/*.toml, without the extension
std::string own_model_example();           // the text of mjcf/examples/own_model.xml

class MujocoTest : public ::testing::Test {
 protected:
  MujocoTest();
  ~MujocoTest() override;

 private:
  void (*previous_error_)(const char*);
  void (*previous_warning_)(const char*);
};

// A MujocoTest with the plugin's callbacks.
class HookedTest : public MujocoTest {
  plugin::Hooks hooks_;
};

}  // namespace rotorub::test
