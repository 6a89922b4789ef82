#include "renders/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

extern char** environ;

namespace rotorub::renders {

namespace {

constexpr const char* kEncoder = "ffmpeg";

std::filesystem::path part_of(const std::filesystem::path& file) {
  std::filesystem::path part = file;
  part.replace_filename(file.stem().string() + ".part" + file.extension().string());
  return part;
}

// ffmpeg's arguments: raw frames on standard input, nothing but errors on standard error.
std::vector<std::string> input_arguments(int width, int height, double frames_per_second) {
  return {kEncoder,
          "-nostdin",
          "-hide_banner",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pixel_format",
          "rgb24",
          "-video_size",
          fmt::format("{}x{}", width, height),
          "-framerate",
          fmt::format("{}", frames_per_second),
          "-i",
          "pipe:0"};
}

// H.264 that every browser plays, index first so that it plays from a data URL; a fixed number of
// threads and no version stamps, so that equal frames give equal bytes.
std::vector<std::string> film_arguments(const Encoding& encoding) {
  return {"-vf",
          "scale=out_color_matrix=bt709:out_range=tv",
          "-c:v",
          "libx264",
          "-preset",
          "veryfast",
          "-tune",
          "animation",
          "-crf",
          std::to_string(encoding.quality),
          "-pix_fmt",
          "yuv420p",
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "bt709",
          "-threads",
          "2",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-movflags",
          "+faststart",
          "-f",
          "mp4"};
}

// One palette for all frames: ffmpeg keeps them until the last one has come.
std::vector<std::string> gif_arguments() {
  return {"-filter_complex",
          "split[frames][counted];[counted]palettegen=stats_mode=full[palette];"
          "[frames][palette]paletteuse=dither=none:diff_mode=rectangle",
          "-loop",
          "0",
          "-fflags",
          "+bitexact",
          "-f",
          "gif"};
}

// Starts ffmpeg with `in` as standard input and `log` as standard error, in a process group of its
// own: an interrupt from the keyboard is the caller's to handle. Returns the error number.
int spawn(std::vector<std::string> arguments, int in, int log, pid_t& child) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, log, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  const int error = posix_spawnp(&child, kEncoder, &files, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

std::string read_log(int log) {
  std::string text;
  char buffer[4096];
  off_t offset = 0;
  while (true) {
    const ssize_t count = pread(log, buffer, sizeof buffer, offset);
    if (count <= 0) break;
    text.append(buffer, static_cast<std::size_t>(count));
    offset += count;
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

// A running ffmpeg: its process, the end to write frames to, what it says.
struct Process {
  pid_t child = -1;
  int pipe = -1;
  int log = -1;
};

Process start(std::vector<std::string> arguments, const std::filesystem::path& file) {
  Process process;
  int ends[2] = {-1, -1};
  // A socket rather than a pipe: a reader that has gone is an error of send(), not a signal.
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), std::strerror(errno)));
  }
  process.log = memfd_create("encoder-log", MFD_CLOEXEC);
  const int error =
      process.log < 0 ? errno : spawn(std::move(arguments), ends[0], process.log, process.child);
  close(ends[0]);
  process.pipe = ends[1];
  if (error == 0) return process;
  close(process.pipe);
  if (process.log >= 0) close(process.log);
  throw std::runtime_error(fmt::format(
      "{}: cannot start the program `{}`: {} (it makes the video: install the Debian package "
      "ffmpeg, or see that it is on PATH)",
      file.string(), kEncoder, std::strerror(error)));
}

}  // namespace

VideoFile::VideoFile(const std::filesystem::path& file, int width, int height,
                     double frames_per_second, std::vector<std::string> output)
    : file_(file), part_(part_of(file)), width_(width), height_(height) {
  auto arguments = input_arguments(width, height, frames_per_second);
  for (std::string& argument : output) arguments.push_back(std::move(argument));
  // `file:` keeps ffmpeg from reading a protocol into the name.
  arguments.push_back("file:" + part_.string());
  const Process process = start(std::move(arguments), file);
  encoder_ = process.child;
  pipe_ = process.pipe;
  log_ = process.log;
}

VideoFile::VideoFile(const std::filesystem::path& file, int width, int height,
                     const Encoding& encoding)
    : VideoFile(file, width, height, encoding.frames_per_second,
                encoding.gif ? gif_arguments() : film_arguments(encoding)) {
  assert(width > 0 && height > 0 && (encoding.gif || (width % 2 == 0 && height % 2 == 0)));
}

VideoFile::~VideoFile() {
  close_pipe();
  if (encoder_ > 0) {
    kill(encoder_, SIGKILL);
    wait();
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
  }
  if (log_ >= 0) close(log_);
}

void VideoFile::add(const Image& frame) {
  assert(frame.width == width_ && frame.height == height_);
  const std::uint8_t* data = frame.rgb.data();
  std::size_t left = frame.rgb.size();
  while (left > 0) {
    const ssize_t sent = send(pipe_, data, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) fail(fmt::format("ffmpeg takes no more frames ({})", std::strerror(errno)));
    data += sent;
    left -= static_cast<std::size_t>(sent);
  }
}

void VideoFile::finish() {
  close_pipe();
  const int status = wait();
  if (!WIFEXITED(status)) fail(fmt::format("ffmpeg was ended by signal {}", WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0) fail(fmt::format("ffmpeg failed ({})", WEXITSTATUS(status)));
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) fail(error.message());
}

void VideoFile::close_pipe() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
}

int VideoFile::wait() {
  int status = 0;
  while (waitpid(encoder_, &status, 0) < 0 && errno == EINTR) {
  }
  encoder_ = -1;
  return status;
}

void VideoFile::fail(const std::string& reason) {
  close_pipe();
  if (encoder_ > 0) wait();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  const std::string said = read_log(log_);
  throw std::runtime_error(
      fmt::format("{}: {}{}{}", file_.string(), reason, said.empty() ? "" : ": ", said));
}

void write_picture(const Image& picture, const std::filesystem::path& file) {
  VideoFile still(
      file, picture.width, picture.height, 1.0,
      {"-frames:v", "1", "-c:v", "png", "-fflags", "+bitexact", "-f", "image2", "-update", "1"});
  still.add(picture);
  still.finish();
}

}  // namespace rotorub::renders
