#include "compare/modes/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "compare/base/json.h"
#include "compare/modes/answers.h"
#include "compare/modes/levitation_text.h"
#include "compare/modes/response_text.h"
#include "compare/modes/rub_result.h"
#include "compare/modes/whirl_tables.h"

namespace rotorub {
namespace {

using result::Data, result::line, result::Part, result::Role, result::Section, result::Sentence;

// The response at a contact, in JSON null without it.
Part response_part(const RotorAnalysis& analysis, std::size_t at, std::size_t bearing) {
  const auto place = std::ranges::find(analysis.contacts, bearing, &ContactPlace::bearing);
  if (place == analysis.contacts.end()) return Data{"response", nullptr};
  return response_section(*place, analysis.responses[at], analysis.spectra[at].speed);
}

// The results at one speed, without its rubs.
Section speed_section(const RotorAnalysis& analysis, std::size_t at) {
  const auto& [speed, modes] = analysis.spectra[at];
  const auto name_of = [speed = speed](const WhirlMode& mode) { return sense_of(mode, speed); };
  const std::string at_speed = "at " + speed_text(speed);
  Section section{
      "speeds/#",
      {Data{"speed", speed}, Data{"rub", nullptr},
       Sentence{.text = "\n" + at_speed, .wraps = false, .seen = result::kTerminal},
       Sentence{.text = "Whirl " + at_speed, .seen = result::kPage, .role = Role::kHeading},
       whirl_table("modes", modes, name_of, true)}};
  if (!analysis.levitations.empty() && has_poles(analysis.levitations[at]))
    section.add(
        {line("  This table leaves out integrators, filters, amplifiers and sampling. The "
              "poles below include them.")});
  const bool several = analysis.rubs.size() > 1;
  section.add(
      {Section{"", {response_part(analysis, at, 0)}, several ? result::kJson : result::kAll}});
  for (std::size_t k = 0; several && k < analysis.rubs.size(); ++k) {
    const RubAnalyses& rubs = analysis.rubs[k];
    section.add({Section{"contacts/#",
                         {Data{"name", rubs.contact}, response_part(analysis, at, k),
                          Data{"rub", nullptr}, Data{"rub_refused", text_or_null(rubs.refused)}}}});
  }
  section.add({Data{"notes", nlohmann::json::array()}, Data{"levitation", nullptr}});
  if (analysis.responses.empty()) return section;
  for (const std::string& note : analysis.responses[at].notes())
    section.add({Sentence{.text = note, .lead = "  note: ", .indent = 2, .place = "notes/#"}});
  if (has_loop(analysis.levitations[at]))
    section.add({levitation_section(speed, analysis.levitations[at])});
  return section;
}

std::vector<Part> torsion_parts(const RotorAnalysis& analysis) {
  std::vector<Part> parts{
      whirl_table("torsion", analysis.torsion, [](const WhirlMode&) { return "torsion"; })};
  if (!analysis.torsion.empty())
    parts.insert(parts.begin(),
                 line(fmt::format("\ntorsion, elastic modes{}",
                                  analysis.motor_is_held ? ", with the motor's end held" : ""),
                      Role::kHeading));
  return parts;
}

std::vector<Part> contact_mass_parts(const std::optional<ContactMass>& mass) {
  const Data data{"contact_mass", contact_mass_json(mass)};
  if (!mass) return {data};
  return {data, line("\neffective mass at the contact", Role::kHeading),
          Sentence{.text = fmt::format(
                       "{:.4g} kg with the {} modes kept, {:.4g} kg with all {} of the mesh{}",
                       mass->kept, mass->kept_modes, mass->mesh, mass->mesh_modes,
                       mass->truncated() ? "; impacts are computed with the modes kept" : ""),
                   .lead = "  "}};
}

}  // namespace

Section modes_result(const std::string& name, const RotorAnalysis& analysis) {
  Section all{.parts = {Sentence{.text = fmt::format("{}: whirl of the free rotor", name),
                                 .wraps = false,
                                 .seen = result::kTerminal}}};
  all.add(summary_parts(analysis));
  for (std::size_t k = 0; k < analysis.spectra.size(); ++k) all.add({speed_section(analysis, k)});
  all.add(torsion_parts(analysis));
  all.add(critical_parts(analysis));
  all.add(stability_parts(analysis));
  all.add(contact_mass_parts(analysis.contact_mass));
  all.add(shapes_parts(analysis.shapes));
  all.add({Section{"", rubs_parts(analysis), result::kAll, "Lasting rubs", "rubs"}});
  return all;
}

}  // namespace rotorub
