#include "renders/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <future>
#include <initializer_list>
#include <mutex>
#include <semaphore>
#include <stdexcept>
#include <thread>
#include <vector>

#include "native_model/scene/text.h"
#include "renders/frame.h"
#include "renders/stage.h"
#include "renders/video.h"

namespace rotorub::renders {

namespace {

constexpr int kMostThreads = 4;
constexpr int kAhead = 3;  // frames that a thread may be ahead of the fetched ones

// Paints the frames of a film in order, with several threads. Each thread has its own painter, so
// that the frames do not depend on the number of threads.
class ParallelPainter {
 public:
  // Throws as FramePainter does. Scene, trajectories and options must outlive the painter.
  ParallelPainter(const scene::Scene& scene, const Trajectory& trajectory,
                  const RenderOptions& options)
      : painter_(scene, trajectory, options),
        workers_(std::min(thread_count(options), painter_.framing().frames)),
        painted_(static_cast<std::size_t>(painter_.framing().frames)) {
    for (int worker = 0; worker < workers_; ++worker) free_slots_.emplace_back(kAhead);
    for (int worker = 1; worker < workers_; ++worker) {
      threads_.emplace_back([&, this, worker] { work(worker, scene, trajectory, options); });
    }
  }
  ~ParallelPainter() {
    stopped_ = true;
    for (auto& slots : free_slots_) slots.release();
  }
  ParallelPainter(const ParallelPainter&) = delete;
  ParallelPainter& operator=(const ParallelPainter&) = delete;

  const Framing& framing() const { return painter_.framing(); }
  // The next frame, from the first to the last. Rethrows the exception of its painter.
  Picture next() {
    const int frame = next_++, worker = frame % workers_;
    if (worker == 0) return painter_.paint(framing().time(frame));
    Picture picture = painted_[static_cast<std::size_t>(frame)].get_future().get();
    free_slots_[static_cast<std::size_t>(worker)].release();
    return picture;
  }

 private:
  static int thread_count(const RenderOptions& options) {
    if (options.threads > 0) return options.threads;
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostThreads);
  }

  void work(int worker, const scene::Scene& scene, const Trajectory& trajectory,
            const RenderOptions& options) {
    int frame = worker;
    try {
      // MuJoCo's XML reader is not thread-safe.
      std::unique_lock reading(reader_);
      FramePainter painter(scene, trajectory, options);
      reading.unlock();
      for (; frame < painter.framing().frames; frame += workers_) {
        free_slots_[static_cast<std::size_t>(worker)].acquire();
        if (stopped_) return;
        painted_[static_cast<std::size_t>(frame)].set_value(
            painter.paint(painter.framing().time(frame)));
      }
    } catch (...) {
      painted_[static_cast<std::size_t>(frame)].set_exception(std::current_exception());
    }
  }

  // Painters in several threads set this handler and restore the previous one. With this one around
  // all of them, every thread sets and restores the same handler.
  MujocoErrors errors_;
  // Used by the thread that calls next(), worker 0: frames 0, workers_, 2 workers_, ...
  FramePainter painter_;
  int workers_ = 1;
  int next_ = 0;
  std::vector<std::promise<Picture>> painted_;  // one per frame
  // One per worker: slots for painted frames that have not been fetched.
  std::deque<std::counting_semaphore<>> free_slots_;
  std::mutex reader_;
  std::atomic<bool> stopped_ = false;
  std::vector<std::jthread> threads_;
};

// GIF times are multiples of 1/100 s, and browsers respect only 2/100 s or more.
constexpr double kMostGifRate = 50.0;
constexpr double kMostGifBytes = 1e9;  // all frames, which ffmpeg keeps for the palette

FilmFormat format_of(const std::filesystem::path& file,
                     std::initializer_list<FilmFormat> accepted) {
  std::string names;
  for (const FilmFormat format : accepted) {
    if (file.extension() == extension(format)) return format;
    names += (names.empty() ? "" : " or ") + std::string(extension(format));
  }
  throw std::invalid_argument(
      fmt::format("{}: expected the name of a file that ends in {}", file.string(), names));
}

void check_gif_length(const RenderOptions& options, int frames) {
  const double bytes = 4.0 * options.width * options.height * frames;
  if (bytes <= kMostGifBytes) return;
  throw std::invalid_argument(fmt::format(
      "a GIF of {} frames of {} x {} pixels is too long, because at most {:.0f} such frames "
      "are accepted; show less of the run, make the picture smaller, or make an .mp4",
      frames, options.width, options.height, kMostGifBytes * frames / bytes));
}

}  // namespace

const char* extension(FilmFormat format) {
  if (format == FilmFormat::kMp4) return ".mp4";
  return format == FilmFormat::kGif ? ".gif" : ".png";
}

void check_options(const RenderOptions& options, FilmFormat format) {
  check_options(options);
  const bool odd = options.width % 2 != 0 || options.height % 2 != 0;
  if (format == FilmFormat::kMp4 && odd) {
    throw std::invalid_argument(fmt::format(
        "size = {}x{}: expected an even width and height, because the colours of an .mp4 "
        "have half the resolution; .gif and .png accept any size",
        options.width, options.height));
  }
  if (format == FilmFormat::kGif && options.frames_per_second > kMostGifRate) {
    throw std::invalid_argument(fmt::format("frames per second = {}: expected 1 to {} for a .gif",
                                            options.frames_per_second, kMostGifRate));
  }
}

RenderResult render(const scene::Scene& scene, const Trajectory& trajectory,
                    const RenderOptions& options, const std::filesystem::path& file) {
  const auto start = std::chrono::steady_clock::now();
  const FilmFormat format = format_of(file, {FilmFormat::kMp4, FilmFormat::kGif});
  check_options(options, format);
  ParallelPainter painter(scene, trajectory, options);
  const Framing framing = painter.framing();
  const bool gif = format == FilmFormat::kGif;
  if (gif) check_gif_length(options, framing.frames);
  VideoFile video(file, options.width, options.height, {gif, options.frames_per_second});
  for (int frame = 0; frame < framing.frames; ++frame) {
    video.add(painter.next());
    if (options.progress) options.progress(static_cast<double>(frame + 1) / framing.frames);
  }
  video.finish();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  return {framing, framing.frames / options.frames_per_second, wall.count()};
}

PictureResult render_still(const scene::Scene& scene, const Trajectory& trajectory,
                           std::optional<double> t, const RenderOptions& asked,
                           const std::filesystem::path& file) {
  check_options(asked, format_of(file, {FilmFormat::kPng}));
  RenderOptions options = asked;
  // A time before the part that is shown by default is accepted too.
  const Playback playback(trajectory);
  if (t && !options.from && *t >= playback.start()) {
    options.from = std::min(*t, make_framing(playback, options).from);
  }
  FramePainter painter(scene, trajectory, options);
  painter.alone();
  const Framing& framing = painter.framing();
  if (t && !(*t >= framing.from && *t <= framing.to)) {
    const double first = asked.from ? framing.from : playback.start();
    throw std::invalid_argument(fmt::format(
        "there is no picture at {} s; expected a time from {} s to {} s", scene::number_text(*t),
        scene::number_text(first), scene::number_text(framing.to)));
  }
  const double shown = t.value_or(hardest_impact(playback, framing));
  painter.paint(shown).write(file);
  return {framing, shown};
}

}  // namespace rotorub::renders
