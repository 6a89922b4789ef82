// Pictures to a film: H.264 film (mp4) or animated GIF by the program `ffmpeg`.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "renders/sheet.h"

namespace rotorub::renders {

inline constexpr double kPatience = 20.0;  // s

struct Encoding {
  bool gif = false;                 // or H.264
  double frames_per_second = 25.0;  // > 0
  double patience = kPatience;      // s that ffmpeg may do nothing at all, until it is ended
};

// A film in the making. The file appears whole when finish() returns, or not at all: frames go to
// a part beside it (trajectory/output.h), which is renamed at the end and removed on every other
// way out. An ffmpeg that does nothing for too long is ended. All errors are std::runtime_error and
// carry what ffmpeg said.
class VideoFile {
 public:
  // Starts ffmpeg. For H.264 width and height must be even (yuv420p).
  VideoFile(const std::filesystem::path& file, int width, int height, const Encoding& encoding);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  // One more frame, of the size given above.
  void add(const Picture& frame);
  // Waits for ffmpeg, checks its exit status and that the film is whole, and puts the file in its
  // place.
  void finish();

 private:
  class Patience;

  VideoFile(double patience, const std::filesystem::path& file, int width, int height);
  void close_pipe();
  int wait();
  void end_encoder();
  [[noreturn]] void fail(const std::string& reason);

  std::filesystem::path file_, part_;
  int width_, height_;
  bool gif_ = false;
  double patience_ = kPatience;
  bool finished_ = false;
  pid_t encoder_ = -1;
  int pipe_ = -1;  // raw frames to ffmpeg
  int log_ = -1;   // what ffmpeg says on standard error, in memory
};

}  // namespace rotorub::renders
