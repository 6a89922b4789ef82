#include "renders/sheet.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace rotorub::renders {

namespace {

constexpr int kFadeSteps = 24;  // of a trail

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(std::string("the picture: ") + cairo_status_to_string(status));
}

// The row of the area in the surface: pixels of 32 bits, 0x00RRGGBB.
std::uint32_t* pixels(cairo_surface_t* surface, const Area& area, int row) {
  unsigned char* line =
      cairo_image_surface_get_data(surface) +
      static_cast<std::ptrdiff_t>(area.top + row) * cairo_image_surface_get_stride(surface);
  return reinterpret_cast<std::uint32_t*>(line) + area.left;
}

void move_along(cairo_t* pen, std::span<const Sheet::Point> points, double longest = 1e300) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool joined = i > 0 && (points[i] - points[i - 1]).norm() <= longest;
    (joined ? cairo_line_to : cairo_move_to)(pen, points[i][0], points[i][1]);
  }
}

}  // namespace

Picture::Picture(int width, int height)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height),
               cairo_surface_destroy) {
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> pen(cairo_create(surface()),
                                                               cairo_destroy);
  cairo_set_source_rgb(pen.get(), 1.0, 1.0, 1.0);
  cairo_paint(pen.get());
}

Image Picture::image() const {
  check(cairo_surface_status(surface()));
  cairo_surface_flush(surface());
  Image picture{
      cairo_image_surface_get_width(surface()), cairo_image_surface_get_height(surface()), {}};
  picture.rgb.resize(3 * static_cast<std::size_t>(picture.width * picture.height));
  std::uint8_t* to = picture.rgb.data();
  for (int row = 0; row < picture.height; ++row) {
    const std::uint32_t* from = pixels(surface(), {}, row);
    for (int column = 0; column < picture.width; ++column) {
      for (const int shift : {16, 8, 0}) *to++ = static_cast<std::uint8_t>(from[column] >> shift);
    }
  }
  return picture;
}

void Picture::write(const std::filesystem::path& file) const {
  check(cairo_surface_write_to_png(surface(), file.c_str()));
}

void Picture::put(const Image& picture, const Area& area) {
  cairo_surface_flush(surface());
  for (int row = 0; row < area.height; ++row) {
    std::uint32_t* to = pixels(surface(), area, row);
    const std::uint8_t* from = picture.pixel(0, row);
    for (int column = 0; column < area.width; ++column, from += 3) {
      to[column] = static_cast<std::uint32_t>(from[0] << 16 | from[1] << 8 | from[2]);
    }
  }
  cairo_surface_mark_dirty(surface());
}

