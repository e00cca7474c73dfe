#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace atrium::pdf {

/// Draws SVG sheets on the pages of a PDF file. Lines stay lines: coordinates are kept to a 256th of a point (1.4 µm of
/// paper); texts stay texts, and the parts of the fonts that they need are in the file.
class PdfPages {
 public:
  explicit PdfPages(const std::string& title);
  ~PdfPages();
  PdfPages(const PdfPages&) = delete;
  PdfPages& operator=(const PdfPages&) = delete;

  /// A page of that size, millimetres, which the drawing fills. Throws Error for what is no SVG.
  void add(const std::string& svg, const Eigen::Vector2d& size);
  /// The whole file. No time stands in it, so equal pages and fonts give equal bytes.
  std::string finish() &&;

 private:
  struct Surface;
  std::unique_ptr<Surface> surface_;
};

/// Those of the texts that hold a character which no installed font has. Throws Error where there is no font at all.
std::vector<std::string> texts_without_font(const std::vector<std::string>& texts);

}  // namespace atrium::pdf
