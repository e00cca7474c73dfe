#include "modules/io/e57_xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <string_view>

#include "graph/api/error.hpp"
#include "modules/io/lines.hpp"

namespace atrium::io {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

/// The name without the prefix of its namespace.
std::string_view local_name(pugi::xml_node node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// Elements of E57 itself have no prefix, or one for E57's own namespace: the first child of that local name is taken.
pugi::xml_node child(pugi::xml_node parent, std::string_view name) {
  for (const auto node : parent.children())
    if (name == node.name()) return node;
  for (const auto node : parent.children())
    if (local_name(node) == name) return node;
  return {};
}

class Xml {
 public:
  explicit Xml(const std::string& path) : path_(path) {}

  E57Contents contents(pugi::xml_node root) {
    E57Contents all;
    for (const auto node : child(root, "images2D").children()) all.images += node.type() == pugi::node_element ? 1 : 0;
    all.crs = trimmed(child(root, "coordinateMetadata").text().get());
    for (const auto node : child(root, "data3D").children()) {
      if (node.type() != pugi::node_element) continue;
      where_ = fmt::format("scan {}", ++all.all_scans);
      if (const std::string_view name = trimmed(child(node, "name").text().get()); !name.empty())
        where_ += " " + quote(name);
      E57Scan one = scan(node);
      if (one.records > 0) all.scans.push_back(std::move(one));
    }
    return all;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& help = {}) const {
    throw Error(fmt::format("{}: {}: {}", path_, where_, what), help);
  }

  double real(std::string_view text, std::string_view name) const {
    double value = 0;
    text = trimmed(text);
    if (text.empty()) return 0;  // E57: an element without text is 0
    if (!parse_number(text, value)) fail(fmt::format("{} is {}, which is not a number", name, quote(text)));
    return value;
  }

  template <class T>
  T whole(std::string_view text, std::string_view name) const {
    T value = 0;
    text = trimmed(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stop != text.data() + text.size())
      fail(fmt::format("{} is {}, which is not a whole number", name, quote(text)));
    return value;
  }

  template <class T>
  T attribute(pugi::xml_node node, const char* name, T otherwise) const {
    const auto found = node.attribute(name);
    if (!found) return otherwise;
    const std::string label = fmt::format("{} of {}", name, node.name());
    if constexpr (std::is_integral_v<T>)
      return whole<T>(found.value(), label);
    else
      return real(found.value(), label);
  }

  /// The value of an element of type Float, Integer or ScaledInteger.
  double number(pugi::xml_node node) const {
    const double value = real(node.text().get(), node.name());
    return std::string_view(node.attribute("type").value()) == "ScaledInteger"
               ? value * attribute(node, "scale", 1.0) + attribute(node, "offset", 0.0)
               : value;
  }

  E57Scan scan(pugi::xml_node node) {
    E57Scan scan;
    scan.label = where_;
    const auto points = child(node, "points");
    if (!points) return scan;
    scan.records = attribute<std::uint64_t>(points, "recordCount", 0);
    if (scan.records == 0) return scan;
    if (!points.attribute("fileOffset")) fail("the points have no fileOffset");
    scan.section = attribute<std::uint64_t>(points, "fileOffset", 0);
    add_fields(child(points, "prototype"), scan.fields, 0);
    if (scan.fields.empty()) fail("the points have no prototype that names their fields");
    if (const auto pose = child(node, "pose")) scan.pose = this->pose(pose);
    const auto colours = child(node, "colorLimits");
    scan.colour_limits = {limits(colours, "colorRed"), limits(colours, "colorGreen"), limits(colours, "colorBlue")};
    scan.intensity_limits = limits(child(node, "intensityLimits"), "intensity");
    return scan;
  }

  /// In the order of the byte streams: the leaves of the prototype.
  void add_fields(pugi::xml_node parent, std::vector<E57Field>& fields, int depth) {
    constexpr int deepest = 8;
    if (depth > deepest) fail("the prototype's structures are nested too deep");
    for (const auto node : parent.children()) {
      if (node.type() != pugi::node_element) continue;
      const std::string_view type = node.attribute("type").value();
      if (type == "Structure" || type == "Vector")
        add_fields(node, fields, depth + 1);
      else
        fields.push_back(field(node, type));
    }
  }

  E57Field field(pugi::xml_node node, std::string_view type) const {
    E57Field field;
    field.name = local_name(node);
    if (type == "Float") {
      const bool single = std::string_view(node.attribute("precision").value()) == "single";
      field.kind = single ? E57Field::Kind::f32 : E57Field::Kind::f64;
      field.bits = single ? 32 : 64;
    } else if (type == "Integer" || type == "ScaledInteger") {
      field.kind = E57Field::Kind::integer;
      field.minimum = attribute(node, "minimum", std::numeric_limits<std::int64_t>::min());
      field.maximum = attribute(node, "maximum", std::numeric_limits<std::int64_t>::max());
      if (field.minimum > field.maximum)
        fail(fmt::format("{} has a minimum of {} above its maximum of {}", field.name, field.minimum, field.maximum));
      if (type == "ScaledInteger") {
        field.scale = attribute(node, "scale", 1.0);
        field.offset = attribute(node, "offset", 0.0);
        if (!std::isfinite(field.scale) || !std::isfinite(field.offset) || field.scale == 0)
          fail(fmt::format("{} has a scale of {} and an offset of {}", field.name, field.scale, field.offset));
      }
      field.bits = static_cast<unsigned>(
          std::bit_width(static_cast<std::uint64_t>(field.maximum) - static_cast<std::uint64_t>(field.minimum)));
    } else if (type == "String") {
      field.kind = E57Field::Kind::text;
    } else {
      fail(fmt::format("the field {} has the type {}", field.name, quote(type)),
           "known: Float, Integer, ScaledInteger, String");
    }
    return field;
  }

  Eigen::Isometry3d pose(pugi::xml_node node) const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    if (const auto t = child(node, "translation"))
      pose.translation() = Eigen::Vector3d(number(child(t, "x")), number(child(t, "y")), number(child(t, "z")));
    if (const auto r = child(node, "rotation")) {
      const Eigen::Quaterniond turn(number(child(r, "w")), number(child(r, "x")), number(child(r, "y")),
                                    number(child(r, "z")));
      constexpr double tolerance = 0.01;
      if (!(std::abs(turn.norm() - 1) <= tolerance))  // NaN too
        fail(fmt::format("its rotation (w {}, x {}, y {}, z {}) is no unit quaternion, so no turn", turn.w(), turn.x(),
                         turn.y(), turn.z()),
             "no turn is w 1, x 0, y 0, z 0");
      pose.linear() = turn.normalized().toRotationMatrix();
    }
    if (!pose.translation().allFinite()) fail("its place (translation of the pose) is not finite");
    return pose;
  }

  std::optional<E57Limits> limits(pugi::xml_node node, const std::string& name) const {
    const auto low = child(node, name + "Minimum"), high = child(node, name + "Maximum");
    if (!low || !high) return std::nullopt;
    const E57Limits limits{number(low), number(high)};
    if (!(limits.low < limits.high)) return std::nullopt;  // some programs write 0 and 0
    return limits;
  }

  const std::string& path_;
  std::string where_;
};

}  // namespace

int E57Scan::field(std::string_view name) const {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const E57Field& f) { return f.name == name; });
  return found == fields.end() ? -1 : static_cast<int>(found - fields.begin());
}

E57Contents read_e57_xml(const std::string& path, std::string xml) {
  pugi::xml_document document;
  const auto parsed = document.load_buffer_inplace(xml.data(), xml.size());
  if (!parsed)
    throw Error(
        fmt::format("{}: the XML section is damaged at its byte {}: {}", path, parsed.offset, parsed.description()));
  const pugi::xml_node root = child(document, "e57Root");
  if (!root) throw Error(path + ": the XML section has no element e57Root");
  return Xml(path).contents(root);
}

}  // namespace atrium::io
