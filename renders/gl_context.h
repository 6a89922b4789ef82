// An OpenGL context that draws into memory: no display, no GPU, no window system (Mesa's OSMesa).
#pragma once

#include <cstdint>
#include <vector>

struct osmesa_context;

namespace rotorub::renders {

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

}  // namespace rotorub::renders
