// The flags of a film: --from --to --slow --size --fps --view --title --beside, and what is
// made of it: --gif, --png, --at.
#pragma once

#include <optional>
#include <string>

#include "renders/film.h"

namespace CLI {
class App;
}

namespace rotorub {

// As the user wrote them; empty: not given.
struct FilmArguments {
  std::string from, to, slow, size, fps, view, title, at, beside, file;
  bool gif = false, png = false;
};

void add_film_options(CLI::App& command, FilmArguments& arguments);

struct FilmRequest {
  renders::RenderOptions options;
  renders::FilmFormat format = renders::FilmFormat::kMp4;
  std::optional<double> at;  // s, of a picture
  std::string file;          // empty: named by the scene
  std::string beside;        // folder of a run; empty: none
};
// Throws UsageError naming the flag, what was given and what is accepted. Nothing has run by then:
// what only a run can tell (its end, whether it has a contact) is refused later.
FilmRequest film_request(const FilmArguments& arguments);

}  // namespace rotorub
