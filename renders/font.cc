#include "renders/font.h"

#include <cairo-ft.h>
#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace rotorub {
// Embedded by renders/CMakeLists.txt.
std::string_view font_regular();
std::string_view font_bold();
}  // namespace rotorub

namespace rotorub::renders {

namespace {

constexpr char32_t kReplacement = 0xFFFD;

void check(FT_Error error) {
  if (error != 0) throw std::runtime_error(fmt::format("the font: FreeType error {}", error));
}

// Cairo keeps what it has drawn with, and so they are kept as long as the program runs.
cairo_font_face_t* face_of(std::string_view file) {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  check(FT_Init_FreeType(&library));
  check(FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(file.data()),
                           static_cast<FT_Long>(file.size()), 0, &face));
  return cairo_ft_font_face_create_for_ft_face(face, FT_LOAD_TARGET_LIGHT);
}

cairo_font_face_t* face_of(Weight weight) {
  static cairo_font_face_t* const regular = face_of(font_regular());
  static cairo_font_face_t* const bold = face_of(font_bold());
  return weight == Weight::kBold ? bold : regular;
}

}  // namespace

double write_text(_cairo* pen, std::string_view text, double x, double y, int pixels,
                  Weight weight) {
  cairo_matrix_t size, pixel;
  cairo_matrix_init_scale(&size, pixels, pixels);
  cairo_matrix_init_identity(&pixel);
  // Light: shapes keep their widths and snap to rows alone.
  cairo_font_options_t* const options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_SLIGHT);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_ON);
  cairo_scaled_font_t* const font =
      cairo_scaled_font_create(face_of(weight), &size, &pixel, options);
  cairo_font_options_destroy(options);
  std::vector<cairo_glyph_t> glyphs;
  const FT_Face face = cairo_ft_scaled_font_lock_face(font);
  for (const char32_t code : characters(text)) {
    glyphs.push_back({FT_Get_Char_Index(face, code), 0.0, y});
  }
  cairo_ft_scaled_font_unlock_face(font);
  for (cairo_glyph_t& glyph : glyphs) {
    cairo_text_extents_t extents;
    cairo_scaled_font_glyph_extents(font, &glyph, 1, &extents);
    glyph.x = x;
    x += extents.x_advance;
  }
  if (pen != nullptr) {
    cairo_set_scaled_font(pen, font);
    cairo_show_glyphs(pen, glyphs.data(), static_cast<int>(glyphs.size()));
  }
  cairo_scaled_font_destroy(font);
  return x;
}

double text_width(std::string_view text, int pixels, Weight weight) {
  return write_text(nullptr, text, 0.0, 0.0, pixels, weight);
}

std::vector<char32_t> characters(std::string_view text) {
  std::vector<char32_t> all;
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t k) {
      return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
    };
    const unsigned first = byte(at);
    const std::size_t more = first < 0x80       ? 0
                             : first >> 5 == 6  ? 1
                             : first >> 4 == 14 ? 2
                             : first >> 3 == 30 ? 3
                                                : 9;
    char32_t code = more == 0 ? first : first & (0x3FU >> more);
    bool whole = more <= 3;
    for (std::size_t k = 1; whole && k <= more; ++k) {
      whole = byte(at + k) >> 6 == 2;
      code = code << 6 | (byte(at + k) & 0x3FU);
    }
    all.push_back(whole ? code : kReplacement);
    at += whole ? more + 1 : 1;
  }
  return all;
}

}  // namespace rotorub::renders
