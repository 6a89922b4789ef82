#include "renders/sheet.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace rotorub::renders {

namespace {

// A pixel's share of what has a straight edge at this distance from its middle, inside positive.
double inside(double distance) { return std::clamp(distance + 0.5, 0.0, 1.0); }

// Length that [a, a + 1) and [from, to) share.
double overlap(double a, double from, double to) {
  return std::max(0.0, std::min(a + 1.0, to) - std::max(a, from));
}

// A line with round ends: its cover of the pixel around a point, and the box it lies in.
struct Stroke {
  Sheet::Point from, along;
  double square, half;
  double left, top, right, bottom;

  Stroke(const Sheet::Point& a, const Sheet::Point& b, double width)
      : from(a), along(b - a), square(std::max(along.squaredNorm(), 1e-12)), half(0.5 * width),
        left(std::min(a[0], b[0]) - half - 1.0), top(std::min(a[1], b[1]) - half - 1.0),
        right(std::max(a[0], b[0]) + half + 1.0), bottom(std::max(a[1], b[1]) + half + 1.0) {}

  double operator()(double x, double y) const {
    const double dx = x - from[0], dy = y - from[1];
    const double s = std::clamp((dx * along[0] + dy * along[1]) / square, 0.0, 1.0);
    const double ex = dx - s * along[0], ey = dy - s * along[1];
    return inside(half - std::sqrt(ex * ex + ey * ey));
  }
};

void blend(std::uint8_t* pixel, const float (&color)[3], double share) {
  for (int k = 0; k < 3; ++k) {
    const double value = pixel[k] + share * (static_cast<double>(color[k]) - pixel[k]);
    pixel[k] = static_cast<std::uint8_t>(value + 0.5);
  }
}

}  // namespace

Sheet::Sheet(Image& picture, Font& font, const Area& area)
    : picture_(&picture), font_(&font), area_(area) {}

template <class Coverage>
void Sheet::shade(double left, double top, double right, double bottom, const Color& color,
                  const Coverage& coverage) {
  const auto column = [&](double x) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(area_.width)));
  };
  const auto row = [&](double y) {
    return static_cast<int>(std::clamp(y, 0.0, static_cast<double>(area_.height)));
  };
  const int first = column(std::floor(left)), last = column(std::ceil(right));
  const int end = row(std::ceil(bottom));
  const float rgb[3] = {255.0F * color.red, 255.0F * color.green, 255.0F * color.blue};
  const double alpha = static_cast<double>(color.alpha);
  for (int y = row(std::floor(top)); y < end; ++y) {
    std::uint8_t* pixel =
        picture_->rgb.data() + 3 * (static_cast<std::size_t>(area_.top + y) *
                                        static_cast<std::size_t>(picture_->width) +
                                    static_cast<std::size_t>(area_.left + first));
    for (int x = first; x < last; ++x, pixel += 3) {
      const double share = alpha * coverage(x + 0.5, y + 0.5);
      if (share > 0.0) blend(pixel, rgb, share);
    }
  }
}

void Sheet::fill(double x, double y, double width, double height, const Color& color) {
  const auto cover = [&](double column, double row) {
    return overlap(column - 0.5, x, x + width) * overlap(row - 0.5, y, y + height);
  };
  const double right = x + width, bottom = y + height;
  const double first = std::ceil(std::max(0.0, x));
  const double last = std::floor(std::min(right, static_cast<double>(area_.width)));
  if (color.alpha < 1.0F || !(last > first)) return shade(x, y, right, bottom, color, cover);
  // Whole pixels of whole rows are set; the edges are shaded.
  const double top = std::ceil(std::max(0.0, y));
  const double end = std::floor(std::min(bottom, static_cast<double>(area_.height)));
  shade(x, y, right, std::min(top, bottom), color, cover);
  for (double row = top; row < end; ++row) set(static_cast<int>(row), static_cast<int>(first), static_cast<int>(last), color);
  shade(x, top, first, end, color, cover);
  shade(last, top, right, end, color, cover);
  shade(x, std::max(top, end), right, bottom, color, cover);
}

void Sheet::set(int row, int first, int last, const Color& color) {
  const auto value = [](float part) { return static_cast<std::uint8_t>(255.0F * part + 0.5F); };
  const std::uint8_t rgb[3] = {value(color.red), value(color.green), value(color.blue)};
  std::uint8_t* pixel = picture_->rgb.data() +
                        3 * (static_cast<std::size_t>(area_.top + row) *
                                 static_cast<std::size_t>(picture_->width) +
                             static_cast<std::size_t>(area_.left + first));
  std::uint8_t* const end = pixel + 3 * (last - first);
  for (; pixel != end; pixel += 3) std::copy(rgb, rgb + 3, pixel);
}

void Sheet::line(const Point& from, const Point& to, double width, const Color& color) {
  const Stroke stroke(from, to, width);
  shade(stroke.left, stroke.top, stroke.right, stroke.bottom, color, stroke);
}

void Sheet::bar(const Point& from, const Point& to, double width, const Color& color) {
  const Point along = (to - from).normalized();
  const Point half = 0.5 * width * Point(-along[1], along[0]);
  const std::array<Point, 4> corners = {from + half, from - half, to - half, to + half};
  convex(corners, color);
}

