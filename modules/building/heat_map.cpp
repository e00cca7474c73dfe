#include "modules/building/heat_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

namespace atrium::building {
namespace {

constexpr double metre = 40;   // units of the page
constexpr double page = 1600;  // its width
constexpr double gap = 24;     // between faces
constexpr double line_height = 13;
constexpr double narrowest = 190;  // room for the captions

/// UTF-8 as the text of an XML element: what XML cannot hold (control characters, U+FFFE and U+FFFF) is a blank.
std::string escaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view three = text.substr(i, 3);
    if (text[i] == '&')
      result += "&amp;";
    else if (text[i] == '<')
      result += "&lt;";
    else if (text[i] == '>')
      result += "&gt;";
    else if (static_cast<unsigned char>(text[i]) < 0x20)
      result += ' ';
    else if (three == "\xEF\xBF\xBE" || three == "\xEF\xBF\xBF") {
      result += ' ';
      i += 2;
    } else
      result += text[i];
  }
  return result;
}

/// Moreland's diverging map by its ends and its middle.
std::string colour_of(double value) {
  constexpr std::array<std::array<double, 3>, 3> stops{{{59, 76, 192}, {221, 221, 221}, {180, 4, 38}}};
  const double at = std::clamp(value, -1.0, 1.0) + 1;
  const std::size_t low = at < 1 ? 0 : 1;
  const double share = at - static_cast<double>(low);
  std::array<int, 3> rgb{};
  for (std::size_t k = 0; k < 3; ++k)
    rgb.at(k) =
        static_cast<int>(std::lround(stops.at(low).at(k) + share * (stops.at(low + 1).at(k) - stops.at(low).at(k))));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::string label(double x, double y, const std::string& text, const char* style = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, style, escaped(text));
}

std::string face_at(const HeatMapFace& face, double x, double y, double cell, double range) {
  const FaceDistances& d = *face.distances;
  const double width = (d.high.x() - d.low.x()) * metre, height = (d.high.y() - d.low.y()) * metre, side = cell * metre;
  std::string result = fmt::format("<g id=\"face-{}\">\n", face.face);
  result += fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#f4f4f4\" stroke=\"#999\"/>\n", x, y,
      width, height);
  // Squares of one colour are one path.
  std::map<std::string, std::string> paths;
  for (const auto& square : d.squares) {
    const double left = std::clamp(square.x * side, 0.0, width), right = std::clamp((square.x + 1) * side, 0.0, width);
    const double low = std::clamp(square.y * side, 0.0, height), high = std::clamp((square.y + 1) * side, 0.0, height);
    paths[colour_of(std::round(square.mean / range * 16) / 16)] += fmt::format(
        "M{:.1f} {:.1f}H{:.1f}V{:.1f}H{:.1f}z", x + left, y + height - high, x + right, y + height - low, x + left);
  }
  for (const auto& [colour, path] : paths) result += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", colour, path);
  result += label(x, y + height + line_height, face.caption);
  return result + label(x, y + height + 2 * line_height, face.figures, " fill=\"#555\"") + "</g>\n";
}

std::string scale_at(double x, double y, double range) {
  constexpr int steps = 32;
  constexpr double width = 12, height = 14;
  std::string result;
  for (int i = 0; i <= steps; ++i)
    result += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", x + i * width,
                          y, width, height, colour_of(2.0 * i / steps - 1));
  result += label(x, y + height + line_height, fmt::format("{:.0f} mm behind the face", 1000 * range));
  result += label(x + 0.5 * steps * width, y + height + line_height, "0");
  return result +
         label(x + (steps - 9) * width, y + height + line_height, fmt::format("{:.0f} mm before it", 1000 * range));
}

std::string numbers(const Eigen::Vector3d& v, int digits) {
  const auto number = [&](double value) {
    const std::string text = fmt::format("{:.{}f}", value, digits);
    return text.find_first_not_of("-0.") == std::string::npos ? std::string("0") : text;
  };
  return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
}

/// The squares' means row by row from below, in tenths of a millimetre.
std::string squares_of(const FaceDistances& face, std::int32_t columns, std::int32_t rows) {
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::min();
  std::vector<std::int32_t> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), none);
  for (const auto& square : face.squares) {
    // Points a little beside the face have squares that are none of it.
    if (square.x < 0 || square.y < 0 || square.x >= columns || square.y >= rows) continue;
    values[static_cast<std::size_t>(square.y) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(square.x)] = static_cast<std::int32_t>(std::lround(square.mean * 1e4));
  }
  std::string result;
  result.reserve(5 * values.size());
  for (const auto value : values) {
    if (!result.empty()) result += ',';
    if (value == none)
      result += "null";
    else
      fmt::format_to(std::back_inserter(result), "{}", value);
  }
  return result;
}

}  // namespace

std::string heat_map_table(const std::vector<FaceDistances>& faces, const Eigen::Vector3d& origin, double cell,
                           double range) {
  std::string list;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const FaceDistances& face = faces[f];
    if (!(face.area > 0) || face.squares.empty()) continue;
    constexpr double rounding = 1e-6;  // of a square
    const auto count = [&](double extent) {
      return std::max<std::int32_t>(1, static_cast<std::int32_t>(std::ceil(extent / cell - rounding)));
    };
    const std::int32_t columns = count(face.high.x() - face.low.x()), rows = count(face.high.y() - face.low.y());
    const Eigen::Vector3d corner = face.origin + face.across * face.low.x() + face.up * face.low.y();
    list += fmt::format(
        "{}\n  {{\"face\": {}, \"corner\": {}, \"across\": {}, \"up\": {}, \"columns\": {}, \"rows\": {}, "
        "\"squares\": [{}]}}",
        list.empty() ? "" : ",", f, numbers(corner, 4), numbers(face.across, 7), numbers(face.up, 7), columns, rows,
        squares_of(face, columns, rows));
  }
  return fmt::format(
      "{{\"atrium_heat_maps\": 1, \"units\": \"m\", \"origin\": {}, \"cell\": {}, \"range\": {}, \"step\": 0.0001, "
      "\"faces\": [{}\n]}}\n",
      numbers(origin, 4), cell, range, list);
}

std::string heat_map(const std::vector<HeatMapFace>& faces, double cell, double range) {
  std::vector<const HeatMapFace*> order;
  order.reserve(faces.size());
  for (const auto& face : faces) order.push_back(&face);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) { return a->storey < b->storey; });
  std::string body = label(gap, 28, "Mean signed distance of the scan's points from the model", " font-size=\"18\"");
  body += scale_at(gap, 44, range);
  double x = gap, y = 100, row = 0;
  std::int32_t storey = -1;
  double widest = page;
  for (const auto* face : order) {
    const FaceDistances& d = *face->distances;
    const double width = std::max(narrowest, (d.high.x() - d.low.x()) * metre);
    const double height = (d.high.y() - d.low.y()) * metre + 2 * line_height;
    if (face->storey != storey || x + width > page) {
      y += row + (row > 0 ? gap : 0);
      x = gap;
      row = 0;
    }
    if (face->storey != storey) {
      storey = face->storey;
      body += label(gap, y + 14, fmt::format("Storey {}", storey), " font-size=\"15\" font-weight=\"bold\"");
      y += 24;
    }
    body += face_at(*face, x, y, cell, range);
    widest = std::max(widest, x + width + gap);
    x += width + gap;
    row = std::max(row, height);
  }
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
             "{1:.0f}\" font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"10\">\n<rect width=\"100%\" "
             "height=\"100%\" fill=\"#fff\"/>\n",
             widest, y + row + gap) +
         body + "</svg>\n";
}

}  // namespace atrium::building
