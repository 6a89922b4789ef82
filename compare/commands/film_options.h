// The options of a film: --from --to --slow --size --fps --view --title --beside, and its format:
// --gif, --png, --at.
#pragma once

#include <optional>
#include <string>

#include "renders/film.h"

namespace CLI {
class App;
}

namespace rotorub {

// As given by the user; empty if not given. The file is then named after the scene.
struct FilmArguments {
  std::string from, to, slow, size, fps, view, title, at, beside, file;
  bool gif = false, png = false;
};

void add_film_options(CLI::App& command, FilmArguments& arguments);

struct FilmRequest {
  renders::RenderOptions options;
  renders::FilmFormat format = renders::FilmFormat::kMp4;
  std::optional<double> at;  // s, for a picture
};
// Throws UsageError that names the option, its value and what is accepted. Errors that depend on
// the run (its end, whether it has a contact) are detected later.
FilmRequest film_request(const FilmArguments& arguments);

}  // namespace rotorub
