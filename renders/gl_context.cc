#include "renders/gl_context.h"

#include <GL/osmesa.h>

#include <stdexcept>

namespace rotorub::renders {

namespace {
constexpr int kDepthBits = 24;
constexpr int kStencilBits = 8;
}  // namespace

GlContext::GlContext(int width, int height)
    : context_(OSMesaCreateContextExt(OSMESA_RGBA, kDepthBits, kStencilBits, 0, nullptr)),
      width_(width),
      height_(height),
      window_(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  if (context_ == nullptr) {
    throw std::runtime_error("off-screen rendering: OSMesa cannot create an OpenGL context");
  }
  try {
    make_current();
  } catch (...) {
    OSMesaDestroyContext(context_);
    throw;
  }
}

GlContext::~GlContext() {
  OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  OSMesaDestroyContext(context_);
}

void GlContext::make_current() {
  if (!OSMesaMakeCurrent(context_, window_.data(), GL_UNSIGNED_BYTE, width_, height_)) {
    throw std::runtime_error("off-screen rendering: OSMesa refuses a picture of " +
                             std::to_string(width_) + " x " + std::to_string(height_) + " pixels");
  }
}

}  // namespace rotorub::renders
