#include "compare/sweep/folder.h"

#include "native_model/scene/reader.h"
#include "native_model/trajectory/output.h"

namespace rotorub::sweep {
namespace {

bool is_other(const std::filesystem::path& file, const std::string& text) {
  return std::filesystem::exists(file) && scene::file_text(file) != text;
}

}  // namespace

StudyIdentity identity_of(const PointScenes& scenes) {
  const std::string all = scenes.study().text + '\0' + scenes.scene_text();
  return {scene::text_hash(all), scenes.sample().size()};
}

void keep_study(const std::filesystem::path& folder, const PointScenes& scenes) {
  std::filesystem::create_directories(folder);
  const std::pair<const char*, const std::string&> files[] = {{kStudyFile, scenes.study().text},
                                                              {kSceneFile, scenes.scene_text()}};
  for (const auto& [name, text] : files) {
    if (is_other(folder / name, text) && !result_files(folder).empty()) {
      throw StoreMismatch((folder / name).string() +
                          ": the folder holds results of another study (the study, its scene or "
                          "--set has changed); give another folder with -o");
    }
  }
  for (const auto& [name, text] : files) write_whole(folder / name, text);
}

}  // namespace rotorub::sweep
