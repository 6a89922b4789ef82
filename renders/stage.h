// Renders pictures with MuJoCo on an off-screen OpenGL context, with the machine's meshes loaded.
#pragma once

#include <mujoco/mujoco.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "renders/canvas.h"
#include "renders/sheet.h"

struct osmesa_context;

namespace rotorub::renders {

// While an object exists, errors of MuJoCo are thrown as std::runtime_error; by default mju_error
// waits for Enter and ends the process. MuJoCo's handler is global to the process; the previous one
// is restored at the end.
class MujocoErrors {
 public:
  MujocoErrors();
  ~MujocoErrors() { mju_user_error = previous_; }
  MujocoErrors(const MujocoErrors&) = delete;
  MujocoErrors& operator=(const MujocoErrors&) = delete;

 private:
  void (*previous_)(const char*);
};

// An OpenGL context that draws into memory, without display, GPU or window system (Mesa's OSMesa).
// It is current on the constructing thread and must be destroyed on that thread.
class GlContext {
 public:
  // Throws std::runtime_error if Mesa cannot create a context.
  GlContext(int width, int height);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  // Makes this context current on the thread again after another one was used.
  void make_current();

 private:
  osmesa_context* context_;
  int width_, height_;
  std::vector<std::uint8_t> window_;  // the default framebuffer; frames are drawn into MuJoCo's own
};

struct StageOptions {
  int width = 960, height = 540;  // pixels, of the whole picture
  int samples = 4;                // multisampling for smooth edges; 0: none
  Color background{0.95F, 0.96F, 0.975F};
};

class Stage {
 public:
  // Throws std::runtime_error with the message of MuJoCo or OpenGL.
  Stage(const StageOptions& options, std::span<const Mesh> meshes);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // The scene to render. The caller sets camera and lights; the canvas adds shapes.
  mjvScene& scene() { return scene_; }
  // An empty canvas for the next picture.
  Canvas canvas();
  // Renders the scene into this area of the picture, whose size is the stage's.
  void render(Picture& picture, const Area& area);

 private:
  struct ModelDeleter {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
  };
  GlContext gl_;
  std::unique_ptr<mjModel, ModelDeleter> model_;
  mjrContext context_;
  mjvScene scene_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace rotorub::renders
