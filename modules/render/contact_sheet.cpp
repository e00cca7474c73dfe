#include "modules/render/contact_sheet.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>

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

/// Dark text on the sheet's white, its left edge at `left`.
void write_text(Picture& sheet, const std::string& text, int left, int top, int size) {
  vtkNew<vtkTextProperty> font;
  font->SetFontFamilyToArial();
  font->SetFontSize(size);
  font->SetColor(0.1, 0.1, 0.1);
  vtkNew<vtkImageData> image;
  int extent[2] = {0, 0};
  if (text.empty() ||
      !vtkTextRenderer::GetInstance()->RenderString(font.Get(), vtkStdString(text), image.Get(), extent, 72))
    return;
  const int* dimensions = image->GetDimensions();
  for (int y = 0; y < extent[1]; ++y)
    for (int x = 0; x < std::min(extent[0], sheet.width - left); ++x) {
      const auto* rgba =
          static_cast<const std::uint8_t*>(image->GetScalarPointer(x, std::min(extent[1], dimensions[1]) - 1 - y, 0));
      if (top + y >= sheet.height) continue;
      auto* pixel = &sheet.pixels[3 * (static_cast<std::size_t>(top + y) * sheet.width + left + x)];
      for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>((rgba[c] * rgba[3] + pixel[c] * (255 - rgba[3])) / 255);
    }
}

}  // namespace

ContactSheet::Out ContactSheet::run(const In& in, const Params& params, Context& context) {
  std::vector<const Picture*> pictures;
  for (const auto& some : in.pictures)
    for (const auto& picture : some->pictures) pictures.push_back(&picture);
  if (pictures.empty()) throw Error("there is no picture to put on the sheet");

  const int columns =
      static_cast<int>(std::min<std::int64_t>(params.columns, static_cast<std::int64_t>(pictures.size())));
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  const int width = static_cast<int>(params.cell_width);
  const int height = std::max(1, width * pictures.front()->height / pictures.front()->width);
  const int font = std::max(8, static_cast<int>(std::lround(params.caption_size * width)));
  const int line = font * 3 / 2;
  Picture sheet;
  sheet.width = columns * width + (columns + 1) * gap;
  sheet.height = rows * (height + line + gap / 2) + (rows + 1) * gap;
  sheet.pixels.assign(3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height), 255);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Picture& picture = *pictures[i];
    const double scale = std::min(1.0 * width / picture.width, 1.0 * height / picture.height);
    const int left = gap + static_cast<int>(i) % columns * (width + gap);
    const int top = gap + static_cast<int>(i) / columns * (height + line + gap / 2 + gap);
    paste(sheet,
          shrunk(picture, std::max(1, static_cast<int>(picture.width * scale)),
                 std::max(1, static_cast<int>(picture.height * scale))),
          left, top);
    write_text(sheet, i < params.captions.size() ? params.captions[i] : picture.caption, left, top + height + gap / 2,
               font);
  }
  const auto path = context.output(params.path.path);
  write_png(sheet, path);
  context.wrote(path);
  return {{{sheet}}};
}

}  // namespace atrium::render
