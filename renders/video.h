// Encodes pictures as an H.264 film (mp4) or an animated GIF with the program `ffmpeg`.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "renders/sheet.h"

namespace rotorub::renders {

inline constexpr double kPatience = 20.0;  // s

struct Encoding {
  bool gif = false;                 // else H.264
  double frames_per_second = 25.0;  // > 0
  double patience = kPatience;      // s without any activity after which ffmpeg is killed
};

// A film being written. The file appears complete when finish() returns, or not at all: frames go
// to a temporary file beside it (trajectory/output.h), which is renamed at the end and otherwise
// removed. ffmpeg is killed if it is inactive for too long. All errors are std::runtime_error with
// ffmpeg's message.
class VideoFile {
 public:
  // Starts ffmpeg. For H.264 width and height must be even (yuv420p).
  VideoFile(const std::filesystem::path& file, int width, int height, const Encoding& encoding);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  // Adds a frame, which must have the size given to the constructor.
  void add(const Picture& frame);
  // Waits for ffmpeg, checks its exit status and that the film is complete, and moves the file to
  // its final name.
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
  int log_ = -1;   // standard error of ffmpeg, in memory
};

}  // namespace rotorub::renders
