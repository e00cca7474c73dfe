#include "modules/io/e57_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <optional>
#include <span>

#include "modules/io/e57_page_writer.hpp"

namespace atrium::io {
namespace {

constexpr std::uint64_t file_header = 48, section_header = 32, packet_header = 6, index_packet = 32;

/// A field of the records: its XML element, its bits, and the bits of a point.
struct WrittenField {
  std::string xml;
  unsigned bits = 0;
  std::function<std::uint64_t(std::size_t point)> value;
};

std::uint64_t bits_of(float v) { return std::bit_cast<std::uint32_t>(v); }
std::uint64_t bits_of(double v) { return std::bit_cast<std::uint64_t>(v); }

/// Some points of the cloud that one scanner saw.
struct WrittenScan {
  std::span<const std::uint32_t> points;
  std::optional<Eigen::Vector3d> place;
  std::vector<WrittenField> fields;
  std::size_t packet_records = 0;
  std::uint64_t begin = 0;  ///< of the section, logical

  std::uint64_t packet_size(std::size_t records) const {
    std::uint64_t size = packet_header + 2 * fields.size();
    for (const auto& field : fields) size += (field.bits * records + 7) / 8;
    return (size + 3) / 4 * 4;
  }
  std::uint64_t section_size() const {
    const std::size_t whole = points.size() / packet_records, rest = points.size() % packet_records;
    return section_header + whole * packet_size(packet_records) + (rest > 0 ? packet_size(rest) : 0) + index_packet;
  }
};

std::string float_xml(std::string_view name, bool single) {
  return fmt::format("<{} type=\"Float\"{}/>", name, single ? " precision=\"single\"" : "");
}

std::string integer_xml(std::string_view name, std::int64_t low, std::int64_t high) {
  return fmt::format("<{} type=\"Integer\" minimum=\"{}\" maximum=\"{}\"/>", name, low, high);
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '&': result += "&amp;"; break;
      default: result += c;
    }
  }
  return result;
}

class E57Writer {
 public:
  E57Writer(const Cloud& cloud, const std::string& crs) : cloud_(cloud), crs_(crs) {
    order_points();
    std::uint64_t at = file_header;
    for (auto& scan : scans_) {
      add_fields(scan);
      constexpr std::uint64_t largest = 60000;  // a packet's length has 16 bits
      unsigned bits = 0;
      for (const auto& field : scan.fields) bits += field.bits;
      scan.packet_records = std::max<std::size_t>(8, largest * 8 / bits / 8 * 8);  // streams end at whole bytes
      scan.begin = at;
      at += scan.section_size();
    }
    xml_begin_ = at;
    xml_ = xml();
  }

  void write(AtomicFile& file) const {
    E57PageWriter out(file);
    out.text("ASTM-E57");
    out.number<std::uint32_t>(1);
    out.number<std::uint32_t>(0);
    out.number(E57PageWriter::file_size(xml_begin_ + xml_.size()));
    out.number(E57PageWriter::physical(xml_begin_));
    out.number<std::uint64_t>(xml_.size());
    out.number(E57PageWriter::page);
    for (const auto& scan : scans_) write_section(scan, out);
    out.text(xml_);
    out.finish();
  }

 private:
  /// Scans with points, one a sensor.
  void order_points() {
    const std::size_t sensors = cloud_.sensors.size();
    const bool several = sensors > 1 && !cloud_.source.empty();
    std::vector<std::size_t> begins((several ? sensors : 1) + 1, 0);
    order_.resize(cloud_.size());
    if (several) {
      for (const auto s : cloud_.source) ++begins[s + 1U];
      std::partial_sum(begins.begin(), begins.end(), begins.begin());
      auto next = begins;
      for (std::size_t i = 0; i < cloud_.size(); ++i) order_[next[cloud_.source[i]]++] = static_cast<std::uint32_t>(i);
    } else {
      begins[1] = cloud_.size();
      std::iota(order_.begin(), order_.end(), 0U);
    }
    for (std::size_t s = 0; s + 1 < begins.size(); ++s) {
      WrittenScan scan;
      scan.points = std::span(order_).subspan(begins[s], begins[s + 1] - begins[s]);
      if (several || sensors == 1) scan.place = cloud_.origin + cloud_.sensors[s].cast<double>();
      if (!scan.points.empty() || begins.size() == 2) scans_.push_back(std::move(scan));
    }
  }

