#include "renders/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "native_model/trajectory/output.h"
#include "renders/sheet.h"

extern char** environ;

namespace rotorub::renders {

namespace {

constexpr const char* kEncoder = "ffmpeg";

constexpr int kOut = 3;  // file descriptor of the output file in ffmpeg

constexpr int kPoll_ms = 100;

// Processor time that a process has used, s; constant while it hangs. 0 if unknown.
double processor_seconds(pid_t process) {
  std::ifstream in(fmt::format("/proc/{}/stat", process));
  std::string line;
  std::getline(in, line);
  std::istringstream fields(
      line.substr(std::min(line.rfind(')'), line.size())));  // the name may contain anything
  std::string skipped;
  for (int k = 0; k < 12; ++k) fields >> skipped;
  double user = 0.0, system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// H.264 that every browser can play, with the index first so that it plays from a data URL. A fixed
// number of threads and no version stamps ensure that equal frames give equal bytes.
constexpr const char* kFilm =
    "-vf scale=out_color_matrix=bt709:out_range=tv -c:v libx264 -preset veryfast -tune animation "
    "-pix_fmt yuv420p -colorspace bt709 -color_primaries bt709 -color_trc bt709 -threads 2 "
    "-crf 25 "
    "-fflags +bitexact -flags:v +bitexact -movflags +faststart -f mp4";

// A single palette for all frames, so ffmpeg keeps them until the last one.
constexpr const char* kGif =
    "-filter_complex split[frames][counted];[counted]palettegen=stats_mode=full[palette];"
    "[frames][palette]paletteuse=dither=none:diff_mode=rectangle -loop 0 -fflags +bitexact -f gif";

// Raw frames on standard input, and only errors on standard error. The output is a descriptor, not
// a file name: an encoder that outlives this process would otherwise recreate the file after the
// next run removed it.
std::vector<std::string> arguments_of(int width, int height, const Encoding& encoding) {
  std::istringstream words(fmt::format(
      "{} -nostdin -hide_banner -loglevel error -y -f rawvideo -pixel_format bgr0 "
      "-video_size {}x{} -framerate {} -i pipe:0 {} file:/dev/fd/{}",
      kEncoder, width, height, encoding.frames_per_second, encoding.gif ? kGif : kFilm, kOut));
  return {std::istream_iterator<std::string>(words), {}};
}

// Starts ffmpeg with `in` as standard input, `log` as standard error and `out` as kOut. It gets its
// own process group, so that only the caller handles a keyboard interrupt. Returns an error number,
// 0 on success.
int spawn(std::vector<std::string> arguments, int in, int log, int out, pid_t& child) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, log, STDERR_FILENO);
  posix_spawn_file_actions_adddup2(&files, out, kOut);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t started = -1;
  const int error = posix_spawnp(&started, kEncoder, &files, &attributes, argv.data(), environ);
  if (error == 0) child = started;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

// True if the boxes of an mp4 fill the file and include index and frames.
bool is_whole_mp4(std::ifstream& in, std::uintmax_t size) {
  constexpr std::uintmax_t kHead = 8;
  const auto number = [&in](int bytes) {
    std::uintmax_t value = 0;
    for (int k = 0; k < bytes; ++k) value = value << 8U | static_cast<unsigned char>(in.get());
    return value;
  };
  bool index = false, frames = false;
  std::uintmax_t at = 0;
  while (at + kHead <= size) {
    in.seekg(static_cast<std::streamoff>(at));
    std::uintmax_t box = number(4);
    std::string kind(4, ' ');
    in.read(kind.data(), 4);
    if (box == 1) box = number(8);  // 64 bits wide
    if (!in || box < kHead || box > size - at) return false;
    index = index || kind == "moov";
    frames = frames || kind == "mdat";
    at += box;
  }
  return at == size && index && frames;
}

// True if the film is complete. On a full disk ffmpeg may succeed without writing all of it.
bool is_whole(const std::filesystem::path& file, bool gif) {
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(file, none);
  std::ifstream in(file, std::ios::binary);
  if (none || !in || size == 0) return false;
  if (!gif) return is_whole_mp4(in, size);
  constexpr int kTrailer = 0x3b;
  in.seekg(-1, std::ios::end);
  return in.get() == kTrailer;
}

std::string read_log(int log) {
  std::string text(static_cast<std::size_t>(std::max<off_t>(lseek(log, 0, SEEK_END), 0)), ' ');
  if (pread(log, text.data(), text.size(), 0) < 0) return "";
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace

// Limits how long the encoder may be inactive: it takes no frame, uses no processor time and writes
// nothing.
class VideoFile::Patience {
 public:
  explicit Patience(VideoFile& video) : video_(&video) { renew(); }

  void renew() {
    used_ = processor_seconds(video_->encoder_);
    written_ = written();
    since_ = Clock::now();
  }
  // Kills the encoder and throws if the time is over.
  void check() {
    if (processor_seconds(video_->encoder_) > used_ || written() != written_) return renew();
    const double waited = std::chrono::duration<double>(Clock::now() - since_).count();
    if (waited < video_->patience_) return;
    video_->fail(fmt::format("ffmpeg did nothing for {:.0f} s, so it was ended", waited));
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Bytes of the file so far. If ffmpeg is a script, another process of its group does the work, so
  // its processor time does not count.
  std::uintmax_t written() const {
    std::error_code none;
    const std::uintmax_t size = std::filesystem::file_size(video_->part_, none);
    return none ? 0 : size;
  }

  VideoFile* video_;
  double used_ = 0.0;
  std::uintmax_t written_ = 0;
  Clock::time_point since_;
};

VideoFile::VideoFile(double patience, const std::filesystem::path& file, int width, int height)
    : file_(file), part_(part_of(file)), width_(width), height_(height), patience_(patience) {}

// If this constructor throws, the destructor runs, because the delegated one has completed.
VideoFile::VideoFile(const std::filesystem::path& file, int width, int height,
                     const Encoding& encoding)
    : VideoFile(encoding.patience, file, width, height) {
  gif_ = encoding.gif;
  assert(width > 0 && height > 0 && (encoding.gif || (width % 2 == 0 && height % 2 == 0)));
  int ends[2] = {-1, -1};
  // A socket instead of a pipe: if the reader has gone, send() fails instead of raising a signal.
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), std::strerror(errno)));
  }
  pipe_ = ends[1];
  log_ = memfd_create("encoder-log", MFD_CLOEXEC);
  const int out = open(part_.c_str(), O_RDWR | O_CLOEXEC);
  const int error = log_ < 0 || out < 0 ? errno
                                        : spawn(arguments_of(width, height, encoding), ends[0],
                                                log_, out, encoder_);
  if (out >= 0) close(out);
  close(ends[0]);
  if (error == 0) return;
  throw std::runtime_error(fmt::format(
      "{}: cannot start the program `{}`, which makes the video: {}; install the Debian package "
      "ffmpeg, or put the program on the PATH",
      file.string(), kEncoder, std::strerror(error)));
}

