#include "modules/floorplan/svg_canvas.hpp"

namespace atrium::floorplan {

std::size_t character_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char lead = byte(i);
  if (lead < 0x80) return lead >= 0x20 || lead == '\t' || lead == '\n' || lead == '\r' ? 1 : 0;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || i + length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(i + k) & 0xC0U) != 0x80U) return 0;
  const unsigned char next = byte(i + 1);
  const bool overlong = (lead == 0xE0 && next < 0xA0) || (lead == 0xF0 && next < 0x90);
  const bool beyond = (lead == 0xF4 && next > 0x8F) || (lead == 0xED && next > 0x9F);  // surrogates
  const bool none = lead == 0xEF && next == 0xBF && byte(i + 2) >= 0xBE;               // U+FFFE, U+FFFF
  return overlong || beyond || none ? 0 : length;
}

namespace {

std::string place(const Eigen::Vector2d& p) { return fmt::format("{:.3f},{:.3f}", p.x() + 0.0, p.y() + 0.0); }

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    switch (length == 1 ? text[i] : 0) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      default: result += length > 0 ? text.substr(i, length) : std::string_view("\xEF\xBF\xBD");
    }
    i += std::max<std::size_t>(length, 1);
  }
  return result;
}

SvgCanvas::SvgCanvas(double width, double height, std::string_view title) {
  text_ = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}mm\" height=\"{1:g}mm\" viewBox=\"0 0 {0:g} {1:g}\" "
      "font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\">\n<title>{2}</title>\n"
      "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#fff\"/>\n",
      width, height, escaped(title));
}

void SvgCanvas::begin_group(std::string_view attributes) { text_ += fmt::format("<g {}>\n", attributes); }

void SvgCanvas::line(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  text_ += fmt::format("<path d=\"M{}L{}\"/>\n", place(a), place(b));
}

void SvgCanvas::arc(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius, bool clockwise) {
  text_ +=
      fmt::format("<path d=\"M{}A{:.3f},{:.3f} 0 0 {} {}\"/>\n", place(a), radius, radius, clockwise ? 1 : 0, place(b));
}

void SvgCanvas::polygon(const std::vector<PlanRing>& rings, std::string_view attributes) {
  std::string path;
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) path += (i == 0 ? "M" : "L") + place(ring[i]);
    path += "Z";
  }
  text_ += fmt::format("<path fill-rule=\"evenodd\" d=\"{}\" {}/>\n", path, attributes);
}

void SvgCanvas::rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, std::string_view attributes) {
  text_ += fmt::format("<rect x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" {}/>\n", corner.x(),
                       corner.y(), size.x(), size.y(), attributes);
}

void SvgCanvas::text(const Eigen::Vector2d& at, double size, std::string_view text, std::string_view attributes,
                     double degrees) {
  const std::string turn =
      degrees == 0 ? "" : fmt::format(" transform=\"rotate({:g} {:.3f} {:.3f})\"", degrees, at.x(), at.y());
  text_ += fmt::format("<text x=\"{:.3f}\" y=\"{:.3f}\" font-size=\"{:g}\" {}{}>{}</text>\n", at.x(), at.y(), size,
                       attributes, turn, escaped(text));
}

}  // namespace atrium::floorplan
