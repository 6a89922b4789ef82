// The scene's text in an MJCF's <custom> is another's to write: the plugin takes it, or refuses it
// with what is wrong.

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "plugin/make_config.h"
#include "plugin/model/config.h"
#include "tests/fuzz/said.h"

namespace {

[[noreturn]] void on_error(const char* message) {
  std::fprintf(stderr, "MuJoCo: %s\n", message);
  std::abort();
}

// A rotor with its ring, and that with magnets and a controller.
mjModel* load(const char* name) {
  char error[1000] = "";
  mjModel* model = mj_loadXML((std::string(ROTORUB_MJCF_DIR) + "/" + name).c_str(), nullptr, error,
                              sizeof error);
  if (!model) on_error(error);
  return model;
}

// Kept to the end, which comes by exit().
const std::vector<mjModel*>& models() {
  static const auto* all = new std::vector<mjModel*>{
      load("bench_ring.xml"), load("paper_sliding.xml"), load("touchdown.xml")};
  return *all;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  mju_user_error = on_error;
  models();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The text ends at its first zero, as MuJoCo's do.
  std::string text(reinterpret_cast<const char*>(data), size);
  text.resize(std::min(text.find('\0'), text.size()));
  const mjModel* model = models()[size % models().size()];
  std::vector<int> address(static_cast<std::size_t>(model->ntext), static_cast<int>(text.size()));
  for (int i = 0; i < model->ntext; ++i) {
    const bool scene = std::string(model->names + model->name_textadr[i]) == "rotorub_scene";
    if (scene) address[static_cast<std::size_t>(i)] = 0;
  }
  mjModel other = *model;
  other.text_data = text.data();  // the other texts, of which there may be one, are empty
  other.text_adr = address.data();
  other.ntextdata = static_cast<decltype(other.ntextdata)>(text.size() + 1);
  try {
    rotorub::plugin::make_config(&other);
  } catch (const rotorub::plugin::ConfigError& error) {
    rotorub::test::check_said(error.what());
  }
  return 0;
}
