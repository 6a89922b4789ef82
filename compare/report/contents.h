// A page's contents list (page/contents.html): [{"to": id, "title", "has_parts", "parts": [...]}].
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rotorub {

// Of a scene of the report, from its template values: the sections that report.html gives it.
nlohmann::json scene_contents(const nlohmann::json& scene);
// scenes: of scene_contents; trades: with the section of what control trades; beside:
// Beside::values.
nlohmann::json report_contents(const nlohmann::json& scenes, bool trades,
                               const nlohmann::json& beside);
// Of the page of one run, whose sections' ids begin with `id`.
nlohmann::json run_contents(const std::string& id);

}  // namespace rotorub
