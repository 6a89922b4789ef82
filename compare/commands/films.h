// The films of a comparison, several at a time.
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

// <folder>/<scene>/<run>.mp4 for every run of every comparison, each whole or not at all. The films
// of a scene have one framing; MuJoCo's show the native run as a ghost. An interrupt ends them.
// progress: share done, called from one thread at a time.
std::vector<SceneFilms> write_films(const std::filesystem::path& folder,
                                    const std::vector<SceneComparison>& comparisons,
                                    const std::atomic<bool>& interrupt,
                                    const std::function<void(double)>& progress);

}  // namespace rotorub
