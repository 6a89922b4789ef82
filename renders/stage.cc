#include "renders/stage.h"

#include <fmt/format.h>

#include <cassert>
#include <cstring>
#include <iterator>
#include <stdexcept>

#include "plugin/mujoco_versions.h"

namespace rotorub::renders {

namespace {

constexpr int kShapes = 4000;   // room of one scene
constexpr int kRoundness = 32;  // sides of MuJoCo's round primitives, and
constexpr int kStacks = 6;      // their layers; software rendering pays for every triangle

void append(std::string& out, const std::vector<Eigen::Vector3d>& points) {
  for (const Eigen::Vector3d& p : points) {
    fmt::format_to(std::back_inserter(out), "{:.9g} {:.9g} {:.9g} ", p[0], p[1], p[2]);
  }
}

std::string mesh_mjcf(const Mesh& mesh) {
  std::string out = fmt::format("    <mesh name=\"{}\" vertex=\"", mesh.name);
  append(out, mesh.points);
  out += "\" normal=\"";
  append(out, mesh.normals);
  out += "\" face=\"";
  for (const auto& [a, b, c] : mesh.triangles) {
    fmt::format_to(std::back_inserter(out), "{} {} {} ", a, b, c);
  }
  return out + "\"/>\n";
}

mjModel* load(const std::string& mjcf) {
  char error[1000] = "";
  mjModel* model = plugin::load_text(mjcf, error, sizeof error);
  if (model == nullptr) {
    throw std::runtime_error(fmt::format("off-screen rendering: the stage's model: {}", error));
  }
  return model;
}

}  // namespace

std::string stage_mjcf(const StageOptions& options, std::span<const Mesh> meshes) {
  const Color& sky = options.background;
  std::string out = fmt::format(
      "<mujoco model=\"stage\">\n"
      "  <visual>\n"
      "    <global offwidth=\"{}\" offheight=\"{}\"/>\n"
      "    <quality offsamples=\"{}\" shadowsize=\"0\" numslices=\"{}\" numstacks=\"{}\"/>\n"
      "  </visual>\n"
      "  <asset>\n"
      "    <texture type=\"skybox\" builtin=\"flat\" rgb1=\"{} {} {}\" rgb2=\"{} {} {}\" "
      "width=\"16\" height=\"96\"/>\n",
      options.width, options.height, options.samples, kRoundness, kStacks, sky.red, sky.green,
      sky.blue, sky.red, sky.green, sky.blue);
  for (const Mesh& mesh : meshes) out += mesh_mjcf(mesh);
  out += "  </asset>\n  <worldbody>\n";
  for (const Mesh& mesh : meshes) {
    out += fmt::format("    <geom type=\"mesh\" mesh=\"{}\" contype=\"0\" conaffinity=\"0\"/>\n",
                       mesh.name);
  }
  return out + "  </worldbody>\n</mujoco>\n";
}

SceneBuffer::SceneBuffer(const mjModel& model) {
  mjv_defaultScene(&scene_);
  mjv_makeScene(&model, &scene_, kShapes);
  scene_.flags[mjRND_SHADOW] = 0;
  scene_.flags[mjRND_REFLECTION] = 0;
  scene_.flags[mjRND_HAZE] = 0;
  scene_.flags[mjRND_SKYBOX] = 1;
}

Stage::Stage(const StageOptions& options, std::span<const Mesh> meshes)
    : gl_(options.width, options.height), model_(load(stage_mjcf(options, meshes))) {
  mjr_defaultContext(&context_);
  mjr_makeContext(model_.get(), &context_, mjFONTSCALE_50);  // nothing is written with it
  mjr_setBuffer(mjFB_OFFSCREEN, &context_);
  if (context_.currentBuffer != mjFB_OFFSCREEN) {
    mjr_freeContext(&context_);
    throw std::runtime_error("off-screen rendering: MuJoCo has no off-screen buffer here");
  }
  pixels_.resize(3 * static_cast<std::size_t>(options.width) *
                 static_cast<std::size_t>(options.height));
}

Stage::~Stage() {
  gl_.make_current();
  mjr_freeContext(&context_);
}

void Stage::draw_mesh(Canvas& canvas, int id, const Eigen::Vector3d& center,
                      const Eigen::Matrix3d& axes, const Color& color) const {
  assert(id >= 0 && id < model_->nmesh);
  const mjtNum* position = model_->geom_pos + 3 * id;  // one geom a mesh, in order
  const mjtNum* turn = model_->geom_quat + 4 * id;
  const Eigen::Quaterniond frame(turn[0], turn[1], turn[2], turn[3]);
  canvas.mesh(id, center + axes * Eigen::Vector3d(position[0], position[1], position[2]),
              axes * frame.toRotationMatrix(), color);
}

void Stage::begin_picture() {
  gl_.make_current();
  mjr_setBuffer(mjFB_OFFSCREEN, &context_);
}

Image Stage::render(mjvScene& scene) {
  const mjrRect all{0, 0, width(), height()};
  mjr_render(all, &scene, &context_);
  mjr_readPixels(pixels_.data(), nullptr, all, &context_);
  if (const int error = mjr_getError(); error != 0) {
    throw std::runtime_error(fmt::format("off-screen rendering: OpenGL error {:#x}", error));
  }
  // OpenGL counts rows from the bottom.
  Image picture{width(), height(), std::vector<std::uint8_t>(pixels_.size())};
  const std::size_t row = 3 * static_cast<std::size_t>(width());
  for (std::size_t y = 0; y < static_cast<std::size_t>(height()); ++y) {
    std::memcpy(picture.rgb.data() + y * row,
                pixels_.data() + (static_cast<std::size_t>(height()) - 1 - y) * row, row);
  }
  return picture;
}

}  // namespace rotorub::renders
