// The frame that makes every page independent of other files and of a network.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "compare/result/result.h"

namespace rotorub {

struct PageHead {
  std::string names;    // of the scenes
  std::string topic;    // a few words, in the title and above the heading
  std::string heading;  // the question that the page answers
};

// The kind of pictures in a page, which selects the bundle of scripts (page/still.js or
// page/report.js): plots without a clock, or also plots and player of a scene's runs.
enum class Pictures { kPlots, kPlotsAndRig };

// Template values of the page's frame: its head, "version", "css" and the script elements, that is
// plotly, `data` and the page's own script. The scripts look in the data for "scenes" (live,
// plots.h), "trade", "rotor" (modes_page.h), "loops" (loop_page.h), "benches" (bench_page.h) and
// "maps" (sweep_page.h), if the page has a place for them.
nlohmann::json page_frame(const PageHead& head, const nlohmann::json& data,
                          Pictures pictures = Pictures::kPlots);

// Fills the page, including the shared partials: head, foot.
std::string fill_page(std::string_view html, const nlohmann::json& values);

// A page that the script lays out. parts: of page/layout.js, with those of the result; data: for
// its plots; found: the result, which a browser without scripts shows as text.
std::string laid_out_page(const PageHead& head, const result::Section& found,
                          const nlohmann::json& parts, nlohmann::json data,
                          const std::string& footer);

// A short answer at the top of the page (page/layout.js). tone: "", "good", "bad".
nlohmann::json card(std::string_view title, std::string_view tone, std::string_view headline,
                    std::string_view text);

using Partials = std::map<std::string_view, std::string_view>;  // name and template

// Fills a template with values: Mustache (mustache(5)) by the library of that name, but stricter.
//
//   {{name}}             the value, with & < > " ' escaped for HTML
//   {{{name}}}           the value as it is
//   {{#name}}..{{/name}} once for each element of an array, once inside an object, once if true, a
//                        number or a non-empty string; nothing for null, false, "", [] and {}
//   {{^name}}..{{/name}} only if the section above would give nothing
//   {{>name}}            the partial of that name, filled at its place
//   {{.}}                the current value;  a.b: a member of a member
// Names are looked up from the innermost section outwards. Throws std::logic_error for a name that
// is not in `values`, for a list or an object in the place of text, for an unknown partial and for
// a section that is not closed, so that a mistake in the template cannot become a gap in the page.
std::string fill_template(std::string_view text, const nlohmann::json& values,
                          const Partials& partials = {});

}  // namespace rotorub
