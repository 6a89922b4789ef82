// What every page holds besides its own, so that it needs neither files nor a network.
#pragma once

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

// Template values of the page's frame: those of its head, "version", "css" and "scripts": plotly,
// `data` in a script element, and the page's own. The scripts look in the data for "scenes" (live,
// plots.h), "trade", "rotor" (modes_page.h), "benches" (precision_plots.h) and "maps"
// (sweep_page.h), each where the page has a place for it.
nlohmann::json page_frame(const PageHead& head, const nlohmann::json& data,
                          Pictures pictures = Pictures::kPlots);

// The page, with the partials that pages share: head, foot, cards, map, figures.
std::string fill_page(std::string_view html, const nlohmann::json& values);

}  // namespace rotorub
