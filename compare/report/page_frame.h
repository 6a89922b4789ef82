// What every page holds besides its own, so that it needs neither files nor a network.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace rotorub {

struct PageHead {
  std::string names;    // of the scenes
  std::string topic;    // a few words, in the title and above the heading
  std::string heading;  // the question that the page answers
};

// What a page draws, and so which of the two bundles of scripts it holds (page/still.js,
// page/report.js): plots that no clock moves; or also plots and player of a scene's runs.
enum class Pictures { kPlots, kPlotsAndRig };

// Template values of the page's frame: those of its head, "version", "css" and the script elements:
// plotly, `data`, and the page's own. The scripts look in the data for "scenes" (live, plots.h),
// "trade", "rotor" (modes_page.h), "loops" (loop_page.h), "benches" (bench_page.h) and
// "maps" (sweep_page.h), each where the page has a place for it.
nlohmann::json page_frame(const PageHead& head, const nlohmann::json& data,
                          Pictures pictures = Pictures::kPlots);

// The page, with the partials that pages share: head, foot, cards, map, figures.
std::string fill_page(std::string_view html, const nlohmann::json& values);

// A short answer at the page's top (page/cards.html). tone: "", "good", "bad".
nlohmann::json card(std::string_view title, std::string_view tone, std::string_view headline,
                    std::string_view text);

using Partials = std::map<std::string_view, std::string_view>;  // template of each name

// A page from a template and values: Mustache (mustache(5)), by the library of that name,
// and stricter.
//
//   {{name}}             the value, with & < > " ' escaped for HTML
//   {{{name}}}           the value as it is
//   {{#name}}..{{/name}} once for each element of an array, once inside an object, once if true, a
//                        number or a non-empty string; nothing for null, false, "", [] and {}
//   {{^name}}..{{/name}} only where the section above would give nothing
//   {{>name}}            the partial of that name, filled where it stands
//   {{.}}                the current value;  a.b: a member of a member
// Names are looked up from the innermost section outwards. Throws std::logic_error for a name that
// is nowhere in `values`, for a list or an object in the place of text, for an unknown partial and
// for a section that is not closed: a mistake in the template must not become a gap in the page.
std::string fill_template(std::string_view text, const nlohmann::json& values,
                          const Partials& partials = {});

}  // namespace rotorub