VideoFile::~VideoFile() {
  close_pipe();
  end_encoder();
  std::error_code ignored;
  if (!finished_) std::filesystem::remove(part_, ignored);
  if (log_ >= 0) close(log_);
}

void VideoFile::add(const Picture& frame) {
  assert(frame.width() == width_ && frame.height() == height_);
  const std::uint8_t* data = frame.bytes().data();
  std::size_t left = frame.bytes().size();
  Patience patience(*this);
  while (left > 0) {
    const ssize_t sent = send(pipe_, data, left, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
      data += sent;
      left -= static_cast<std::size_t>(sent);
      patience.renew();
    } else if (sent < 0 && errno == EAGAIN) {
      pollfd writable{pipe_, POLLOUT, 0};
      poll(&writable, 1, kPoll_ms);
      patience.check();
    } else if (sent < 0 && errno != EINTR) {
      fail(fmt::format("ffmpeg accepts no more frames ({})", std::strerror(errno)));
    }
  }
}

void VideoFile::finish() {
  close_pipe();
  const int status = wait();
  if (!WIFEXITED(status)) fail(fmt::format("ffmpeg was ended by signal {}", WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0) fail(fmt::format("ffmpeg failed ({})", WEXITSTATUS(status)));
  if (!is_whole(part_, gif_))
    fail("ffmpeg left the file incomplete; check that the disk is not full");
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) fail(error.message());
  finished_ = true;
}

void VideoFile::close_pipe() {
  if (pipe_ >= 0) close(pipe_);
  pipe_ = -1;
}

int VideoFile::wait() {
  int status = 0;
  Patience patience(*this);
  while (waitpid(encoder_, &status, WNOHANG) == 0) {
    poll(nullptr, 0, kPoll_ms / 10);
    patience.check();
  }
  encoder_ = -1;
  return status;
}

// Kills the encoder with the processes that it started; it leads its process group.
void VideoFile::end_encoder() {
  if (encoder_ <= 0) return;
  kill(-encoder_, SIGKILL);
  while (waitpid(encoder_, nullptr, 0) < 0 && errno == EINTR) {
  }
  encoder_ = -1;
}

void VideoFile::fail(const std::string& reason) {
  close_pipe();
  end_encoder();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  const std::string said = read_log(log_);
  throw std::runtime_error(
      fmt::format("{}: {}{}{}", file_.string(), reason, said.empty() ? "" : ": ", said));
}

}  // namespace rotorub::renders
