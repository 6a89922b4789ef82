// The positions of the keys in a scene's text, and which keys are faulty. The cross-checks use it
// so that one mistake is not reported twice.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::scene {

class Record {
 public:
  // Records that `path` ("force[0].amplitude", "contact") is at `node`. sound: its value can be
  // used. written: the path with the key's other name, if the file uses that one.
  void note(const std::string& path, const TomlNode& node, bool sound,
            const std::string& written = {});
  // Moves the key at `path` to the file `to` if it is in `from`.
  void move(std::string_view path, const FileName& from, const FileName& to);
  // Records a required key that is missing.
  void note_missing(const std::string& path) { marks_[path] = {{}, 0, false, false}; }

  bool given(std::string_view path) const;
  // The full path of a key of an auxiliary bearing: "stator.mass" of the second [[contact]] is
  // "contact[1].stator.mass". The key is unchanged if the scene has no list of contacts, or if it
  // belongs to another part.
  std::string place(std::string_view key, std::size_t bearing) const;
  // True if the value is sound, or absent and optional.
  bool sound(std::string_view path) const;
  // Number of elements of a given list.
  std::size_t length(std::string_view path) const { return marks_.find(path)->second.length; }
  // A diagnostic at `path`, or at the nearest enclosing part whose position in the file is known.
  Diagnostic diagnostic(const std::string& path, std::string reason) const;

 private:
  struct Mark {
    FileName file;
    int line = 0;
    bool sound = true;
    bool given = true;
    std::size_t length = 0;
    std::string written{};  // empty: same as the path
  };
  std::map<std::string, Mark, std::less<>> marks_;
};

// The path of a magnetic bearing's table: "magnetic_bearing", or "magnetic_bearing[1]" in a list.
std::string magnetic_bearing_path(const Scene& scene, std::size_t bearing);
// For sentences: "magnetic bearing 2 (magnetic_bearing[1])", or "the magnetic bearing" if there is
// no list.
std::string magnetic_bearing_name(const Scene& scene, std::size_t bearing);

// Adds file and line to each diagnostic without a file, from the position of its key. For a scene
// made by hand only the scene's name is known.
std::vector<Diagnostic> placed(const Scene& scene, std::vector<Diagnostic> diagnostics);
// The full path of a key of an auxiliary bearing, as Record::place; the key itself for a scene made
// by hand.
std::string place_of(const Scene& scene, const std::string& key, std::size_t bearing);
// Throws SceneError with one diagnostic.
[[noreturn]] void refuse_at(const Scene& scene, std::string key, std::string reason);
// The same at a key of an auxiliary bearing.
[[noreturn]] void refuse_at(const Scene& scene, std::size_t bearing, const std::string& key,
                            std::string reason);

}  // namespace rotorub::scene
