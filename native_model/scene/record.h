// What the reading of a scene noticed beside the values: which keys stand where, and which of them
// are faulty. The cross-checks ask it, so that one slip is not reported twice.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::scene {

class Record {
 public:
  // `path` stands at `node` ("force[0].amplitude", "contact"); sound: its value can be used.
  // written: the path with the key's other name, if that is the one in the file.
  void note(const std::string& path, const TomlNode& node, bool sound,
            const std::string& written = {});
  // A required key that is not there.
  void note_missing(const std::string& path) { marks_[path] = {{}, 0, false, false}; }

  bool given(std::string_view path) const;
  // Where a key of an auxiliary bearing stands: "stator.mass" of the second [[contact]] is
  // "contact[1].stator.mass"; as it is where the scene has no list of them, and for other keys.
  std::string place(std::string_view key, std::size_t bearing) const;
  // Every path is given and sound, or optional and absent.
  bool sound(std::initializer_list<std::string> paths) const;
  // A diagnostic at `path`, or at the nearest part above it that has a place in the file.
  Diagnostic diagnostic(const std::string& path, std::string reason) const;

 private:
  struct Mark {
    FileName file;
    int line = 0;
    bool sound = true;
    bool given = true;
    std::string written{};  // empty: as the path
  };
  std::map<std::string, Mark, std::less<>> marks_;
};

// Where the keys of a magnetic bearing stand: "magnetic_bearing", or in a list
// "magnetic_bearing[1]".
std::string magnetic_bearing_path(const Record* record, std::size_t bearing);

// What was found wrong after the reading: each diagnostic without a file is given the place of its
// key. Of a scene that was made by hand the name alone is known.
std::vector<Diagnostic> placed(const Scene& scene, std::vector<Diagnostic> diagnostics);
// Throws SceneError with the one diagnostic.
[[noreturn]] void refuse_at(const Scene& scene, std::string key, std::string reason);

}  // namespace rotorub::scene
