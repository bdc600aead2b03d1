#include "client-sdk/draw/text/typesetter.hpp"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include <hb-ft.h>
#include <hb.h>

#include "server/base/assert.hpp"

namespace mechane::draw {
namespace {

constexpr std::array<const char*, 3> kFiles{"DejaVuSans.ttf", "DejaVuSans-Bold.ttf", "DejaVuSerif.ttf"};
constexpr float kSixtyFourths = 1.0F / 64.0F;

struct FaceCloser {
  void operator()(FT_Face face) const { FT_Done_Face(face); }
};
struct FontCloser {
  void operator()(hb_font_t* font) const { hb_font_destroy(font); }
};
struct BufferCloser {
  void operator()(hb_buffer_t* buffer) const { hb_buffer_destroy(buffer); }
};
struct LibraryCloser {
  void operator()(FT_Library library) const { FT_Done_FreeType(library); }
};

struct AtlasPlace {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
  int left = 0, top = 0;
};

/// Packs rectangles into the atlas in rows, from the top down.
class AtlasShelves {
 public:
  /// False when the atlas is full.
  bool place(std::uint32_t width, std::uint32_t height, std::uint32_t side, AtlasPlace& out) {
    if (x_ + width + 1 > side) {
      x_ = 1;
      y_ += shelf_ + 1;
      shelf_ = 0;
    }
    if (y_ + height + 1 > side || width + 2 > side) return false;
    out.x = x_;
    out.y = y_;
    x_ += width + 1;
    shelf_ = std::max(shelf_, height);
    return true;
  }
  void clear() { *this = {}; }

 private:
  std::uint32_t x_ = 1, y_ = 1, shelf_ = 0;
};

class FreeTypeTypesetter final : public Typesetter {
 public:
  explicit FreeTypeTypesetter(std::uint32_t most_side) : most_side_(std::max(most_side, kLeastSide)) {}

  Expected<void> open(const std::string& folder) {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0)
      return fail(ErrorCode::not_supported, "FreeType did not start", "display, text", "reinstall libfreetype6");
    library_.reset(library);
    for (std::size_t i = 0; i < kFiles.size(); ++i) {
      const std::string path = folder + "/" + kFiles[i];
      FT_Face face = nullptr;
      if (const FT_Error error = FT_New_Face(library, path.c_str(), 0, &face); error != 0) {
        const bool there = error != FT_Err_Cannot_Open_Resource;
        return fail(there ? ErrorCode::damaged : ErrorCode::not_found,
                    there ? "the file is not a font" : "the font is missing", path,
                    "install fonts-dejavu-core, or name its folder with --fonts");
      }
      faces_[i].reset(face);
      FT_Set_Pixel_Sizes(face, 0, 16);
      fonts_[i].reset(hb_ft_font_create_referenced(face));
      hb_ft_font_set_load_flags(fonts_[i].get(), FT_LOAD_NO_HINTING);
    }
    return {};
  }

  std::vector<SetLine> set_lines(std::span<const TextLine> lines) override {
    std::optional<std::vector<SetLine>> set = try_set(lines);
    if (set) return *set;
    evict(side_);
    while (!(set = try_set(lines)) && side_ < most_side_)
      evict(std::min(2 * side_, most_side_));
    if (set) return *set;
    leaves_out_ = true;
    set = try_set(lines);
    leaves_out_ = false;
    return *set;
  }

  float width(Face face, int size_px, std::string_view utf8) override {
    shape(face, size_px, utf8);
    unsigned count = 0;
    const hb_glyph_position_t* positions = hb_buffer_get_glyph_positions(buffer_.get(), &count);
    float pen = 0;
    for (unsigned i = 0; i < count; ++i)
      pen += static_cast<float>(positions[i].x_advance) * kSixtyFourths;
    return pen;
  }

  [[nodiscard]] std::uint32_t atlas_side() const override { return side_; }
  [[nodiscard]] const std::vector<std::uint8_t>& atlas() const override { return atlas_; }
  [[nodiscard]] std::uint64_t atlas_revision() const override { return revision_; }

 private:
  using GlyphKey = std::tuple<Face, int, std::uint32_t>;

  void set_size(Face face, int size_px) {
    const auto i = static_cast<std::size_t>(face);
    if (faces_[i]->size->metrics.y_ppem == size_px) return;
    FT_Set_Pixel_Sizes(faces_[i].get(), 0, static_cast<FT_UInt>(size_px));
    hb_ft_font_changed(fonts_[i].get());
  }

  void shape(Face face, int size_px, std::string_view utf8) {
    MECHANE_ASSERT(size_px > 0 && size_px < 400);
    set_size(face, size_px);
    hb_buffer_clear_contents(buffer_.get());
    hb_buffer_add_utf8(buffer_.get(), utf8.data(), static_cast<int>(utf8.size()), 0, -1);
    hb_buffer_guess_segment_properties(buffer_.get());
    hb_shape(fonts_[static_cast<std::size_t>(face)].get(), buffer_.get(), nullptr, 0);
  }

