// Text as glyphs: HarfBuzz shapes a line (Greek accents, kerning), FreeType draws its glyphs into one 8-bit atlas.
// Without OpenGL.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::draw {

enum class Face : std::uint8_t { regular, bold, serif };

/// One glyph on the page: pixels from the line's start (x to the right, y down from the baseline) and its place in the
/// atlas (0..1).
struct PlacedGlyph {
  float x = 0, y = 0, width = 0, height = 0;
  float u0 = 0, v0 = 0, u1 = 0, v1 = 0;
};

/// One line of UTF-8 to be set at a size in pixels; invalid UTF-8 becomes the font's replacement character.
struct TextLine {
  Face face = Face::regular;
  int size_px = 16;
  std::string_view utf8;
};

struct SetLine {
  std::vector<PlacedGlyph> glyphs;  ///< without spaces
  float width = 0;                  ///< how far the pen moved, pixels
  int missing = 0;                  ///< characters that the font does not have
};

/// Called from one thread.
class Typesetter {
 public:
  /// `most_side`: the graphics card's largest atlas, pixels. Errors: a font of DejaVu (package fonts-dejavu-core) is
  /// not in the folder, or is not a font.
  [[nodiscard]] static Expected<std::unique_ptr<Typesetter>> create(const std::string& font_folder,
                                                                    std::uint32_t most_side = kLeastSide);
  virtual ~Typesetter() = default;

  /// Sets all lines of a picture. Their places in the atlas are valid until the next call. When the atlas is full,
  /// glyphs of earlier pictures are evicted; when this picture's glyphs alone need more room, it grows. Glyphs are left
  /// out only at `most_side`.
  [[nodiscard]] virtual std::vector<SetLine> set_lines(std::span<const TextLine> lines) = 0;
  /// Only the width, without drawing glyphs.
  [[nodiscard]] virtual float width(Face face, int size_px, std::string_view utf8) = 0;

  /// The atlas's first side, which every OpenGL supports.
  static constexpr std::uint32_t kLeastSide = 1024;
  /// Pixels along a side of the atlas, now.
  [[nodiscard]] virtual std::uint32_t atlas_side() const = 0;
  [[nodiscard]] virtual const std::vector<std::uint8_t>& atlas() const = 0;
  /// Changes whenever the atlas does.
  [[nodiscard]] virtual std::uint64_t atlas_revision() const = 0;
};

/// The folder in which the build found DejaVu.
[[nodiscard]] std::string default_font_folder();

}  // namespace mechane::draw
