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
// Names are looked up from the innermost section outwards.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace rotorub {

using Partials = std::map<std::string_view, std::string_view>;  // template of each name

// Throws std::logic_error for a name that is nowhere in `values`, for a list or an object in the
// place of text, for an unknown partial and for a section that is not closed: a mistake in the
// template must not become a gap in the page.
std::string fill_template(std::string_view text, const nlohmann::json& values,
                          const Partials& partials = {});

}  // namespace rotorub
