#include "renders/sheet.h"

#include <cairo-ft.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "native_model/trajectory/output.h"

namespace rotorub {
// Embedded by renders/CMakeLists.txt.
std::string_view font_regular();
std::string_view font_bold();
}  // namespace rotorub

namespace rotorub::renders {

namespace {

constexpr int kFadeSteps = 24;  // of a trail

void check(FT_Error error) {
  if (error != 0) throw std::runtime_error(fmt::format("the font: FreeType error {}", error));
}

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(std::string("the picture: ") + cairo_status_to_string(status));
}

// Cairo keeps references to its fonts, so they live as long as the program.
cairo_font_face_t* face_of(std::string_view file) {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  check(FT_Init_FreeType(&library));
  check(FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(file.data()),
                           static_cast<FT_Long>(file.size()), 0, &face));
  return cairo_ft_font_face_create_for_ft_face(face, FT_LOAD_TARGET_LIGHT);
}

// Cairo stops drawing after invalid UTF-8 or a Unicode noncharacter.
bool is_character(boost::locale::utf::code_point code) {
  return boost::locale::utf::is_valid_codepoint(code) && (code & 0xFFFE) != 0xFFFE &&
         !(code >= 0xFDD0 && code <= 0xFDEF);
}

// Replaces each byte that is not part of a character with U+FFFD.
std::string as_utf8(std::string_view text) {
  std::string all;
  for (const char *at = text.data(), *end = at + text.size(); at != end;) {
    const char* const begin = at;
    if (is_character(boost::locale::utf::utf_traits<char>::decode(at, end))) {
      all.append(begin, at);
    } else {
      all += "\uFFFD";
      at = begin + 1;
    }
  }
  return all;
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
  check(cairo_surface_status(surface()));
  Sheet(*this, {0, 0, width, height}).fill(0.0, 0.0, width, height, palette::kPaper);
}

int Picture::width() const { return cairo_image_surface_get_width(surface()); }
int Picture::height() const { return cairo_image_surface_get_height(surface()); }

std::span<const std::uint8_t> Picture::bytes() const {
  cairo_surface_flush(surface());
  return {cairo_image_surface_get_data(surface()),
          static_cast<std::size_t>(height() * cairo_image_surface_get_stride(surface()))};
}

std::array<std::uint8_t, 3> Picture::pixel(int column, int row) const {
  const std::uint8_t* at = bytes().data() + 4 * (row * width() + column);
  return {at[2], at[1], at[0]};
}

void Picture::put(const Area& area, const std::function<const std::uint8_t*(int row)>& row) {
  cairo_surface_flush(surface());
  for (int y = 0; y < area.height; ++y) {
    std::uint8_t* to =
        cairo_image_surface_get_data(surface()) + 4 * ((area.top + y) * width() + area.left);
    const std::uint8_t* from = row(y);
    for (int column = 0; column < area.width; ++column, from += 3, to += 4) {
      std::reverse_copy(from, from + 3, to);
    }
  }
  cairo_surface_mark_dirty(surface());
}

void Picture::write(const std::filesystem::path& file) const {
  const std::filesystem::path part = part_of(file);
  try {
    check(cairo_surface_write_to_png(surface(), part.c_str()));
    std::filesystem::rename(part, file);
  } catch (const std::runtime_error& problem) {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw std::runtime_error(fmt::format("{}: {}", file.string(), problem.what()));
  }
}

Sheet::Sheet(const Picture& picture, const Area& area)
    : picture_(&picture), area_(area), pen_(cairo_create(picture.surface()), cairo_destroy) {
  cairo_translate(pen_.get(), area.left, area.top);
  cairo_rectangle(pen_.get(), 0.0, 0.0, area.width, area.height);
  cairo_clip(pen_.get());
  cairo_set_line_join(pen_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(pen_.get(), CAIRO_LINE_CAP_ROUND);
  // Slight hinting keeps the widths of letters and aligns them only to pixel rows.
  cairo_font_options_t* const options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_SLIGHT);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_ON);
  cairo_set_font_options(pen_.get(), options);
  cairo_font_options_destroy(options);
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

// Angles are negated because y points down.
void Sheet::arc(const Point& center, double radius, double from, double to) {
  const auto draw = from < to ? cairo_arc_negative : cairo_arc;
  draw(pen_.get(), center[0], center[1], std::max(radius, 0.0), -from, -to);
}

void Sheet::show(const Picture& picture, double from, double to) {
  if (!(to > from)) return;
  cairo_set_source_surface(pen_.get(), picture.surface(), 0.0, 0.0);
  cairo_rectangle(pen_.get(), std::round(from), 0.0, std::round(to) - std::round(from),
                  picture.height());
  cairo_fill(pen_.get());
}

void Sheet::fill(double x, double y, double width, double height, const Color& color) {
  if (!(width > 0.0) || !(height > 0.0)) return;
  cairo_rectangle(pen_.get(), x, y, width, height);
  fill(color);
}

void Sheet::bar(const Point& from, const Point& to, double width, const Color& color) {
  const Point along = (to - from).normalized();
  const Point half = 0.5 * width * Point(-along[1], along[0]);
  const std::array<Point, 4> corners = {from + half, from - half, to - half, to + half};
  polygon(corners, color);
}

void Sheet::polyline(std::span<const Point> points, double width, const Color& color) {
  move_along(pen_.get(), points);
  stroke(width, color);
}

// Draws ever shorter end parts of the path on top of each other. Each is a single stroke, so that
// joints do not show.
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

void Sheet::polygon(std::span<const Point> corners, const Color& color) {
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
  polygon(tip, color);
}

void Sheet::use_font(int size, Weight weight) const {
  static cairo_font_face_t* const regular = face_of(font_regular());
  static cairo_font_face_t* const bold = face_of(font_bold());
  cairo_set_font_face(pen_.get(), weight == Weight::kBold ? bold : regular);
  cairo_set_font_size(pen_.get(), size);
}

double Sheet::text(double x, double y, std::string_view words, int size, const Color& color,
                   Weight weight) {
  use_font(size, weight);
  cairo_set_source_rgba(pen_.get(), color.red, color.green, color.blue, color.alpha);
  cairo_move_to(pen_.get(), x, std::round(y + 0.78 * size));
  cairo_show_text(pen_.get(), as_utf8(words).c_str());
  double baseline = 0.0;
  cairo_get_current_point(pen_.get(), &x, &baseline);
  cairo_new_path(pen_.get());
  return x;
}

double Sheet::text_width(std::string_view words, int size, Weight weight) const {
  use_font(size, weight);
  cairo_text_extents_t extents;
  cairo_text_extents(pen_.get(), as_utf8(words).c_str(), &extents);
  return extents.x_advance;
}

void Sheet::text_to(double x, double y, std::string_view words, int size, const Color& color,
                    Weight weight) {
  text(x - text_width(words, size, weight), y, words, size, color, weight);
}

}  // namespace rotorub::renders
