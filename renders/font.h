// Letters as pictures: DejaVu Sans, which the program carries with it, drawn by FreeType.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace rotorub::renders {

// How much of each pixel a letter covers, 0 to 255; rows from the top.
struct Glyph {
  int width = 0, height = 0;  // pixels
  int left = 0, top = 0;      // from the pen to the left edge; from the baseline up to the top row
  double advance = 0.0;       // pixels to the next pen
  std::vector<std::uint8_t> coverage;
};

enum class Weight { kRegular, kBold };

// The letters met so far, by size. One thread at a time.
class Font {
 public:
  // Throws std::runtime_error with FreeType's error number.
  Font();
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  // `code`: Unicode; what the font lacks is drawn as its box. Pixels: height of the em, >= 1.
  const Glyph& glyph(char32_t code, int pixels, Weight weight);
  double width(std::string_view text, int pixels, Weight weight);  // pixels; text in UTF-8

 private:
  struct Faces;
  Glyph draw(char32_t code, int pixels, Weight weight);

  std::unique_ptr<Faces> faces_;
  std::map<std::pair<int, char32_t>, Glyph> glyphs_[2];
};

// The characters of UTF-8, U+FFFD for every byte that is none.
std::vector<char32_t> characters(std::string_view text);

}  // namespace rotorub::renders
