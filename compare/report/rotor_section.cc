#include "compare/report/rotor_section.h"

#include <fmt/format.h>

#include <cmath>

#include "compare/base/units.h"
#include "compare/report/modes_page.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub {

using nlohmann::json;

namespace {

constexpr int kWhirlShapes = 4;  // of either sense

}  // namespace

RotorSection rotor_section(const scene::Scene& scene) {
  RotorSection section;
  section.values = {{"has_campbell", false},
                    {"has_shapes", false},
                    {"beyond", ""},
                    {"speed", fmt::format("{:.5g} rpm", std::abs(scene.rotor.speed) * kRpm)},
                    {"refusal", ""}};
  try {
    const Campbell campbell = campbell_of(scene, analyse_free_rotor(scene, {}));
    section.data = modes_plots(scene, campbell.analysis, campbell.range, campbell.branches);
    section.values["has_campbell"] = true;
    section.values["has_shapes"] = campbell.analysis.shapes.has_value();
    section.values["beyond"] = beyond_text(campbell.analysis, campbell.range);
    // Those at rest, and the higher ones, are on the page of `modes`.
    if (campbell.analysis.shapes) {
      json& shapes = section.data["shapes"];
      shapes.erase("modes");
      std::erase_if(shapes["whirl"].get_ref<json::array_t&>(),
                    [](const json& whirl) { return whirl.at("number") > kWhirlShapes; });
    }
  } catch (const std::runtime_error& error) {
    // The run has its page, whatever its rotor's eigenvalues are.
    section.values["refusal"] = error.what();
  }
  return section;
}

}  // namespace rotorub