  void add_fields(WrittenScan& scan) const {
    const Cloud& c = cloud_;
    const Eigen::Vector3d shift = c.origin - scan.place.value_or(Eigen::Vector3d::Zero());
    const bool single = scan.place || c.origin.isZero(0);
    for (int a = 0; a < 3; ++a)
      scan.fields.push_back({float_xml(fmt::format("cartesian{}", "XYZ"[a]), single), single ? 32U : 64U,
                             [&c, a, single, by = shift[a]](std::size_t i) {
                               const double v = static_cast<double>(c.points[i][a]) + by;
                               return single ? bits_of(static_cast<float>(v)) : bits_of(v);
                             }});
    for (int a = 0; a < 3 && !c.normals.empty(); ++a)
      scan.fields.push_back({float_xml(fmt::format("nor:normal{}", "XYZ"[a]), true), 32,
                             [&c, a](std::size_t i) { return bits_of(c.normals[i][a]); }});
    constexpr std::string_view colours[3] = {"colorRed", "colorGreen", "colorBlue"};
    for (std::size_t a = 0; a < 3 && !c.colours.empty(); ++a)
      scan.fields.push_back({integer_xml(colours[a], 0, 255), 8,
                             [&c, a](std::size_t i) { return static_cast<std::uint64_t>(c.colours[i][a]); }});
    if (!c.intensities.empty())
      scan.fields.push_back(
          {float_xml("intensity", true), 32, [&c](std::size_t i) { return bits_of(c.intensities[i]); }});
    if (c.labels.empty()) return;
    const auto [low, high] = std::minmax_element(c.labels.begin(), c.labels.end());
    const auto minimum = static_cast<std::int64_t>(*low), range = static_cast<std::int64_t>(*high) - minimum;
    scan.fields.push_back({integer_xml("las:classification", minimum, minimum + range),
                           static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(range))),
                           [&c, minimum](std::size_t i) { return static_cast<std::uint64_t>(c.labels[i] - minimum); }});
  }

  void write_section(const WrittenScan& scan, E57PageWriter& out) const {
    const std::uint64_t data = scan.begin + section_header;
    const std::uint64_t size = scan.section_size();
    out.number<std::uint64_t>(1);  // its kind, and seven bytes that are kept free
    out.number(size);
    out.number(E57PageWriter::physical(data));
    out.number(E57PageWriter::physical(scan.begin + size - index_packet));
    std::string packet;
    for (std::size_t first = 0; first < scan.points.size(); first += scan.packet_records) {
      fill_packet(scan, first, std::min(scan.packet_records, scan.points.size() - first), packet);
      out.text(packet);
    }
    // An index of one entry: the data begin with record 0.
    out.number<std::uint16_t>(0);
    out.number<std::uint16_t>(index_packet - 1);
    out.number<std::uint16_t>(1);
    out.text(std::string(10, '\0'));
    out.number<std::uint64_t>(0);
    out.number(E57PageWriter::physical(data));
  }

  static void fill_packet(const WrittenScan& scan, std::size_t first, std::size_t records, std::string& packet) {
    packet.clear();
    const auto u16 = [&](std::uint64_t v) {
      packet += static_cast<char>(v & 0xFFU);
      packet += static_cast<char>(v >> 8U & 0xFFU);
    };
    u16(1);
    u16(scan.packet_size(records) - 1);
    u16(scan.fields.size());
    for (const auto& field : scan.fields) u16((field.bits * records + 7) / 8);
    for (const auto& field : scan.fields) {
      std::uint64_t rest = 0;  // bits that fill no byte yet
      unsigned held = 0;
      for (std::size_t i = first; i < first + records; ++i) {
        std::uint64_t value = field.value(scan.points[i]);
        for (unsigned left = field.bits; left > 0;) {
          const unsigned some = std::min(left, 8 - held);
          rest |= (value & ((1U << some) - 1)) << held;
          value >>= some;
          held += some;
          left -= some;
          if (held < 8) continue;
          packet += static_cast<char>(rest);
          rest = held = 0;
        }
      }
      if (held > 0) packet += static_cast<char>(rest);
    }
    packet.resize(scan.packet_size(records), '\0');
  }

  std::string bounds_xml(const WrittenScan& scan) const {
    if (scan.points.empty()) return {};
    Eigen::Vector3f low = cloud_.points[scan.points.front()], high = low;
    for (const auto i : scan.points) {
      low = low.cwiseMin(cloud_.points[i]);
      high = high.cwiseMax(cloud_.points[i]);
    }
    const Eigen::Vector3d shift = cloud_.origin - scan.place.value_or(Eigen::Vector3d::Zero());
    std::string xml = "<cartesianBounds type=\"Structure\">";
    for (int a = 0; a < 3; ++a)
      xml += fmt::format("<{0}Minimum type=\"Float\">{1}</{0}Minimum><{0}Maximum type=\"Float\">{2}</{0}Maximum>",
                         "xyz"[a], static_cast<double>(low[a]) + shift[a], static_cast<double>(high[a]) + shift[a]);
    return xml + "</cartesianBounds>\n";
  }

  std::string guid(std::size_t i) const {
    std::uint64_t hash = mix_seed(cloud_.size(), i);
    for (std::size_t p = 0; p < cloud_.size(); p += 1 + cloud_.size() / 100)
      for (int a = 0; a < 3; ++a) hash = mix_seed(hash, std::bit_cast<std::uint32_t>(cloud_.points[p][a]));
    const std::uint64_t more = mix_seed(hash, i);
    return fmt::format("{{{:08X}-{:04X}-4{:03X}-8{:03X}-{:012X}}}", hash >> 32U, hash >> 16U & 0xFFFFU, hash & 0xFFFU,
                       more >> 52U, more & 0xFFFFFFFFFFFFU);
  }

  std::string scan_xml(const WrittenScan& scan, std::size_t number) const {
    std::string xml = fmt::format(
        "<vectorChild type=\"Structure\">\n<guid type=\"String\"><![CDATA[{}]]></guid>\n"
        "<name type=\"String\"><![CDATA[Scan {}]]></name>\n",
        guid(number), number);
    if (scan.place)
      xml += fmt::format(
          "<pose type=\"Structure\"><rotation type=\"Structure\"><w type=\"Float\">1</w><x type=\"Float\">0</x>"
          "<y type=\"Float\">0</y><z type=\"Float\">0</z></rotation><translation type=\"Structure\">"
          "<x type=\"Float\">{}</x><y type=\"Float\">{}</y><z type=\"Float\">{}</z></translation></pose>\n",
          scan.place->x(), scan.place->y(), scan.place->z());
    xml += bounds_xml(scan);
    if (!cloud_.colours.empty()) {
      xml += "<colorLimits type=\"Structure\">";
      for (const char* name : {"colorRed", "colorGreen", "colorBlue"})
        xml += fmt::format("<{0}Minimum type=\"Integer\">0</{0}Minimum><{0}Maximum type=\"Integer\">255</{0}Maximum>",
                           name);
      xml += "</colorLimits>\n";
    }
    xml += fmt::format(
        "<points type=\"CompressedVector\" fileOffset=\"{}\" recordCount=\"{}\">\n"
        "<prototype type=\"Structure\">\n",
        E57PageWriter::physical(scan.begin), scan.points.size());
    for (const auto& field : scan.fields) xml += field.xml + "\n";
    return xml +
           "</prototype>\n<codecs type=\"Vector\" allowHeterogeneousChildren=\"1\"></codecs>\n</points>\n"
           "</vectorChild>\n";
  }

  std::string xml() const {
    std::string xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" "
        "xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\"";
    if (!cloud_.normals.empty()) xml += " xmlns:nor=\"http://www.libe57.org/E57_EXT_surface_normals.txt\"";
    if (!cloud_.labels.empty()) xml += " xmlns:las=\"http://www.astm.org/COMMIT/E57/2010-las-v1.0\"";
    xml += fmt::format(
        ">\n<formatName type=\"String\"><![CDATA[ASTM E57 3D Imaging Data File]]></formatName>\n"
        "<guid type=\"String\"><![CDATA[{}]]></guid>\n<versionMajor type=\"Integer\">1</versionMajor>\n"
        "<versionMinor type=\"Integer\">0</versionMinor>\n"
        "<e57LibraryVersion type=\"String\"><![CDATA[Atrium]]></e57LibraryVersion>\n",
        guid(0));
    if (!crs_.empty())
      xml += fmt::format("<coordinateMetadata type=\"String\">{}</coordinateMetadata>\n", escaped(crs_));
    xml += "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n";
    for (std::size_t s = 0; s < scans_.size(); ++s) xml += scan_xml(scans_[s], s + 1);
    return xml + "</data3D>\n<images2D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n</images2D>\n</e57Root>\n";
  }

  const Cloud& cloud_;
  const std::string& crs_;
  std::vector<std::uint32_t> order_;
  std::vector<WrittenScan> scans_;
  std::uint64_t xml_begin_ = 0;
  std::string xml_;
};

}  // namespace

void write_e57(const Cloud& cloud, const std::string& crs, AtomicFile& file) { E57Writer(cloud, crs).write(file); }

}  // namespace atrium::io
