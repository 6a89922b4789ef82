// nlohmann/json.hpp, whose two classes are compiled once, in json.cc: every room has this header
// with the precompiled one.
#pragma once

#include <nlohmann/json.hpp>

extern template class nlohmann::basic_json<>;
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
