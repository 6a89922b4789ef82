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

// What a page draws, and so which scripts it holds: plotly; and three.js with plots and player of a
// scene's runs.
enum class Pictures { kPlots, kPlotsAndRig };

// Template values of the page's frame: those of its head, "version", "css" and "scripts" (those of
// others, `data` in a script element, what pages share, then `script`).
nlohmann::json page_frame(const PageHead& head, std::string_view script, const nlohmann::json& data,
                          Pictures pictures = Pictures::kPlots);

// The page, with the partials that pages share: head, foot, cards, map, figures.
std::string fill_page(std::string_view html, const nlohmann::json& values);

}  // namespace rotorub
