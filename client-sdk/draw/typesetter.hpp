// Text as glyphs: HarfBuzz shapes a line (Greek accents, kerning), FreeType draws its glyphs into one 8-bit atlas. No OpenGL here.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::draw {

enum class Face : std::uint8_t { regular, bold, serif };

/// One glyph on the page: pixels from the line's start (x to the right, y down from the baseline) and its place in the atlas (0..1).
struct PlacedGlyph {
  float x = 0, y = 0, width = 0, height = 0;
  float u0 = 0, v0 = 0, u1 = 0, v1 = 0;
};

struct SetLine {
  std::vector<PlacedGlyph> glyphs;  ///< blanks are left out
  float width = 0;                  ///< how far the pen moved, pixels
  int missing = 0;                  ///< characters that the font does not have
};

/// Called from one thread.
class Typesetter {
 public:
  /// Errors: a font of DejaVu (package fonts-dejavu-core) is not in the folder, or is not a font.
  [[nodiscard]] static Expected<std::unique_ptr<Typesetter>> create(const std::string& font_folder);
  virtual ~Typesetter() = default;

  /// Sets one line of UTF-8 at a size in pixels; broken UTF-8 comes out as the font's replacement character.
  [[nodiscard]] virtual SetLine set_line(Face face, int size_px, std::string_view utf8) = 0;
  /// Width alone, without drawing glyphs.
  [[nodiscard]] virtual float width(Face face, int size_px, std::string_view utf8) = 0;

  static constexpr std::uint32_t kAtlasSide = 1024;
  [[nodiscard]] virtual const std::vector<std::uint8_t>& atlas() const = 0;
  /// Grows with each glyph that is new in the atlas.
  [[nodiscard]] virtual std::uint64_t atlas_revision() const = 0;
};

/// The folder that the build found DejaVu in.
[[nodiscard]] std::string default_font_folder();

}  // namespace mechane::draw
