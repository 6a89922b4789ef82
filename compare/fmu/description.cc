#include "compare/fmu/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "compare/base/version.h"
#include "compare/fmu/names.h"
#include "mjcf/xml.h"

namespace rotorub::fmi {
namespace {

using Port = StepwiseRun::Port;

// The unit as a product of base units; empty for a unit of a user's law, which is only a name.
std::string base_unit(const std::string& unit) {
  static const std::pair<const char*, const char*> kUnits[] = {{"m", R"(m="1")"},
                                                               {"m/s", R"(m="1" s="-1")"},
                                                               {"rad", R"(rad="1")"},
                                                               {"rad/s", R"(rad="1" s="-1")"},
                                                               {"N", R"(kg="1" m="1" s="-2")"},
                                                               {"N s", R"(kg="1" m="1" s="-1")"},
                                                               {"N m", R"(kg="1" m="2" s="-2")"},
                                                               {"A", R"(A="1")"},
                                                               {"s", R"(s="1")"}};
  for (const auto& [name, product] : kUnits) {
    if (unit == name) return fmt::format("<BaseUnit {}/>", product);
  }
  return "";
}

// The scene's name as a C identifier, for the name of the binary.
std::string model_identifier(const scene::Scene& scene) {
  std::string name = scene.name;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  const bool digit = !name.empty() && std::isdigit(static_cast<unsigned char>(name.front()));
  return name.empty() || digit ? "scene_" + name : name;
}

class Writer {
 public:
  Writer(const scene::Scene& scene, const StepwiseRun& run, Version version)
      : scene_(scene), run_(run), three_(version == Version::k3) {}

  std::string text() {
    head();
    units();
    xml_.open("<LogCategories>");
    xml_.line(R"(<Category name="logStatusError" description="why a call has failed"/>)");
    xml_.close("LogCategories");
    xml_.line(fmt::format(R"(<DefaultExperiment startTime="0" stopTime="{}" stepSize="{}"/>)",
                          scene_.run.end, scene_.run.series_step()));
    variables();
    structure();
    xml_.close("fmiModelDescription");
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + xml_.take();
  }

 private:
  void head() {
    xml_.open(fmt::format(R"(<fmiModelDescription fmiVersion="{}" modelName="{}" {}="{}" )"
                          R"(description="a rotor and its auxiliary bearings, with rigid contact" )"
                          R"(generationTool="rotorub {}" variableNamingConvention="flat"{}>)",
                          three_ ? "3.0" : "2.0", xml_escape(scene_.name),
                          three_ ? "instantiationToken" : "guid", token_of(scene_),
                          program_version(), three_ ? "" : R"( numberOfEventIndicators="0")"));
    xml_.line(fmt::format(
        R"(<CoSimulation modelIdentifier="{}" canHandleVariableCommunicationStepSize="true" {}/>)",
        model_identifier(scene_),
        three_ ? R"(canGetAndSetFMUState="true" hasEventMode="true" )"
                 R"(mightReturnEarlyFromDoStep="true")"
               : R"(canGetAndSetFMUstate="true")"));
  }

  void units() {
    std::set<std::string> names{"s"};
    for (const auto* ports : {&run_.inputs(), &run_.outputs()}) {
      for (const Port& port : *ports) names.insert(port.unit);
    }
    names.erase("");
    xml_.open("<UnitDefinitions>");
    for (const std::string& name : names) {
      const std::string base = base_unit(name);
      const std::string unit = fmt::format(R"(<Unit name="{}")", xml_escape(name));
      xml_.line(base.empty() ? unit + "/>" : fmt::format("{}>{}</Unit>", unit, base));
    }
    xml_.close("UnitDefinitions");
  }

  // start: for inputs; otherwise empty.
  void variable(unsigned reference, const Port& port, const char* causality, const char* start) {
    const std::string unit =
        port.unit.empty() ? "" : fmt::format(R"( unit="{}")", xml_escape(port.unit));
    const std::string names = fmt::format(
        R"(name="{}" valueReference="{}" description="{}" causality="{}" variability="{}")",
        xml_escape(port.name), reference, xml_escape(port.meaning), causality,
        port.whole ? "discrete" : "continuous");
    const char* type = three_       ? (port.whole ? "Int32" : "Float64")
                       : port.whole ? "Integer"
                                    : "Real";
    if (three_) {
      xml_.line(fmt::format("<{} {}{}{}/>", type, names, unit, start));
    } else {
      xml_.line(
          fmt::format("<ScalarVariable {}><{}{}{}/></ScalarVariable>", names, type, unit, start));
    }
  }

  void variables() {
    xml_.open("<ModelVariables>");
    unsigned reference = 0;
    variable(reference++, {"time", "s", "simulated time"}, "independent", "");
    for (const Port& port : run_.inputs()) variable(reference++, port, "input", R"( start="0")");
    for (const Port& port : run_.outputs()) variable(reference++, port, "output", "");
    xml_.close("ModelVariables");
  }

  // FMI 2.0 counts the variables from 1.
  void structure() {
    xml_.open("<ModelStructure>");
    for (const char* kind :
         {three_ ? "Output" : "Outputs", three_ ? "InitialUnknown" : "InitialUnknowns"}) {
      if (!three_) xml_.open(fmt::format("<{}>", kind));
      for (std::size_t i = 0; i < run_.outputs().size(); ++i) {
        const std::size_t at = kFirstInput + run_.inputs().size() + i;
        xml_.line(three_ ? fmt::format(R"(<{} valueReference="{}"/>)", kind, at)
                         : fmt::format(R"(<Unknown index="{}"/>)", at + 1));
      }
      if (!three_) xml_.close(kind);
    }
    xml_.close("ModelStructure");
  }

  const scene::Scene& scene_;
  const StepwiseRun& run_;
  bool three_;
  XmlWriter xml_;
};

}  // namespace

std::string binary_path(const scene::Scene& scene, Version version) {
  return fmt::format("binaries/{}/{}.so", version == Version::k2 ? "linux64" : ROTORUB_FMU_PLATFORM,
                     model_identifier(scene));
}

std::string model_description(const scene::Scene& scene, const StepwiseRun& run, Version version) {
  return Writer(scene, run, version).text();
}

}  // namespace rotorub::fmi
