#include "picture/font.h"

#if GLOAM_FREETYPE
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H
#include <mutex>
#endif
#include <algorithm>
#include <cmath>
#include <string>

namespace gloam {

const std::vector<FontFiles>& known_fonts() {
  static const std::vector<FontFiles> fonts = [] {
    std::vector<FontFiles> all;
    for (const std::string folder : {"truetype/dejavu", "dejavu", "dejavu-sans-fonts", "TTF"}) {
      const std::string path = "/usr/share/fonts/" + folder + "/DejaVuSans";
      all.push_back({path + ".ttf", path + "-Bold.ttf"});
    }
    for (const std::string folder : {"truetype/liberation", "liberation", "liberation-sans"}) {
      const std::string path = "/usr/share/fonts/" + folder + "/LiberationSans-";
      all.push_back({path + "Regular.ttf", path + "Bold.ttf"});
    }
    return all;
  }();
  return fonts;
}

#if GLOAM_FREETYPE
namespace {

/// Coverage of a pixel that one letter covers and another reaches into.
void add_letter(cv::Mat& coverage, const FT_Bitmap& letter, cv::Point corner) {
  for (int y = 0; y < int(letter.rows); ++y)
    for (int x = 0; x < int(letter.width); ++x) {
      const cv::Point at = corner + cv::Point(x, y);
      if (!at.inside(cv::Rect({}, coverage.size()))) continue;
      unsigned char& pixel = coverage.at<unsigned char>(at);
      pixel = cv::saturate_cast<unsigned char>(pixel + letter.buffer[y * letter.pitch + x]);
    }
}

class FontLetters : public Letters {
 public:
  FontLetters() { failed_ = FT_Init_FreeType(&library_) != 0; }
  ~FontLetters() override {
    if (library_) FT_Done_FreeType(library_);  // with its faces
  }

  bool open(const FontFiles& files) { return !failed_ && is_open(files.plain, plain_) && is_open(files.bold, bold_); }

  bool has(char32_t character) const override {
    const std::lock_guard lock(mutex_);
    return character >= 32 && FT_Get_Char_Index(plain_, character) != 0 && FT_Get_Char_Index(bold_, character) != 0;
  }

  double width(const std::u32string& text, double size, bool bold) const override {
    const std::lock_guard lock(mutex_);
    return pen_positions(bold ? bold_ : plain_, text).back() * size;
  }

  void draw(cv::Mat& coverage, const std::u32string& text, cv::Point start, double size, bool bold) const override {
    const std::lock_guard lock(mutex_);
    const FT_Face face = bold ? bold_ : plain_;
    const double em = size / capitals(face);
    if (FT_Set_Char_Size(face, 0, FT_F26Dot6(std::lround(em * 64)), 72, 72) != 0) return;
    const std::vector<double> positions = pen_positions(face, text);
    for (size_t i = 0; i < text.size(); ++i) draw_letter(coverage, face, text[i], start, positions[i] * size);
  }

 private:
  bool is_open(const std::filesystem::path& file, FT_Face& face) {
    return FT_New_Face(library_, file.c_str(), 0, &face) == 0 && FT_IS_SCALABLE(face) && capitals(face) > 0;
  }

  /// Height of capitals, of the size of the font.
  static double capitals(FT_Face face) {
    const auto* table = static_cast<const TT_OS2*>(FT_Get_Sfnt_Table(face, FT_SFNT_OS2));
    if (table && table->version >= 2 && table->sCapHeight > 0) return double(table->sCapHeight) / face->units_per_EM;
    return FT_Load_Char(face, 'H', FT_LOAD_NO_SCALE) == 0 ? double(face->glyph->metrics.height) / face->units_per_EM
                                                          : 0;
  }

  /// Where each letter begins, and where the last one ends, for capitals that are 1 high.
  static std::vector<double> pen_positions(FT_Face face, const std::u32string& text) {
    std::vector<double> positions{0};
    FT_UInt before = 0;
    long pen = 0;
    const double unit = 1 / (face->units_per_EM * capitals(face));
    for (const char32_t character : text) {
      const FT_UInt letter = FT_Get_Char_Index(face, character);
      FT_Vector kerning{};
      if (before != 0) FT_Get_Kerning(face, before, letter, FT_KERNING_UNSCALED, &kerning);
      positions.back() += double(kerning.x) * unit;
      if (FT_Load_Glyph(face, letter, FT_LOAD_NO_SCALE) == 0) pen = face->glyph->metrics.horiAdvance;
      positions.push_back(positions.back() + double(pen) * unit);
      before = letter;
    }
    return positions;
  }

  /// Letters are hinted vertically only, and may begin anywhere in a pixel.
  static void draw_letter(cv::Mat& coverage, FT_Face face, char32_t character, cv::Point start, double pen) {
    if (FT_Load_Char(face, character, FT_LOAD_NO_BITMAP | FT_LOAD_TARGET_LIGHT) != 0) return;
    const FT_GlyphSlot slot = face->glyph;
    FT_Outline_Translate(&slot->outline, FT_Pos(std::lround((pen - std::floor(pen)) * 64)), 0);
    if (FT_Render_Glyph(slot, FT_RENDER_MODE_NORMAL) != 0) return;
    add_letter(coverage, slot->bitmap, start + cv::Point(int(std::floor(pen)) + slot->bitmap_left, -slot->bitmap_top));
  }

  FT_Library library_ = nullptr;
  FT_Face plain_ = nullptr, bold_ = nullptr;
  bool failed_ = false;
  mutable std::mutex mutex_;  ///< a face is for one thread at a time
};

}  // namespace

std::unique_ptr<Letters> font_letters(const std::vector<FontFiles>& fonts) {
  auto letters = std::make_unique<FontLetters>();
  const bool is_found = std::any_of(fonts.begin(), fonts.end(), [&](const FontFiles& f) { return letters->open(f); });
  return is_found ? std::move(letters) : nullptr;
}
#else
std::unique_ptr<Letters> font_letters(const std::vector<FontFiles>&) { return nullptr; }
#endif

}  // namespace gloam
