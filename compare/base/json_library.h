// Includes nlohmann/json.hpp, whose two classes are compiled once, in json.cc. Every folder gets
// this header through its precompiled header.
#pragma once

#include <nlohmann/json.hpp>

extern template class nlohmann::basic_json<>;
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
