// The films of a comparison.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare/report/page.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

struct SceneFilms {
  std::vector<Film> films;  // as the sides; runs that did not end well have none
  std::string failure;      // of the first film that could not be made; empty: none
};

// <folder>/<scene>/<run>.mp4 for every run of every comparison, each whole or not at all: the
// native run by itself, MuJoCo's beside the native one with one camera, clock and scale. An
// interrupt ends them. progress: share done.
std::vector<SceneFilms> write_films(const std::filesystem::path& folder,
                                    const std::vector<SceneComparison>& comparisons,
                                    const std::atomic<bool>& interrupt,
                                    const std::function<void(double)>& progress);

}  // namespace rotorub
