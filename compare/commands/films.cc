#include "compare/commands/films.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>

#include "renders/frame.h"
#include "renders/mujoco_errors.h"
#include "renders/video.h"

namespace rotorub {
namespace {

// Small enough to be carried in the report.
renders::RenderOptions film_options() {
  renders::RenderOptions options;
  options.width = 800;
  options.height = 450;
  options.duration = 8.0;
  options.quality = 27;
  return options;
}

// One film to be made.
struct Job {
  const SceneComparison* comparison = nullptr;
  std::size_t side = 0;
  std::filesystem::path file;
  std::optional<Film> film;
  std::string failure;
};

std::vector<Job> jobs_of(const std::filesystem::path& folder,
                         const std::vector<SceneComparison>& comparisons) {
  std::vector<Job> jobs;
  for (const SceneComparison& c : comparisons) {
    for (std::size_t k = 0; k < c.sides.size(); ++k) {
      if (c.sides[k].trajectory.status != Status::kOk) continue;
      jobs.push_back({&c, k, folder / c.scene.name / (c.sides[k].label + ".mp4"), {}, {}});
    }
  }
  return jobs;
}

class FilmCrew {
 public:
  FilmCrew(std::vector<Job>& jobs, const std::atomic<bool>& interrupt,
           const std::function<void(double)>& progress)
      : jobs_(jobs), interrupt_(interrupt), progress_(progress) {}

  void work() {
    // Painters set this handler and put back the one before, picture by picture and thread by
    // thread: with one around all of them every thread sets and puts back the same.
    const renders::MujocoErrors errors;
    const std::size_t hands =
        std::min<std::size_t>(std::max(1U, std::thread::hardware_concurrency()), jobs_.size());
    std::vector<std::jthread> crew;
    for (std::size_t k = 1; k < hands; ++k) crew.emplace_back([this] { take_jobs(); });
    take_jobs();
  }

 private:
  void take_jobs() {
    for (std::size_t k = next_++; k < jobs_.size() && !interrupt_; k = next_++) {
      try {
        make(jobs_[k]);
      } catch (const std::exception& error) {
        jobs_[k].failure = error.what();
      }
    }
  }

  // MuJoCo's reader of XML serves one thread at a time.
  std::unique_ptr<renders::FramePainter> painter(const SceneComparison& c, std::size_t side,
                                                 const renders::RenderOptions& options) {
    const std::lock_guard lock(loading_);
    return std::make_unique<renders::FramePainter>(c.scene, c.sides[side].trajectory, options);
  }

  void make(Job& job) {
    const SceneComparison& c = *job.comparison;
    renders::RenderOptions options = film_options();
    if (job.side > 0) {
      const renders::Framing native = painter(c, 0, options)->framing();
      options.from = native.from;
      options.to = native.to;
      options.slow_motion = native.slow_motion;
      options.magnification = native.magnification;
      options.shadow = &c.sides[0].trajectory;
    }
    const auto paints = painter(c, job.side, options);
    const renders::Framing& framing = paints->framing();
    renders::VideoFile video(job.file, options.width, options.height,
                             {options.frames_per_second, options.quality});
    for (int frame = 0; frame < framing.frames; ++frame) {
      if (interrupt_) return;
      video.add(paints->paint(framing.time(frame)));
      report(1.0 / framing.frames);
    }
    video.finish();
    job.film = Film{job.file, caption(c.sides[job.side].label, job.side > 0, framing)};
  }

  static std::string caption(const std::string& label, bool ghost,
                             const renders::Framing& framing) {
    return fmt::format("{}{}; slowed down {:.3g} times, displacements magnified {:.3g} times",
                       label, ghost ? ", the native run as a ghost" : "", framing.slow_motion,
                       framing.magnification);
  }

  void report(double share_of_job) {
    const std::lock_guard lock(reporting_);
    done_ += share_of_job / static_cast<double>(jobs_.size());
    if (progress_) progress_(done_);
  }

  std::vector<Job>& jobs_;
  const std::atomic<bool>& interrupt_;
  const std::function<void(double)>& progress_;
  std::atomic<std::size_t> next_{0};
  std::mutex loading_, reporting_;
  double done_ = 0.0;
};

}  // namespace

std::vector<SceneFilms> write_films(const std::filesystem::path& folder,
                                    const std::vector<SceneComparison>& comparisons,
                                    const std::atomic<bool>& interrupt,
                                    const std::function<void(double)>& progress) {
  std::vector<Job> jobs = jobs_of(folder, comparisons);
  FilmCrew(jobs, interrupt, progress).work();
  std::vector<SceneFilms> all(comparisons.size());
  for (Job& job : jobs) {
    SceneFilms& scene = all[static_cast<std::size_t>(job.comparison - comparisons.data())];
    if (job.film) scene.films.push_back(std::move(*job.film));
    if (scene.failure.empty()) scene.failure = job.failure;
  }
  return all;
}

}  // namespace rotorub
