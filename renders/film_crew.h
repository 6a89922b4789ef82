// The frames of a film in their order, painted by several threads. Each has a painter of its own,
// so that the frames do not depend on how many there are.
#pragma once

#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "renders/frame.h"
#include "renders/mujoco_errors.h"

namespace rotorub::renders {

class FilmCrew {
 public:
  // Throws as FramePainter does. Scene, trajectories and options must outlive it.
  FilmCrew(const scene::Scene& scene, const Trajectory& trajectory, const RenderOptions& options);
  ~FilmCrew();
  FilmCrew(const FilmCrew&) = delete;
  FilmCrew& operator=(const FilmCrew&) = delete;

  const Framing& framing() const { return own_.framing(); }
  // The next frame, from the first to the last. Throws what painting it threw.
  Image next();

 private:
  void work(int hand);

  // Painters set this handler and put back the one before, thread by thread: with one around all of
  // them every thread sets and puts back the same.
  MujocoErrors errors_;
  const scene::Scene& scene_;
  const Trajectory& trajectory_;
  const RenderOptions& options_;
  FramePainter own_;  // of the thread that calls next(), hand 0: frames 0, hands_, 2 hands_, ...
  int hands_ = 1;
  int next_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<int, Image> painted_;  // by frame, waiting to be fetched
  std::exception_ptr failure_;
  bool stopped_ = false;
  std::vector<std::jthread> crew_;
};

}  // namespace rotorub::renders
