#include "renders/film.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

#include "renders/video.h"

namespace rotorub::renders {

namespace {

void check_extension(const std::filesystem::path& file, const char* extension) {
  if (file.extension() == extension) return;
  throw std::invalid_argument(
      fmt::format("render: {}: a file name ending in {} is accepted", file.string(), extension));
}

}  // namespace

RenderResult render(const scene::Scene& scene, const Trajectory& trajectory,
                    const RenderOptions& options, const std::filesystem::path& file) {
  const auto start = std::chrono::steady_clock::now();
  check_extension(file, ".mp4");
  FramePainter painter(scene, trajectory, options);
  const Framing& framing = painter.framing();
  VideoFile video(file, options.width, options.height,
                  {options.frames_per_second, options.quality});
  for (int frame = 0; frame < framing.frames; ++frame) {
    video.add(painter.paint(framing.time(frame)));
    if (options.progress) options.progress(static_cast<double>(frame + 1) / framing.frames);
  }
  video.finish();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {framing, framing.frames / options.frames_per_second, wall.count()};
}

void render_still(const scene::Scene& scene, const Trajectory& trajectory, double t,
                  const RenderOptions& options, const std::filesystem::path& file) {
  check_extension(file, ".png");
  FramePainter painter(scene, trajectory, options);
  write_picture(painter.paint(t), file);
}

}  // namespace rotorub::renders
