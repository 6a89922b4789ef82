#include "renders/video.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "renders/film.h"
#include "renders/framing.h"
#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

// The output of ffprobe for a file, "key=value" lines.
std::string probe(const std::filesystem::path& file) {
  const std::string command =
      "ffprobe -v error -count_frames -show_entries "
      "stream=codec_name,width,height,pix_fmt,nb_read_frames,avg_frame_rate -of default=nw=1 '" +
      file.string() + "'";
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  char line[256];
  while (std::fgets(line, sizeof line, pipe) != nullptr) text += line;
  pclose(pipe);
  return text;
}

std::string bytes(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

Picture grey(int width, int height) {
  Picture picture(width, height);
  Sheet(picture, {0, 0, width, height}).fill(0.0, 0.0, width, height, {0.5F, 0.5F, 0.5F});
  return picture;
}

RenderOptions short_film() {
  RenderOptions options;
  options.width = 320;
  options.height = 180;
  options.samples = 0;
  options.duration = 1.0;
  options.frames_per_second = 12.0;
  return options;
}

// Restores PATH at the end of the scope.
class Path {
 public:
  explicit Path(const std::string& value) : before_(std::getenv("PATH")) {
    setenv("PATH", value.c_str(), 1);
  }
  ~Path() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

// A program named ffmpeg in the folder's bin, for one scope.
Path stand_in(const Folder& folder, const std::string& script) {
  std::filesystem::create_directory(folder / "bin");
  std::ofstream(folder / "bin/ffmpeg") << "#!/bin/sh\n" << script;
  std::filesystem::permissions(folder / "bin/ffmpeg", std::filesystem::perms::owner_all);
  return Path((folder / "bin").string());
}

TEST(Video, FilmHasItsFramesSizeAndFormat) {
  const Folder folder;
  const Trajectory run = whirling_run();
  std::vector<double> told;
  RenderOptions options = short_film();
  options.progress = [&](double done) { told.push_back(done); };
  const RenderResult result = render(ring_scene(), run, options, folder / "film.mp4");
  EXPECT_EQ(result.framing.frames, 12);
  EXPECT_DOUBLE_EQ(result.film_s, 1.0);
  const std::string said = probe(folder / "film.mp4");
  for (const char* line : {"codec_name=h264\n", "width=320\n", "height=180\n", "pix_fmt=yuv420p\n",
                           "nb_read_frames=12\n", "avg_frame_rate=12/1\n"}) {
    EXPECT_NE(said.find(line), std::string::npos) << line << said;
  }
  // No other file is left beside it, and the index comes first, for playing while loading.
  EXPECT_EQ(folder.entries(), 1u);
  const std::string content = bytes(folder / "film.mp4");
  EXPECT_LT(content.find("moov"), content.find("mdat"));

  ASSERT_EQ(told.size(), 12u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1.0);
}

TEST(Video, FramesDoNotDependOnTheNumberOfThreads) {
  const Folder folder;
  const Trajectory run = whirling_run();
  RenderOptions options = short_film();
  for (const int threads : {1, 3}) {
    options.threads = threads;
    render(ring_scene(), run, options, folder / (std::to_string(threads) + ".mp4"));
  }
  EXPECT_EQ(bytes(folder / "1.mp4"), bytes(folder / "3.mp4"));
}

TEST(Video, MissingEncoderIsNamedAndLeavesNothing) {
  const Folder folder;
  const Folder* const empty = &folder;
  const Path path(empty->path().string());
  expect_thrown<std::runtime_error>(
      [&] { render(ring_scene(), whirling_run(), short_film(), folder / "film.mp4"); }, "ffmpeg");
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(Video, ErrorHalfwayKeepsTheFileBefore) {
  const Folder folder;
  std::ofstream(folder / "film.mp4") << "before";
  RenderOptions options = short_film();
  options.progress = [](double done) {
    if (done > 0.5) throw std::domain_error("enough");
  };
  EXPECT_THROW(render(ring_scene(), whirling_run(), options, folder / "film.mp4"),
               std::domain_error);
  EXPECT_EQ(folder.entries(), 1u);
  EXPECT_EQ(bytes(folder / "film.mp4"), "before");
}

TEST(Video, EncoderThatFailsAtTheEndIsNoticed) {
  const Folder folder;
  const Path path = stand_in(folder, "/bin/cat > /dev/null\necho 'disc full' >&2\nexit 3\n");
  VideoFile video(folder / "film.mp4", 64, 64, {});
  for (int i = 0; i < 3; ++i) video.add(grey(64, 64));
  expect_thrown<std::runtime_error>([&] { video.finish(); }, "disc full");
  EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

// On a full disk ffmpeg may end as if all had been written. A limit on the size of files stands for
// the disk; the encoder inherits it, and the signal that it ignores.
TEST(Video, AFilmOnAFullDiskIsNotWritten) {
  for (const bool gif : {false, true}) {
    const Folder folder;
    Encoding encoding;
    encoding.gif = gif;
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{600, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const std::string file = gif ? "film.gif" : "film.mp4";
    EXPECT_THROW(
        {
          VideoFile video(folder / file, 64, 64, encoding);
          for (int i = 0; i < 30; ++i) video.add(grey(64, 64));
          video.finish();
        },
        std::runtime_error);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(folder.entries(), 0u) << file;
  }
}

// An encoder that reports nothing and leaves half of a film: its first box reaches beyond the file.
TEST(Video, AFilmThatIsNotWholeIsNotWritten) {
  const Folder folder;
  const Path path =
      stand_in(folder, "/bin/cat > /dev/null\nprintf '\\000\\000\\020\\000ftypisom' > /dev/fd/3\n");
  VideoFile video(folder / "film.mp4", 64, 64, {});
  video.add(grey(64, 64));
  expect_thrown<std::runtime_error>([&] { video.finish(); }, "incomplete");
  EXPECT_FALSE(std::filesystem::exists(folder / "film.mp4"));
}

// A stand-in named ffmpeg that never takes a frame, or takes them all and never ends.
TEST(Video, EncoderThatHangsIsEnded) {
  for (const char* taken : {"", "/bin/cat > /dev/null\n"}) {
    const Folder folder;
    const Path path = stand_in(folder, std::string(taken) + "/bin/sleep 1000\n");
    Encoding encoding;
    encoding.patience = 0.5;
    VideoFile video(folder / "film.mp4", 640, 480, encoding);
    expect_thrown<std::runtime_error>(
        [&] {
          for (int i = 0; i < 10; ++i) video.add(grey(640, 480));  // more than a socket holds
          video.finish();
        },
        "film.mp4: ffmpeg did nothing");
    EXPECT_EQ(folder.entries(), 1u) << "bin alone";
  }
}

TEST(Video, AGifIsOfFewFrames) {
  RenderOptions large;  // 1280 x 720, 12 s: all its frames at once are more than 1 GB
  large.frames_per_second = 50.0;
  const Folder folder;
  EXPECT_THROW(render(ring_scene(), whirling_run(), large, folder / "film.gif"),
               std::invalid_argument);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(Video, GifHasItsFramesAndSize) {
  const Folder folder;
  RenderOptions options = short_film();
  options.width = 321;
  options.frames_per_second = 10.0;
  render(ring_scene(), whirling_run(), options, folder / "film.gif");
  const std::string said = probe(folder / "film.gif");
  for (const char* line : {"codec_name=gif\n", "width=321\n", "nb_read_frames=10\n"}) {
    EXPECT_NE(said.find(line), std::string::npos) << line << said;
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Video, StillKeepsEveryPixel) {
  const Folder folder;
  Picture picture = grey(6, 4);
  Sheet(picture, {0, 0, 1, 1}).fill(0.0, 0.0, 1.0, 1.0, {0.9F, 0.0F, 0.0F});  // upper left corner
  picture.write(folder / "still.png");
  EXPECT_EQ(folder.entries(), 1u);
  const std::string command = "ffmpeg -v error -i '" + (folder / "still.png").string() +
                              "' -f rawvideo -pix_fmt rgb24 '" + (folder / "raw").string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string raw = bytes(folder / "raw");
  std::string pixels;
  for (int k = 0; k < 6 * 4; ++k) {
    for (const std::uint8_t part : picture.pixel(k % 6, k / 6)) pixels += static_cast<char>(part);
  }
  EXPECT_EQ(raw, pixels);
}

TEST(Video, StillBeforeWhatAFilmShowsByDefault) {
  const Folder folder;
  const Trajectory late = late_touch();
  ASSERT_GT(make_framing(Playback(late), short_film()).from, 0.02);
  EXPECT_EQ(render_still(ring_scene(), late, 0.02, short_film(), folder / "still.png").t, 0.02);
}

// In figures that are read at a glance, and from the beginning of the run, not of a film.
TEST(Video, StillBeyondTheRunIsToldItsTimes) {
  const Folder folder;
  const Trajectory late = late_touch();
  const auto refusal = [&](std::optional<double> from) {
    RenderOptions options = short_film();
    options.from = from;
    return test::message_of(
        [&] { render_still(ring_scene(), late, 1.0 / 3.0, options, folder / "no.png"); });
  };
  EXPECT_EQ(refusal({}), "there is no picture at 0.333333 s; expected a time from 0 s to 0.1 s");
  EXPECT_EQ(refusal(0.07 / 3.0),
            "there is no picture at 0.333333 s; expected a time from 0.0233333 s to 0.1 s");
}

}  // namespace
}  // namespace rotorub::renders
