// The room that pictures are taken in: MuJoCo's renderer on an off-screen OpenGL context, with the
// meshes of the machine loaded.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <string>

#include "renders/canvas.h"
#include "renders/gl_context.h"
#include "renders/image.h"
#include "renders/mesh.h"

namespace rotorub::renders {

struct StageOptions {
  int width = 960, height = 540;  // pixels, of the whole picture
  int samples = 4;                // for smooth edges; 0: none
  Color background{0.95F, 0.96F, 0.975F};
};

// The MJCF of a room with nothing but the meshes: size of the picture, background, quality.
std::string stage_mjcf(const StageOptions& options, std::span<const Mesh> meshes);

// One scene to draw into, with its room for shapes.
class SceneBuffer {
 public:
  explicit SceneBuffer(const mjModel& model);
  ~SceneBuffer() { mjv_freeScene(&scene_); }
  SceneBuffer(const SceneBuffer&) = delete;
  SceneBuffer& operator=(const SceneBuffer&) = delete;
  mjvScene& operator*() { return scene_; }

 private:
  mjvScene scene_;
};

class Stage {
 public:
  // Throws std::runtime_error with MuJoCo's or OpenGL's words.
  Stage(const StageOptions& options, std::span<const Mesh> meshes);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  const mjModel& model() const { return *model_; }
  int width() const { return context_.offWidth; }
  int height() const { return context_.offHeight; }

  // MuJoCo keeps a mesh in its frame of inertia: draws mesh `id` as it was given, at `center`,
  // turned by `axes`.
  void draw_mesh(Canvas& canvas, int id, const Eigen::Vector3d& center, const Eigen::Matrix3d& axes,
                 const Color& color) const;

  void begin_picture();  // the context is current
  // The scene as a picture of the stage's size.
  Image render(mjvScene& scene);

 private:
  struct ModelDeleter {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
  };
  GlContext gl_;
  std::unique_ptr<mjModel, ModelDeleter> model_;
  mjrContext context_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace rotorub::renders