// The strokes' strongest cover counts once, so that joints are no beads.
void Sheet::trail(std::span<const Point> points, double width, const Color& color,
                  double longest) {
  if (points.size() < 2) return;
  Eigen::AlignedBox2d box;
  for (const Point& point : points) box.extend(point);
  const double reach = width + 2.0;
  const auto clamped = [&](double x, int most) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most)));
  };
  const int left = clamped(std::floor(box.min()[0] - reach), area_.width);
  const int right = clamped(std::ceil(box.max()[0] + reach), area_.width);
  const int top = clamped(std::floor(box.min()[1] - reach), area_.height);
  const int bottom = clamped(std::ceil(box.max()[1] + reach), area_.height);
  if (left >= right || top >= bottom) return;
  const auto wide = static_cast<std::size_t>(right - left);
  std::vector<float> cover(wide * static_cast<std::size_t>(bottom - top), 0.0F);
  const auto at = [&](int x, int y) -> float& {
    return cover[static_cast<std::size_t>(y - top) * wide + static_cast<std::size_t>(x - left)];
  };
  const auto last = static_cast<double>(points.size() - 1);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if ((points[i + 1] - points[i]).norm() > longest) continue;
    const double strength = 0.1 + 0.9 * static_cast<double>(i + 1) / last;
    const Stroke stroke(points[i], points[i + 1], width);
    for (int y = std::max(top, static_cast<int>(stroke.top)); y < std::min<double>(bottom, stroke.bottom); ++y) {
      for (int x = std::max(left, static_cast<int>(stroke.left)); x < std::min<double>(right, stroke.right); ++x) {
        float& most = at(x, y);
        most = std::max(most, static_cast<float>(strength * stroke(x + 0.5, y + 0.5)));
      }
    }
  }
  shade(left, top, right, bottom, color, [&](double x, double y) {
    return static_cast<double>(at(static_cast<int>(x), static_cast<int>(y)));
  });
}

void Sheet::polyline(std::span<const Point> points, double width, const Color& color) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) line(points[i], points[i + 1], width, color);
}

void Sheet::disc(const Point& center, double radius, const Color& color) {
  ring(center, -1.0, radius, color);
}

void Sheet::ring(const Point& center, double inner, double outer, const Color& color) {
  const double reach = outer + 1.0;
  shade(center[0] - reach, center[1] - reach, center[0] + reach, center[1] + reach, color,
        [&](double x, double y) {
          const double dx = x - center[0], dy = y - center[1];
          const double r = std::sqrt(dx * dx + dy * dy);
          return inside(std::min(outer - r, r - inner));
        });
}

void Sheet::sector(const Point& center, double inner, double outer, double from, double span,
                   const Color& color) {
  // Left of the edge where it begins, right of the one where it ends; y counts down.
  const Point begin(std::cos(from), -std::sin(from));
  const Point end(std::cos(from + span), -std::sin(from + span));
  const double reach = outer + 1.0;
  shade(center[0] - reach, center[1] - reach, center[0] + reach, center[1] + reach, color,
        [&](double x, double y) {
          const double dx = x - center[0], dy = y - center[1];
          const double r = std::sqrt(dx * dx + dy * dy);
          const double after = begin[1] * dx - begin[0] * dy;
          const double before = end[0] * dy - end[1] * dx;
          return inside(std::min({outer - r, r - inner, after, before}));
        });
}

void Sheet::dashed_circle(const Point& center, double radius, double width, const Color& color) {
  const int dashes = std::max(8, static_cast<int>(radius));
  const auto at = [&](int half) {
    const double angle = std::numbers::pi * half / dashes;
    return Point(center[0] + radius * std::cos(angle), center[1] - radius * std::sin(angle));
  };
  for (int k = 0; k < dashes; ++k) line(at(2 * k), at(2 * k + 1), width, color);
}

void Sheet::convex(std::span<const Point> corners, const Color& color) {
  Eigen::AlignedBox2d box;
  Point middle = Point::Zero();
  for (const Point& corner : corners) {
    box.extend(corner);
    middle += corner / static_cast<double>(corners.size());
  }
  // Unit normals inwards.
  std::array<Point, 8> normals;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point edge = corners[(i + 1) % corners.size()] - corners[i];
    Point normal(-edge[1], edge[0]);
    normal /= std::max(normal.norm(), 1e-12);
    normals[i] = normal.dot(middle - corners[i]) < 0.0 ? Point(-normal) : normal;
  }
  shade(box.min()[0] - 1.0, box.min()[1] - 1.0, box.max()[0] + 1.0, box.max()[1] + 1.0, color,
        [&](double x, double y) {
          double least = 1e300;
          for (std::size_t i = 0; i < corners.size(); ++i) {
            least = std::min(least, normals[i][0] * (x - corners[i][0]) +
                                        normals[i][1] * (y - corners[i][1]));
          }
          return inside(least);
        });
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
  const double baseline = std::round(y + 0.78 * size);
  for (const char32_t code : characters(words)) {
    const Glyph& glyph = font_->glyph(code, size, weight);
    const int left = static_cast<int>(std::lround(x)) + glyph.left;
    const int top = static_cast<int>(baseline) - glyph.top;
    shade(left, top, left + glyph.width, top + glyph.height, color, [&](double column, double row) {
      const int index = (static_cast<int>(row) - top) * glyph.width + static_cast<int>(column) - left;
      return glyph.coverage[static_cast<std::size_t>(index)] / 255.0;
    });
    x += glyph.advance;
  }
  return x;
}

double Sheet::text_width(std::string_view words, int size, Weight weight) const {
  return font_->width(words, size, weight);
}

void Sheet::text_to(double x, double y, std::string_view words, int size, const Color& color,
                    Weight weight) {
  text(x - text_width(words, size, weight), y, words, size, color, weight);
}

}  // namespace rotorub::renders
