#include "renders/stage.h"

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <cassert>
#include <iterator>
#include <stdexcept>

#include "plugin/model/mujoco_versions.h"

namespace rotorub::renders {

namespace {

constexpr int kDepthBits = 24, kStencilBits = 8;

constexpr int kShapes = 4000;   // capacity of the scene
constexpr int kRoundness = 24;  // sides of MuJoCo's round primitives
// layers of round primitives; each triangle costs time in software rendering
constexpr int kStacks = 4;

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

// A model with only the meshes, the size of the picture, the background and the quality.
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

// Mesa depends on LLVM with 400,000 relocations, which would slow every start of a program linked
// with it. So it is loaded when the first picture is made, with global symbols, because MuJoCo
// looks up OpenGL's functions in the process.
struct Mesa {
  decltype(&OSMesaCreateContextExt) create;
  decltype(&OSMesaDestroyContext) destroy;
  decltype(&OSMesaMakeCurrent) make_current;
};

// Throws std::runtime_error if Mesa cannot be loaded.
const Mesa& mesa() {
  static const Mesa found = [] {
    void* const library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_GLOBAL);
    if (library == nullptr) {
      throw std::runtime_error(
          fmt::format("off-screen rendering: {} (Debian: libosmesa6)", dlerror()));
    }
    const auto symbol = [&]<class Function>(Function*& function, const char* name) {
      function = reinterpret_cast<Function*>(dlsym(library, name));
      if (function == nullptr) {
        throw std::runtime_error(fmt::format("off-screen rendering: {}", dlerror()));
      }
    };
    Mesa all{};
    symbol(all.create, "OSMesaCreateContextExt");
    symbol(all.destroy, "OSMesaDestroyContext");
    symbol(all.make_current, "OSMesaMakeCurrent");
    return all;
  }();
  return found;
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

MujocoErrors::MujocoErrors() : previous_(mju_user_error) {
  mju_user_error = [](const char* message) {
    throw std::runtime_error(std::string("off-screen rendering: MuJoCo: ") + message);
  };
}

GlContext::GlContext(int width, int height)
    : context_(mesa().create(OSMESA_RGBA, kDepthBits, kStencilBits, 0, nullptr)),
      width_(width),
      height_(height),
      window_(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  if (context_ == nullptr) {
    throw std::runtime_error("off-screen rendering: OSMesa cannot create an OpenGL context");
  }
  try {
    make_current();
  } catch (...) {
    mesa().destroy(context_);
    throw;
  }
}

GlContext::~GlContext() {
  mesa().make_current(nullptr, nullptr, 0, 0, 0);
  mesa().destroy(context_);
}

void GlContext::make_current() {
  if (!mesa().make_current(context_, window_.data(), GL_UNSIGNED_BYTE, width_, height_)) {
    throw std::runtime_error(fmt::format(
        "off-screen rendering: OSMesa refuses a picture of {} x {} pixels", width_, height_));
  }
}

Stage::Stage(const StageOptions& options, std::span<const Mesh> meshes)
    : gl_(options.width, options.height), model_(load(stage_mjcf(options, meshes))) {
  mjr_defaultContext(&context_);
  mjr_makeContext(model_.get(), &context_, mjFONTSCALE_50);  // no text is drawn with this font
  mjr_setBuffer(mjFB_OFFSCREEN, &context_);
  if (context_.currentBuffer != mjFB_OFFSCREEN) {
    mjr_freeContext(&context_);
    throw std::runtime_error("off-screen rendering: MuJoCo has no off-screen buffer here");
  }
  mjv_defaultScene(&scene_);
  mjv_makeScene(model_.get(), &scene_, kShapes);
  for (const int effect : {mjRND_SHADOW, mjRND_REFLECTION, mjRND_HAZE}) scene_.flags[effect] = 0;
  scene_.flags[mjRND_SKYBOX] = 1;
  pixels_.resize(3 * static_cast<std::size_t>(options.width) *
                 static_cast<std::size_t>(options.height));
}

Stage::~Stage() {
  mjv_freeScene(&scene_);
  gl_.make_current();
  mjr_freeContext(&context_);
}

Canvas Stage::canvas() {
  scene_.ngeom = 0;
  return {scene_, *model_};
}

void Stage::render(Picture& picture, const Area& area) {
  assert(area.width == context_.offWidth && area.height == context_.offHeight);
  gl_.make_current();
  mjr_setBuffer(mjFB_OFFSCREEN, &context_);
  const mjrRect all{0, 0, area.width, area.height};
  mjr_render(all, &scene_, &context_);
  mjr_readPixels(pixels_.data(), nullptr, all, &context_);
  if (const int error = mjr_getError(); error != 0) {
    throw std::runtime_error(fmt::format("off-screen rendering: OpenGL error {:#x}", error));
  }
  // OpenGL counts rows from the bottom.
  const std::size_t row = pixels_.size() / static_cast<std::size_t>(area.height);
  picture.put(area, [&](int y) {
    return pixels_.data() + static_cast<std::size_t>(area.height - 1 - y) * row;
  });
}

}  // namespace rotorub::renders
