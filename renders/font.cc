#include "renders/font.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

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

}  // namespace

struct Font::Faces {
  FT_Library library = nullptr;
  FT_Face face[2] = {nullptr, nullptr};  // by Weight

  Faces() {
    check(FT_Init_FreeType(&library));
    const std::string_view files[] = {font_regular(), font_bold()};
    for (int k = 0; k < 2; ++k) {
      const std::string_view file = files[k];
      check(FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(file.data()),
                               static_cast<FT_Long>(file.size()), 0, &face[k]));
    }
  }
  ~Faces() { FT_Done_FreeType(library); }  // with its faces
  Faces(const Faces&) = delete;
  Faces& operator=(const Faces&) = delete;
};

Font::Font() : faces_(std::make_unique<Faces>()) {}
Font::~Font() = default;

Glyph Font::draw(char32_t code, int pixels, Weight weight) {
  const FT_Face face = faces_->face[static_cast<int>(weight)];
  check(FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(pixels)));
  // Light: shapes keep their widths and snap to rows alone.
  check(FT_Load_Char(face, code, FT_LOAD_RENDER | FT_LOAD_TARGET_LIGHT));
  const FT_GlyphSlot slot = face->glyph;
  Glyph glyph;
  glyph.width = static_cast<int>(slot->bitmap.width);
  glyph.height = static_cast<int>(slot->bitmap.rows);
  glyph.left = slot->bitmap_left;
  glyph.top = slot->bitmap_top;
  glyph.advance = static_cast<double>(slot->advance.x) / 64.0;
  for (int row = 0; row < glyph.height; ++row) {
    const std::uint8_t* const from = slot->bitmap.buffer + row * slot->bitmap.pitch;
    glyph.coverage.insert(glyph.coverage.end(), from, from + glyph.width);
  }
  return glyph;
}

const Glyph& Font::glyph(char32_t code, int pixels, Weight weight) {
  auto& known = glyphs_[static_cast<int>(weight)];
  const std::pair key{pixels, code};
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known.emplace(key, draw(code, pixels, weight)).first->second;
}

double Font::width(std::string_view text, int pixels, Weight weight) {
  double width = 0.0;
  for (const char32_t code : characters(text)) width += glyph(code, pixels, weight).advance;
  return width;
}

std::vector<char32_t> characters(std::string_view text) {
  std::vector<char32_t> all;
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = [&](std::size_t k) {
      return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
    };
    const unsigned first = byte(at);
    const std::size_t more = first < 0x80 ? 0 : first >> 5 == 6 ? 1 : first >> 4 == 14 ? 2 : first >> 3 == 30 ? 3 : 9;
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