Sheet::Sheet(const Picture& picture, const Area& area)
    : picture_(&picture), area_(area), pen_(cairo_create(picture.surface()), cairo_destroy) {
  cairo_translate(pen_.get(), area.left, area.top);
  cairo_rectangle(pen_.get(), 0.0, 0.0, area.width, area.height);
  cairo_clip(pen_.get());
  cairo_set_line_join(pen_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(pen_.get(), CAIRO_LINE_CAP_ROUND);
}

void Sheet::fill(const Color& color) {
  cairo_set_source_rgba(pen_.get(), color.red, color.green, color.blue, color.alpha);
  cairo_fill(pen_.get());
}

void Sheet::stroke(double width, const Color& color) {
  cairo_set_source_rgba(pen_.get(), color.red, color.green, color.blue, color.alpha);
  cairo_set_line_width(pen_.get(), width);
  cairo_stroke(pen_.get());
}

// y counts down.
void Sheet::arc(const Point& center, double radius, double from, double to) {
  const auto draw = from < to ? cairo_arc_negative : cairo_arc;
  draw(pen_.get(), center[0], center[1], std::max(radius, 0.0), -from, -to);
}

void Sheet::fill(double x, double y, double width, double height, const Color& color) {
  if (!(width > 0.0) || !(height > 0.0)) return;
  cairo_rectangle(pen_.get(), x, y, width, height);
  fill(color);
}

void Sheet::line(const Point& from, const Point& to, double width, const Color& color) {
  polyline(std::array{from, to}, width, color);
}

void Sheet::bar(const Point& from, const Point& to, double width, const Color& color) {
  const Point along = (to - from).normalized();
  const Point half = 0.5 * width * Point(-along[1], along[0]);
  const std::array<Point, 4> corners = {from + half, from - half, to - half, to + half};
  convex(corners, color);
}

void Sheet::polyline(std::span<const Point> points, double width, const Color& color) {
  move_along(pen_.get(), points);
  stroke(width, color);
}

// Ever shorter ends of the path, one upon the other: each is one stroke, so that joints are no
// beads.
void Sheet::trail(std::span<const Point> points, double width, const Color& color, double longest) {
  if (points.size() < 2) return;
  const auto last = static_cast<double>(points.size() - 1);
  const std::size_t step = (points.size() - 2) / kFadeSteps + 1;
  cairo_push_group_with_content(pen_.get(), CAIRO_CONTENT_ALPHA);
  cairo_set_operator(pen_.get(), CAIRO_OPERATOR_ADD);
  double strength = 0.0;
  for (std::size_t first = 0; first + 1 < points.size(); first += step) {
    const double reached = 0.1 + 0.9 * std::min(static_cast<double>(first + step) / last, 1.0);
    move_along(pen_.get(), points.subspan(first), longest);
    stroke(width, Color{}.with_alpha(reached - strength));
    strength = reached;
  }
  cairo_pattern_t* const cover = cairo_pop_group(pen_.get());
  cairo_set_source_rgba(pen_.get(), color.red, color.green, color.blue, color.alpha);
  cairo_mask(pen_.get(), cover);
  cairo_pattern_destroy(cover);
}

void Sheet::disc(const Point& center, double radius, const Color& color) {
  arc(center, radius, 0.0, 2.0 * std::numbers::pi);
  fill(color);
}

void Sheet::ring(const Point& center, double inner, double outer, const Color& color) {
  arc(center, outer, 0.0, 2.0 * std::numbers::pi);
  cairo_close_path(pen_.get());
  cairo_new_sub_path(pen_.get());
  arc(center, inner, 2.0 * std::numbers::pi, 0.0);
  fill(color);
}

void Sheet::sector(const Point& center, double inner, double outer, double from, double span,
                   const Color& color) {
  arc(center, outer, from, from + span);
  arc(center, inner, from + span, from);
  fill(color);
}

void Sheet::dashed_circle(const Point& center, double radius, double width, const Color& color) {
  const double dash = std::numbers::pi * radius / std::max(8, static_cast<int>(radius));
  cairo_set_dash(pen_.get(), &dash, 1, 0.0);
  cairo_new_path(pen_.get());
  arc(center, radius, 0.0, 2.0 * std::numbers::pi);
  stroke(width, color);
  cairo_set_dash(pen_.get(), nullptr, 0, 0.0);
}

void Sheet::convex(std::span<const Point> corners, const Color& color) {
  move_along(pen_.get(), corners);
  fill(color);
}

void Sheet::arrow(const Point& from, const Point& to, double width, const Color& color) {
  const Point along = to - from;
  const double length = along.norm();
  if (length < 1e-9) return;
  const Point unit = along / length;
  const Point across(-unit[1], unit[0]);
  const double head = std::min(3.2 * width, length);
  const Point neck = to - head * unit;
  if (length > head) bar(from, neck, width, color);
  const double half = 0.45 * head;
  const std::array<Point, 3> tip = {to, neck + half * across, neck - half * across};
  convex(tip, color);
}

double Sheet::text(double x, double y, std::string_view words, int size, const Color& color,
                   Weight weight) {
  cairo_set_source_rgba(pen_.get(), color.red, color.green, color.blue, color.alpha);
  return write_text(pen_.get(), words, x, std::round(y + 0.78 * size), size, weight);
}

double Sheet::text_width(std::string_view words, int size, Weight weight) const {
  return renders::text_width(words, size, weight);
}

void Sheet::text_to(double x, double y, std::string_view words, int size, const Color& color,
                    Weight weight) {
  text(x - text_width(words, size, weight), y, words, size, color, weight);
}

}  // namespace rotorub::renders
