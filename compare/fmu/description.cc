#include "compare/fmu/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <string_view>

#include "compare/base/version.h"
#include "compare/fmu/names.h"
#include "mjcf/xml.h"

namespace rotorub::fmi {
namespace {

using Port = StepwiseRun::Port;

// A dimension as a product of base units.
std::string base_unit(const scene::Dimension& dimension) {
  static const char* const kNames[] = {"m", "kg", "s", "A", "rad"};  // as in the dimension
  std::string product;
  for (std::size_t k = 0; k < dimension.size(); ++k) {
    if (dimension[k] != 0) product += fmt::format(R"( {}="{}")", kNames[k], dimension[k]);
  }
  return fmt::format("<BaseUnit{}/>", product);
}

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
  Writer(const scene::Scene& scene, const StepwiseRun& run, Version version, bool modal)
      : scene_(scene),
        run_(run),
        parameters_(parameters_of(scene)),
        three_(version == Version::k3),
        modal_(modal) {}

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
    std::map<std::string, std::string> units;
    for (const auto* ports : {&run_.inputs(), &run_.outputs()}) {
      for (const Port& port : *ports) units[port.unit] = base_unit(port.unit);
    }
    for (const scene::Adjustable& parameter : parameters_) {
      const scene::Quantity& quantity = parameter.key->quantity;
      units[unit_name(quantity)] = base_unit(quantity.dimension);
    }
    units["s"] = base_unit("s");
    units.erase("");
    xml_.open("<UnitDefinitions>");
    for (const auto& [name, base] : units) {
      const std::string unit = fmt::format(R"(<Unit name="{}")", xml_escape(name));
      xml_.line(base.empty() ? unit + "/>" : fmt::format("{}>{}</Unit>", unit, base));
    }
    xml_.close("UnitDefinitions");
  }

  // numbers: the attributes min, max and start, as far as the variable has them.
  void variable(unsigned reference, const Port& port, const char* causality,
                const std::string& numbers) {
    const std::string unit =
        port.unit.empty() ? "" : fmt::format(R"( unit="{}")", xml_escape(port.unit));
    const bool parameter = std::string_view(causality) == "parameter";
    const std::string names = fmt::format(
        R"(name="{}" valueReference="{}" description="{}" causality="{}" variability="{}")",
        xml_escape(port.name), reference, xml_escape(port.meaning), causality,
        parameter    ? "fixed"
        : port.whole ? "discrete"
                     : "continuous");
    const char* type = three_       ? (port.whole ? "Int32" : "Float64")
                       : port.whole ? "Integer"
                                    : "Real";
    if (three_) {
      xml_.line(fmt::format("<{} {}{}{}/>", type, names, unit, numbers));
    } else {
      xml_.line(
          fmt::format("<ScalarVariable {}><{}{}{}/></ScalarVariable>", names, type, unit, numbers));
    }
  }

  void variables() {
    xml_.open("<ModelVariables>");
    unsigned reference = 0;
    variable(reference++, {"time", "s", "simulated time"}, "independent", "");
    for (const Port& port : run_.inputs()) variable(reference++, port, "input", R"( start="0")");
    for (const Port& port : run_.outputs()) {
      if (shown(port)) variable(reference, port, "output", "");
      ++reference;
    }
    for (const scene::Adjustable& number : parameters_) {
      const scene::Key& key = *number.key;
      std::string numbers;
      if (std::isfinite(key.range.low)) numbers += fmt::format(R"( min="{}")", key.range.low);
      if (std::isfinite(key.range.high)) numbers += fmt::format(R"( max="{}")", key.range.high);
      numbers += fmt::format(R"( start="{}")", number.value);
      variable(reference++, {number.name(), unit_name(key.quantity), std::string(key.meaning)},
               "parameter", numbers);
    }
    xml_.close("ModelVariables");
  }

  // FMI 3.0 names the outputs by value reference, and 2.0 by place, counted from 1.
  void structure() {
    xml_.open("<ModelStructure>");
    for (const char* kind :
         {three_ ? "Output" : "Outputs", three_ ? "InitialUnknown" : "InitialUnknowns"}) {
      if (!three_) xml_.open(fmt::format("<{}>", kind));
      std::size_t reference = kFirstInput + run_.inputs().size(), place = reference + 1;
      for (const Port& port : run_.outputs()) {
        if (shown(port))
          xml_.line(three_ ? fmt::format(R"(<{} valueReference="{}"/>)", kind, reference)
                           : fmt::format(R"(<Unknown index="{}"/>)", place++));
        ++reference;
      }
      if (!three_) xml_.close(kind);
    }
    xml_.close("ModelStructure");
  }

  bool shown(const Port& port) const { return modal_ || !port.modal; }
  // A pure number has no unit in FMI.
  static std::string unit_name(const scene::Quantity& quantity) {
    return quantity.unit == scene::kPure.unit ? "" : std::string(quantity.unit);
  }

  const scene::Scene& scene_;
  const StepwiseRun& run_;
  std::vector<scene::Adjustable> parameters_;
  bool three_, modal_;
  XmlWriter xml_;
};

}  // namespace

std::string binary_path(const scene::Scene& scene, Version version) {
  return fmt::format("binaries/{}/{}.so", version == Version::k2 ? "linux64" : ROTORUB_FMU_PLATFORM,
                     model_identifier(scene));
}

std::vector<StepwiseRun::Port> outputs_of(const StepwiseRun& run, bool modal) {
  std::vector<Port> outputs;
  std::copy_if(run.outputs().begin(), run.outputs().end(), std::back_inserter(outputs),
               [modal](const Port& port) { return modal || !port.modal; });
  return outputs;
}

std::string model_description(const scene::Scene& scene, const StepwiseRun& run, Version version,
                              bool modal) {
  return Writer(scene, run, version, modal).text();
}

}  // namespace rotorub::fmi
