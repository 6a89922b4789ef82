// Letters: DejaVu Sans, which the program carries with it, read by FreeType and drawn by Cairo.
#pragma once

#include <string_view>
#include <vector>

struct _cairo;  // Cairo's cairo_t

namespace rotorub::renders {

enum class Weight { kRegular, kBold };

// Draws UTF-8 from x on the baseline y in the pen's colour; returns the x behind it. What the font
// lacks is its box. Pixels: height of the em, >= 1. pen: null: measures alone. From any thread.
// Throws std::runtime_error with FreeType's error number.
double write_text(_cairo* pen, std::string_view text, double x, double y, int pixels,
                  Weight weight);
double text_width(std::string_view text, int pixels, Weight weight);  // pixels

// The characters of UTF-8, U+FFFD for every byte that is none.
std::vector<char32_t> characters(std::string_view text);

}  // namespace rotorub::renders