  /// Nothing: the atlas is full.
  std::optional<std::vector<SetLine>> try_set(std::span<const TextLine> lines) {
    std::vector<SetLine> out;
    out.reserve(lines.size());
    for (const TextLine& line : lines) {
      std::optional<SetLine> set = set_line(line);
      if (!set) return std::nullopt;
      out.push_back(std::move(*set));
    }
    return out;
  }

  std::optional<SetLine> set_line(const TextLine& text) {
    SetLine line;
    shape(text.face, text.size_px, text.utf8);
    unsigned count = 0;
    const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer_.get(), &count);
    const hb_glyph_position_t* positions = hb_buffer_get_glyph_positions(buffer_.get(), &count);
    const auto side = static_cast<float>(side_);
    float pen = 0;
    for (unsigned i = 0; i < count; ++i) {
      if (infos[i].codepoint == 0) ++line.missing;
      const std::optional<AtlasPlace> place = glyph(text.face, text.size_px, infos[i].codepoint);
      if (!place && !leaves_out_) return std::nullopt;
      if (place && place->width > 0) {
        // Whole pixels keep stems sharp.
        const float x = std::round(pen + static_cast<float>(positions[i].x_offset) * kSixtyFourths) +
                        static_cast<float>(place->left);
        const float y =
            -std::round(static_cast<float>(positions[i].y_offset) * kSixtyFourths) - static_cast<float>(place->top);
        line.glyphs.push_back({x, y, static_cast<float>(place->width), static_cast<float>(place->height),
                               static_cast<float>(place->x) / side, static_cast<float>(place->y) / side,
                               static_cast<float>(place->x + place->width) / side,
                               static_cast<float>(place->y + place->height) / side});
      }
      pen += static_cast<float>(positions[i].x_advance) * kSixtyFourths;
    }
    line.width = pen;
    return line;
  }

  /// None: the atlas is full. A space has a place of width 0.
  std::optional<AtlasPlace> glyph(Face face, int size_px, std::uint32_t index) {
    const GlyphKey key{face, size_px, index};
    if (const auto found = places_.find(key); found != places_.end()) return found->second;
    FT_Face font = faces_[static_cast<std::size_t>(face)].get();
    AtlasPlace place;
    if (FT_Load_Glyph(font, index, FT_LOAD_RENDER | FT_LOAD_NO_HINTING) == 0) {
      const FT_Bitmap& bitmap = font->glyph->bitmap;
      if (bitmap.width > 0) {
        if (!shelves_.place(bitmap.width, bitmap.rows, side_, place)) return std::nullopt;
        place.width = bitmap.width;
        place.height = bitmap.rows;
        place.left = font->glyph->bitmap_left;
        place.top = font->glyph->bitmap_top;
        copy(bitmap, place);
      }
    }
    places_.emplace(key, place);
    return place;
  }

  /// Removes all glyphs and sets the atlas's side.
  void evict(std::uint32_t side) {
    places_.clear();
    shelves_.clear();
    side_ = side;
    atlas_.assign(std::size_t{side} * side, 0);
    ++revision_;
  }

  void copy(const FT_Bitmap& bitmap, const AtlasPlace& place) {
    for (std::uint32_t row = 0; row < bitmap.rows; ++row) {
      const std::uint8_t* from = bitmap.buffer + static_cast<std::ptrdiff_t>(row) * bitmap.pitch;
      std::copy_n(from, bitmap.width, atlas_.begin() + static_cast<std::ptrdiff_t>(place.y + row) * side_ + place.x);
    }
    ++revision_;
  }

  std::unique_ptr<std::remove_pointer_t<FT_Library>, LibraryCloser> library_;
  std::array<std::unique_ptr<std::remove_pointer_t<FT_Face>, FaceCloser>, 3> faces_;
  std::array<std::unique_ptr<hb_font_t, FontCloser>, 3> fonts_;
  std::unique_ptr<hb_buffer_t, BufferCloser> buffer_{hb_buffer_create()};
  std::map<GlyphKey, AtlasPlace> places_;
  AtlasShelves shelves_;
  std::uint32_t most_side_;
  std::uint32_t side_ = kLeastSide;
  bool leaves_out_ = false;  ///< leave out glyphs that do not fit: the atlas cannot grow any more
  std::vector<std::uint8_t> atlas_ = std::vector<std::uint8_t>(std::size_t{kLeastSide} * kLeastSide);
  std::uint64_t revision_ = 1;
};

}  // namespace

Expected<std::unique_ptr<Typesetter>> Typesetter::create(const std::string& font_folder, std::uint32_t most_side) {
  auto typesetter = std::make_unique<FreeTypeTypesetter>(most_side);
  if (auto ok = typesetter->open(font_folder); !ok) return tl::unexpected(ok.error());
  return typesetter;
}

std::string default_font_folder() {
  return MECHANE_FONT_FOLDER;
}

}  // namespace mechane::draw
