#include "renders/film_crew.h"

#include <algorithm>

namespace rotorub::renders {

namespace {

constexpr int kMostHands = 4;
constexpr int kAhead = 3;  // rounds that a hand may be ahead of what was fetched

int hands_of(const RenderOptions& options) {
  if (options.threads > 0) return options.threads;
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, kMostHands);
}

}  // namespace

FilmCrew::FilmCrew(const scene::Scene& scene, const Trajectory& trajectory,
                   const RenderOptions& options)
    : scene_(scene),
      trajectory_(trajectory),
      options_(options),
      own_(scene, trajectory, options),
      hands_(std::min(hands_of(options), own_.framing().frames)) {
  for (int hand = 1; hand < hands_; ++hand) crew_.emplace_back([this, hand] { work(hand); });
}

FilmCrew::~FilmCrew() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

void FilmCrew::work(int hand) {
  try {
    // MuJoCo's reader of XML serves one thread at a time.
    std::unique_lock lock(mutex_);
    FramePainter painter(scene_, trajectory_, options_);
    const Framing& framing = painter.framing();
    for (int frame = hand; frame < framing.frames; frame += hands_) {
      changed_.wait(lock, [&] { return stopped_ || frame < next_ + kAhead * hands_; });
      if (stopped_) return;
      lock.unlock();
      Image picture = painter.paint(framing.time(frame));
      lock.lock();
      painted_.emplace(frame, std::move(picture));
      changed_.notify_all();
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    changed_.notify_all();
  }
}

Image FilmCrew::next() {
  const int frame = next_;
  if (frame % hands_ == 0) {
    Image picture = own_.paint(own_.framing().time(frame));
    const std::lock_guard lock(mutex_);
    ++next_;
    changed_.notify_all();
    return picture;
  }
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ != nullptr || painted_.count(frame) > 0; });
  if (painted_.count(frame) == 0) std::rethrow_exception(failure_);
  Image picture = std::move(painted_.extract(frame).mapped());
  ++next_;
  changed_.notify_all();
  return picture;
}

}  // namespace rotorub::renders
