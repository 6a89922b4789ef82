// The room that pictures are taken in: MuJoCo's renderer on an off-screen OpenGL context, with the
// meshes of the machine loaded.
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

// While it lives, an error of MuJoCo is thrown as std::runtime_error; by itself mju_error waits for
// Enter and ends the process. MuJoCo's handler is global to the process; the one before comes back
// at the end.
class MujocoErrors {
 public:
  MujocoErrors();
  ~MujocoErrors() { mju_user_error = previous_; }
  MujocoErrors(const MujocoErrors&) = delete;
  MujocoErrors& operator=(const MujocoErrors&) = delete;

 private:
  void (*previous_)(const char*);
};

// An OpenGL context that draws into memory: no display, no GPU, no window system (Mesa's OSMesa).
// Current on the constructing thread from construction to destruction, which must be on that
// thread.
class GlContext {
 public:
  // Throws std::runtime_error where Mesa cannot make a context.
  GlContext(int width, int height);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  // Makes this context the thread's again, after another one was used.
  void make_current();

 private:
  osmesa_context* context_;
  int width_, height_;
  std::vector<std::uint8_t> window_;  // the default framebuffer; frames go to MuJoCo's own
};

struct StageOptions {
  int width = 960, height = 540;  // pixels, of the whole picture
  int samples = 4;                // for smooth edges; 0: none
  Color background{0.95F, 0.96F, 0.975F};
};

class Stage {
 public:
  // Throws std::runtime_error with MuJoCo's or OpenGL's words.
  Stage(const StageOptions& options, std::span<const Mesh> meshes);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  // What is seen: camera and lights are the caller's, shapes come from the canvas.
  mjvScene& scene() { return scene_; }
  // For the next picture, without a shape yet.
  Canvas canvas();
  // The scene into that part of the picture, which has the stage's size.
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
