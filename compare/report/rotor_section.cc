#include "compare/report/rotor_section.h"

#include <fmt/format.h>

#include <cmath>

#include "compare/modes/units.h"
#include "compare/report/modes_page.h"
#include "native_model/scene/diagnostic.h"

namespace rotorub {

using nlohmann::json;

RotorSection rotor_section(const scene::Scene& scene) {
  RotorSection section;
  section.values = {{"has_campbell", false}, {"has_shapes", false}, {"beyond", ""},
                    {"speed", fmt::format("{:.5g} rpm", std::abs(scene.rotor.speed) * kRpm)}, {"refusal", ""}};
  try {
    const Campbell campbell = campbell_of(scene, analyse_free_rotor(scene, {}));
    section.data = modes_plots(scene, campbell.analysis, campbell.range, campbell.branches);
    section.values["has_campbell"] = true;
    section.values["has_shapes"] = campbell.analysis.shapes.has_value();
    section.values["beyond"] = beyond_text(campbell.analysis, campbell.range);
    // Those at rest are on the page of `modes`.
    if (campbell.analysis.shapes) section.data["shapes"].erase("modes");
  } catch (const std::runtime_error& error) {
    // The run has its page, whatever its rotor's eigenvalues are.
    section.values["refusal"] = error.what();
  }
  return section;
}

}  // namespace rotorub
