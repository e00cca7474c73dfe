#include "modules/io/write_vg.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "modules/io/byte_buffer.hpp"
#include "modules/io/paths.hpp"

namespace atrium::io {
namespace {

/// A group's colour, 0 … 1: hues in steps of the golden ratio, so that neighbouring numbers look different.
std::array<float, 3> group_colour(std::size_t group) {
  const double hue = std::fmod(static_cast<double>(group) * 0.6180339887498949, 1.0);
  std::array<float, 3> colour{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double k = std::fmod(hue * 6.0 + 5.0 - 2.0 * static_cast<double>(a), 6.0);
    colour[a] = static_cast<float>(0.9 - 0.7 * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
  }
  return colour;
}

std::string label_of(std::size_t group) { return "plane_" + std::to_string(group); }

/// Text, formatted side by side and written in order.
class TextWriter {
 public:
  TextWriter(ByteBuffer& out, const Context& context) : out_(out), context_(context) {
    for (std::size_t c = 0; c < shades_.size(); ++c) shades_[c] = fmt::format("{}", static_cast<float>(c) / 255.0F);
  }
  void count(std::string_view name, std::size_t n) { out_.text(fmt::format("{}: {}\n", name, n)); }
  void points(const Eigen::Vector3d& origin, const std::vector<Eigen::Vector3f>& points) {
    if (origin.isZero(0)) return triples(points);
    each(points, [&](Text& text, const Eigen::Vector3f& p) {
      const Eigen::Vector3d place = origin + p.cast<double>();
      triple(text, place.x(), place.y(), place.z());
    });
  }
  void triples(const std::vector<Eigen::Vector3f>& values) {
    each(values, [](Text& text, const Eigen::Vector3f& v) { triple(text, v.x(), v.y(), v.z()); });
  }
  void colours(const std::vector<Colour>& colours) {
    each(colours, [&](Text& text, const Colour& c) {
      for (std::size_t a = 0; a < 3; ++a) {
        text.append(shades_[c[a]]);
        text.push_back(a < 2 ? ' ' : '\n');
      }
    });
  }
  void group(std::size_t g, const Plane& plane, const std::vector<std::uint32_t>& points) {
    const auto colour = group_colour(g);
    const auto& n = plane.normal;
    out_.text(fmt::format("group_type: 0\nnum_group_parameters: 4\ngroup_parameters: {} {} {} {}\n", n.x(), n.y(),
                          n.z(), plane.offset));
    out_.text(fmt::format("group_label: {}\ngroup_color: {:.4f} {:.4f} {:.4f}\ngroup_num_points: {}\n", label_of(g),
                          colour[0], colour[1], colour[2], points.size()));
    each(points, [](Text& text, std::uint32_t i) {
      const fmt::format_int digits(i);
      text.append(digits.data(), digits.data() + digits.size());
      text.push_back(' ');
    });
    out_.text("\nnum_children: 0\n");
  }

 private:
  using Text = fmt::memory_buffer;

  template <class T>
  static void triple(Text& text, T x, T y, T z) {
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{} {} {}\n"), x, y, z);
  }
  /// Formats the values in chunks, so many at a time that the texts in memory stay few.
  template <class Values, class Format>
  void each(const Values& values, const Format& format) {
    constexpr std::size_t chunk_size = 4096, batch = 32;
    std::vector<Text> texts(std::min(batch, values.size() / chunk_size + 1));
    for (std::size_t start = 0; start < values.size(); start += batch * chunk_size) {
      const std::size_t total = std::min(values.size() - start, batch * chunk_size);
      context_.parallel_chunks(total, chunk_size, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
        texts[chunk].clear();
        for (std::size_t i = start + begin; i < start + end; ++i) format(texts[chunk], values[i]);
      });
      for (std::size_t c = 0; c * chunk_size < total; ++c) out_.text({texts[c].data(), texts[c].size()});
    }
  }

  ByteBuffer& out_;
  const Context& context_;
  std::array<std::string, 256> shades_;
};

class BinaryWriter {
 public:
  explicit BinaryWriter(ByteBuffer& out) : out_(out) {}
  void count(std::string_view /*name*/, std::size_t n) { integer(n); }
  void points(const Eigen::Vector3d& /*origin*/, const std::vector<Eigen::Vector3f>& points) { triples(points); }
  void triples(const std::vector<Eigen::Vector3f>& values) {
    for (const auto& v : values) triple(v.x(), v.y(), v.z());
  }
  void colours(const std::vector<Colour>& colours) {
    for (const auto& c : colours) triple(c[0] / 255.0F, c[1] / 255.0F, c[2] / 255.0F);
  }
  void group(std::size_t g, const Plane& plane, const std::vector<std::uint32_t>& points) {
    const std::string label = label_of(g);
    const auto colour = group_colour(g);
    integer(0);
    integer(4);
    for (int a = 0; a < 3; ++a) out_.number(static_cast<float>(plane.normal[a]));
    out_.number(static_cast<float>(plane.offset));
    integer(label.size());
    out_.text(label);
    triple(colour[0], colour[1], colour[2]);
    integer(points.size());
    for (const auto i : points) integer(i);
    integer(0);
  }

 private:
  void triple(float x, float y, float z) {
    for (const float v : {x, y, z}) out_.number(v);
  }
  void integer(std::size_t v) { out_.number(static_cast<std::int32_t>(v)); }
  ByteBuffer& out_;
};

template <class Writer>
void write(const PlanePrimitives& planes, const Eigen::Vector3d& origin, Writer&& writer) {
  const Cloud& cloud = *planes.cloud;
  writer.count("num_points", cloud.size());
  writer.points(origin, cloud.points);
  writer.count("num_colors", cloud.colours.size());
  writer.colours(cloud.colours);
  writer.count("num_normals", cloud.normals.size());
  writer.triples(cloud.normals);
  writer.count("num_groups", planes.primitives.size());
  for (std::size_t g = 0; g < planes.primitives.size(); ++g) {
    Plane plane = planes.primitives[g].plane;
    plane.offset -= plane.normal.dot(origin);
    writer.group(g, plane, planes.primitives[g].inliers);
  }
}

}  // namespace

void WriteVg::run(const In& in, const Params& params, Context& context) {
  const Cloud& cloud = *in.planes->cloud;
  const std::string extension = extension_of(params.path.path);
  if (extension != ".vg" && extension != ".bvg")
    throw Error("cannot write vertex groups as '" + params.path.path + "'", "known extensions: .vg, .bvg");
  const bool binary = extension == ".bvg";
  if (binary && cloud.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw Error(fmt::format("{} points are too many for a .bvg file", cloud.size()), "write .vg");
  if (binary && !cloud.origin.isZero(0))
    context.warn(
        fmt::format("{}: .bvg holds float32 only: its coordinates are relative to ({}, {}, {}); .vg has the true "
                    "ones",
                    params.path.path, cloud.origin.x(), cloud.origin.y(), cloud.origin.z()));
  const auto target = context.output(params.path.path);
  AtomicFile file(target);
  ByteBuffer out(file);
  if (binary)
    write(*in.planes, Eigen::Vector3d::Zero(), BinaryWriter(out));
  else
    write(*in.planes, cloud.origin, TextWriter(out, context));
  out.flush();
  file.commit();
  context.wrote(target);
}

}  // namespace atrium::io
