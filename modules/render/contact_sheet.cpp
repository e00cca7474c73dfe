#include "modules/render/contact_sheet.hpp"

#include <fmt/format.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>

#include "modules/render/offscreen_window.hpp"
#include "modules/render/png.hpp"

namespace atrium::render {
namespace {

constexpr int gap = 12;

/// Shrinks by averaging the pixels under each new one (box filter).
Picture shrunk(const Picture& picture, int width, int height) {
  Picture result{width, height, picture.caption, {}};
  result.pixels.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto span = [](int i, int size, int full) {
    const int begin = static_cast<int>(static_cast<std::int64_t>(i) * full / size);
    const int end = static_cast<int>(static_cast<std::int64_t>(i + 1) * full / size);
    return std::pair{begin, std::max(end, begin + 1)};
  };
  for (int y = 0; y < height; ++y) {
    const auto [top, bottom] = span(y, height, picture.height);
    for (int x = 0; x < width; ++x) {
      const auto [left, right] = span(x, width, picture.width);
      unsigned sum[3] = {0, 0, 0};
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u)
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] += picture.pixels[3 * (static_cast<std::size_t>(v) * picture.width + u) + c];
      const unsigned n = static_cast<unsigned>((bottom - top) * (right - left));
      for (std::size_t c = 0; c < 3; ++c)
        result.pixels[3 * (static_cast<std::size_t>(y) * width + x) + c] =
            static_cast<std::uint8_t>((sum[c] + n / 2) / n);
    }
  }
  return result;
}

void paste(Picture& sheet, const Picture& picture, int left, int top) {
  for (int y = 0; y < picture.height; ++y)
    std::copy_n(picture.pixels.begin() + 3L * y * picture.width, 3L * picture.width,
                sheet.pixels.begin() + 3 * (static_cast<std::int64_t>(top + y) * sheet.width + left));
}

/// Pixels across; 0 if it cannot be drawn.
int width_of(const std::string& text, vtkTextProperty* font) {
  int box[4] = {0, 0, 0, 0};  // left, right, bottom, top
  if (text.empty() || !vtkTextRenderer::GetInstance()->GetBoundingBox(font, vtkStdString(text), box, 72)) return 0;
  return box[1] - box[0] + 1;
}

/// The text on one line, cut to a width (pixels) with "…" at its end.
std::string fitted(std::string text, vtkTextProperty* font, int width) {
  for (auto& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  if (width_of(text, font) <= width) return text;
  std::vector<std::size_t> letters;  // where UTF-8's letters begin
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) letters.push_back(i);
  const auto cut = [&](std::size_t at) { return text.substr(0, at) + "…"; };
  const auto first_too_wide =
      std::partition_point(letters.begin(), letters.end(), [&](auto at) { return width_of(cut(at), font) <= width; });
  return first_too_wide == letters.begin() ? "" : cut(*std::prev(first_too_wide));
}

/// Dark text on the sheet's white, its left edge at `left`, at most `width` across.
void write_text(Picture& sheet, const std::string& words, int left, int top, int width, int size) {
  const RenderLock lock;
  vtkNew<vtkTextProperty> font;
  font->SetFontFamilyToArial();
  font->SetFontSize(size);
  font->SetColor(0.1, 0.1, 0.1);
  const std::string text = fitted(words, font, width);
  vtkNew<vtkImageData> image;
  int extent[2] = {0, 0};
  if (text.empty() ||
      !vtkTextRenderer::GetInstance()->RenderString(font.Get(), vtkStdString(text), image.Get(), extent, 72))
    return;
  const int* dimensions = image->GetDimensions();
  for (int y = 0; y < std::min(extent[1], sheet.height - top); ++y)
    for (int x = 0; x < std::min(extent[0], width); ++x) {
      const auto* rgba =
          static_cast<const std::uint8_t*>(image->GetScalarPointer(x, std::min(extent[1], dimensions[1]) - 1 - y, 0));
      auto* pixel = &sheet.pixels[3 * (static_cast<std::size_t>(top + y) * sheet.width + left + x)];
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>((rgba[c] * rgba[3] + pixel[c] * (255 - rgba[3])) / 255);
    }
}

/// Where things stand on the sheet, pixels.
struct Layout {
  int columns, width, height, font, line;
  int left(std::size_t i) const { return gap + static_cast<int>(i) % columns * (width + gap); }
  int top(std::size_t i) const { return gap + static_cast<int>(i) / columns * (height + line + gap / 2 + gap); }
};

/// The empty sheet.
Picture paper(const Layout& layout, std::size_t pictures) {
  const std::int64_t columns = layout.columns;
  const std::int64_t rows = (static_cast<std::int64_t>(pictures) + columns - 1) / columns;
  const std::int64_t width = columns * layout.width + (columns + 1) * gap;
  const std::int64_t height = rows * (std::int64_t{layout.height} + layout.line + gap / 2) + (rows + 1) * gap;
  if (height > most_pixels / width)
    throw Error(
        fmt::format("the sheet would have {} x {} pixels, more than {} million", width, height, most_pixels / 1000000),
        "give it a smaller cell_width or fewer pictures");
  Picture sheet{static_cast<std::int32_t>(width), static_cast<std::int32_t>(height), {}, {}};
  sheet.pixels.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255);
  return sheet;
}

Layout layout_of(const std::vector<const Picture*>& pictures, const ContactSheet::Params& params) {
  const auto count = static_cast<std::int64_t>(pictures.size());
  const Picture& first = *pictures.front();
  Layout layout{};
  layout.columns = static_cast<int>(std::min(params.columns, count));
  layout.width = static_cast<int>(params.cell_width);
  layout.height =
      static_cast<int>(std::clamp<std::int64_t>(params.cell_width * first.height / first.width, 1, most_pixels));
  layout.font = std::max(8, static_cast<int>(std::lround(params.caption_size * layout.width)));
  layout.line = layout.font * 3 / 2;
  return layout;
}

}  // namespace

ContactSheet::Out ContactSheet::run(const In& in, const Params& params, Context& context) {
  require_png_name(params.path.path);
  std::vector<const Picture*> pictures;
  for (const auto& some : in.pictures)
    for (const auto& picture : some->pictures) pictures.push_back(&picture);
  if (pictures.empty()) throw Error("there is no picture to put on the sheet");

  const Layout layout = layout_of(pictures, params);
  Picture sheet = paper(layout, pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Picture& picture = *pictures[i];
    const double scale = std::min(1.0 * layout.width / picture.width, 1.0 * layout.height / picture.height);
    paste(sheet,
          shrunk(picture, std::max(1, static_cast<int>(picture.width * scale)),
                 std::max(1, static_cast<int>(picture.height * scale))),
          layout.left(i), layout.top(i));
    write_text(sheet, i < params.captions.size() ? params.captions[i] : picture.caption, layout.left(i),
               layout.top(i) + layout.height + gap / 2, layout.width, layout.font);
  }
  const auto path = context.output(params.path.path);
  write_png(sheet, path);
  context.wrote(path);
  return {{{sheet}}};
}

}  // namespace atrium::render
