#include "compare/commands/film_options.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <string_view>

#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"
#include "native_model/scene/units.h"

namespace rotorub {
namespace {

using renders::FilmFormat;

// A GIF is for pages that accept no film. It is small and short, because of its palette and its
// clock.
constexpr int kGifWidth = 640, kGifHeight = 360;
constexpr double kGifRate = 25.0, kGifSeconds = 6.0;

std::optional<double> value_of(const std::string& flag, const std::string& text,
                               const scene::Quantity& quantity, const std::string& accepted) {
  return text.empty() ? std::nullopt : std::optional(quantity_of(flag, text, quantity, accepted));
}

std::optional<double> time_of(const std::string& flag, const std::string& text) {
  const char* const accepted = "a time of the run, 0 or more, for example 0.12 or \"120 ms\"";
  const auto time = value_of(flag, text, scene::kTime, accepted);
  if (time && *time < 0.0) refuse(flag, text, accepted);
  return time;
}

// "1280x720"
void read_size(const std::string& text, renders::RenderOptions& options) {
  const char* const accepted = "WIDTHxHEIGHT in pixels, for example 1280x720";
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, options.width);
  if (width.ec != std::errc() || width.ptr == end || *width.ptr != 'x') {
    refuse("--size", text, accepted);
  }
  const auto height = std::from_chars(width.ptr + 1, end, options.height);
  if (height.ec != std::errc() || height.ptr != end) refuse("--size", text, accepted);
}

// From the option, otherwise from the file's extension; mp4 by default.
FilmFormat format_of(const FilmArguments& arguments) {
  if (arguments.gif && arguments.png) {
    throw UsageError(
        "--gif and --png exclude each other; give one of them, or neither for a film (.mp4)");
  }
  const FilmFormat asked = arguments.gif   ? FilmFormat::kGif
                           : arguments.png ? FilmFormat::kPng
                                           : FilmFormat::kMp4;
  if (arguments.file.empty()) return asked;
  const std::string ending = std::filesystem::path(arguments.file).extension().string();
  const bool flagged = arguments.gif || arguments.png;
  for (const FilmFormat format : {FilmFormat::kMp4, FilmFormat::kGif, FilmFormat::kPng}) {
    if (ending == renders::extension(format) && (!flagged || format == asked)) return format;
  }
  refuse("-o", arguments.file,
         flagged ? fmt::format("a name that ends in {}", renders::extension(asked))
                 : "a name that ends in .mp4, .gif or .png");
}

void check_picture(const FilmArguments& arguments, FilmFormat format) {
  if (format != FilmFormat::kPng) {
    if (!arguments.at.empty()) {
      throw UsageError(
          "--at {}: belongs to --png, because only a picture has a single time; use --from and "
          "--to "
          "for a film",
          arguments.at);
    }
    return;
  }
  for (const auto& [flag, text] :
       {std::pair{"--slow", &arguments.slow}, {"--fps", &arguments.fps}}) {
    if (!text->empty())
      throw UsageError("{} {}: belongs to films; leave it out with --png", flag, *text);
  }
}

}  // namespace

void add_film_options(CLI::App& command, FilmArguments& arguments) {
  const auto add = [&](const char* flag, std::string& value, const char* type, const char* help) {
    add_value(command, flag, value, type, help);
  };
  add("-o,--output", arguments.file, "FILE",
      "File that ends in .mp4, .gif or .png (default: <scene>.mp4)");
  add("--from", arguments.from, "TIME",
      "Time at which the film begins (default: shortly before the first touch)");
  add("--to", arguments.to, "TIME", "Time at which it ends (default: the end of the run)");
  add("--slow", arguments.slow, "N",
      "Seconds of film per second of the run, constant over the film (default: a film of 12 s, or "
      "6 s with --gif, that slows down at impacts)");
  add("--size", arguments.size, "WxH", "Size in pixels (default: 1280x720; --gif 640x360)");
  add("--fps", arguments.fps, "N", "Frames per second, 1 to 120 (default: 60; --gif 25)");
  add("--view", arguments.view, "VIEW", "View: rig (default), axis, close-up or unrolled");
  add("--title", arguments.title, "TEXT", "Title over the picture (default: the scene's name)");
  add("--beside", arguments.beside, "RUN_DIR",
      "Folder of a second run of the same scene, shown to the right with the same camera, clock "
      "and scale");
  add("--at", arguments.at, "TIME",
      "Time that --png shows (default: the hardest impact, or the middle of a run without one)");
  add_flag(command, "--gif", arguments.gif, "Make an animated GIF");
  add_flag(command, "--png", arguments.png, "Make one picture");
}

FilmRequest film_request(const FilmArguments& arguments) {
  FilmRequest request;
  request.format = format_of(arguments);
  check_picture(arguments, request.format);

  renders::RenderOptions& options = request.options;
  if (request.format == FilmFormat::kGif) {
    options.width = kGifWidth;
    options.height = kGifHeight;
    options.frames_per_second = kGifRate;
    options.duration = kGifSeconds;
  }
  options.from = time_of("--from", arguments.from);
  options.to = time_of("--to", arguments.to);
  if (options.from && options.to && !(*options.from < *options.to)) {
    refuse("--from", fmt::format("{} --to {}", arguments.from, arguments.to),
           "a --from that is before the --to");
  }
  options.slow_motion =
      value_of("--slow", arguments.slow, scene::kPure, "a number above 0, for example 40");
  if (const auto rate = value_of("--fps", arguments.fps, scene::kPure, "a number from 1 to 120")) {
    options.frames_per_second = *rate;
  }
  if (!arguments.size.empty()) read_size(arguments.size, options);
  if (!arguments.view.empty()) {
    const auto view = renders::view_of(arguments.view);
    if (!view) {
      constexpr std::string_view kViews[] = {"rig", "axis", "close-up", "unrolled"};
      const std::string_view meant = scene::nearest(arguments.view, kViews);
      refuse(
          "--view", scene::printable(arguments.view),
          renders::view_names() + (meant.empty() ? "" : fmt::format("; did you mean {}?", meant)));
    }
    options.view = *view;
  }
  options.title = arguments.title;
  request.at = time_of("--at", arguments.at);
  renders::check_options(options, request.format);
  return request;
}

}  // namespace rotorub
