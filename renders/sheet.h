// Pictures in memory, and two-dimensional drawing on them with Cairo.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "renders/palette.h"

struct _cairo;          // Cairo's cairo_t
struct _cairo_surface;  // its cairo_surface_t

namespace rotorub::renders {

// A part of the picture, in whole pixels from its upper left corner.
struct Area {
  int left = 0, top = 0, width = 0, height = 0;
  int right() const { return left + width; }
  int bottom() const { return top + height; }
  double aspect() const { return static_cast<double>(width) / height; }
};

// Initially white. Copies share the same pixels. Throws std::runtime_error with Cairo's reason.
class Picture {
 public:
  Picture(int width, int height);
  int width() const;   // pixels
  int height() const;  // pixels
  // All pixels: rows from the top down, not padded; per pixel blue, green, red and an unused byte.
  std::span<const std::uint8_t> bytes() const;
  // Red, green, blue; row 0 is at the top.
  std::array<std::uint8_t, 3> pixel(int column, int row) const;
  // Copies another picture into the area. row(k) returns its k-th row from the top, 3 bytes per
  // pixel.
  void put(const Area& area, const std::function<const std::uint8_t*(int row)>& row);
  // Writes a PNG file, completely or not at all.
  void write(const std::filesystem::path& file) const;
  _cairo_surface* surface() const { return surface_.get(); }

 private:
  std::shared_ptr<_cairo_surface> surface_;
};

// DejaVu Sans, which is embedded in the program.
enum class Weight { kRegular, kBold };

// Coordinates are pixels of the area, x to the right, y down, with (0, 0) at its upper left corner;
// pixel i covers [i, i + 1). Drawing is clipped to the area. Angles: rad, counter-clockwise as
// seen.
class Sheet {
 public:
  using Point = Eigen::Vector2d;

  // The picture must outlive the sheet.
  Sheet(const Picture& picture, const Area& area);
  const Area& area() const { return area_; }
  Sheet part(const Area& area) const { return {*picture_, area}; }  // of the picture

  // The columns [from, to) of a picture, in their places.
  void show(const Picture& picture, double from, double to);
  void fill(double x, double y, double width, double height, const Color& color);
  void polyline(std::span<const Point> points, double width, const Color& color);  // round ends
  void bar(const Point& from, const Point& to, double width, const Color& color);  // flat ends
  // A path that fades from its end (the present) to its beginning. Points farther apart than
  // `longest` are not connected.
  void trail(std::span<const Point> points, double width, const Color& color,
             double longest = 1e300);
  void disc(const Point& center, double radius, const Color& color);
  void ring(const Point& center, double inner, double outer, const Color& color);
  // A sector of a ring, from angle `from` over `span` in (0, pi].
  void sector(const Point& center, double inner, double outer, double from, double span,
              const Color& color);
  void dashed_circle(const Point& center, double radius, double width, const Color& color);
  void arrow(const Point& from, const Point& to, double width, const Color& color);

  // One line of UTF-8 text with the top of its capitals at about y. Returns the x after the text.
  // Characters that the font lacks appear as boxes. size: height of the em, pixels.
  double text(double x, double y, std::string_view words, int size, const Color& color,
              Weight weight = Weight::kRegular);
  double text_width(std::string_view words, int size, Weight weight = Weight::kRegular) const;
  // The same, but ending at x.
  void text_to(double x, double y, std::string_view words, int size, const Color& color,
               Weight weight = Weight::kRegular);

 private:
  void use_font(int size, Weight weight) const;
  void polygon(std::span<const Point> corners, const Color& color);
  // Fills the current path.
  void fill(const Color& color);
  void stroke(double width, const Color& color);
  void arc(const Point& center, double radius, double from, double to);

  const Picture* picture_;
  Area area_;
  std::shared_ptr<_cairo> pen_;
};

}  // namespace rotorub::renders
