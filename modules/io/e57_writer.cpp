#include "modules/io/e57_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <optional>
#include <span>

#include "graph/api/error.hpp"
#include "modules/io/e57_page_writer.hpp"

namespace atrium::io {
namespace {

constexpr std::uint64_t file_header = 48, section_header = 32, packet_header = 6, index_packet = 32;

/// A field of the records: its XML element, its bits, and the bits of a cloud's point.
struct WrittenField {
  std::string xml;
  unsigned bits = 0;
  std::function<std::uint64_t(const Cloud& cloud, std::size_t point)> value;
};

std::uint64_t bits_of(float v) { return std::bit_cast<std::uint32_t>(v); }
std::uint64_t bits_of(double v) { return std::bit_cast<std::uint64_t>(v); }

/// The points that one scanner saw.
struct WrittenScan {
  std::size_t points = 0;
  std::optional<Eigen::Vector3d> place;
  std::string bounds;  ///< as XML; empty: they are not said
  std::vector<WrittenField> fields;
  std::size_t packet_records = 0;
  std::uint64_t begin = 0;  ///< of the section, logical

  std::uint64_t packet_size(std::size_t records) const {
    std::uint64_t size = packet_header + 2 * fields.size();
    for (const auto& field : fields) size += (field.bits * records + 7) / 8;
    return (size + 3) / 4 * 4;
  }
  std::uint64_t section_size() const {
    const std::size_t whole = points / packet_records, rest = points % packet_records;
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

std::string bounds_xml(const Cloud& cloud, std::span<const std::uint32_t> points, const Eigen::Vector3d& shift) {
  if (points.empty()) return {};
  Eigen::Vector3f low = cloud.points[points.front()], high = low;
  for (const auto i : points) {
    low = low.cwiseMin(cloud.points[i]);
    high = high.cwiseMax(cloud.points[i]);
  }
  std::string xml = "<cartesianBounds type=\"Structure\">";
  for (int a = 0; a < 3; ++a)
    xml += fmt::format("<{0}Minimum type=\"Float\">{1}</{0}Minimum><{0}Maximum type=\"Float\">{2}</{0}Maximum>",
                       "xyz"[a], static_cast<double>(low[a]) + shift[a], static_cast<double>(high[a]) + shift[a]);
  return xml + "</cartesianBounds>\n";
}

/// Packs these points of the cloud.
void fill_packet(const WrittenScan& scan, const Cloud& cloud, std::span<const std::uint32_t> points,
                 std::string& packet) {
  packet.clear();
  const std::size_t records = points.size();
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
    for (const auto point : points) {
      std::uint64_t value = field.value(cloud, point);
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

/// Where everything lies in the file, all but the points.
class E57Layout {
 public:
  /// `cloud`: what the points have besides coordinates. `seed`: of the GUIDs.
  E57Layout(const StreamedCloud& cloud, std::vector<WrittenScan> scans, std::string crs, std::uint64_t seed)
      : cloud_(cloud), scans_(std::move(scans)), crs_(std::move(crs)), seed_(seed) {
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

  const std::vector<WrittenScan>& scans() const { return scans_; }

  void write_head(E57PageWriter& out) const {
    out.text("ASTM-E57");
    out.number<std::uint32_t>(1);
    out.number<std::uint32_t>(0);
    out.number(E57PageWriter::file_size(xml_begin_ + xml_.size()));
    out.number(E57PageWriter::physical(xml_begin_));
    out.number<std::uint64_t>(xml_.size());
    out.number(E57PageWriter::page);
  }
  /// Before a scan's packets.
  static void begin_section(const WrittenScan& scan, E57PageWriter& out) {
    const std::uint64_t size = scan.section_size();
    out.number<std::uint64_t>(1);  // its kind, and seven bytes that are kept free
    out.number(size);
    out.number(E57PageWriter::physical(scan.begin + section_header));
    out.number(E57PageWriter::physical(scan.begin + size - index_packet));
  }
  /// Behind them: an index of one entry: the data begin with record 0.
  static void end_section(const WrittenScan& scan, E57PageWriter& out) {
    out.number<std::uint16_t>(0);
    out.number<std::uint16_t>(index_packet - 1);
    out.number<std::uint16_t>(1);
    out.text(std::string(10, '\0'));
    out.number<std::uint64_t>(0);
    out.number(E57PageWriter::physical(scan.begin + section_header));
  }
  void write_end(E57PageWriter& out) const {
    out.text(xml_);
    out.finish();
  }

 private:
  void add_fields(WrittenScan& scan) const {
    const Eigen::Vector3d shift = cloud_.origin - scan.place.value_or(Eigen::Vector3d::Zero());
    const bool single = scan.place || cloud_.origin.isZero(0);
    for (int a = 0; a < 3; ++a)
      scan.fields.push_back({float_xml(fmt::format("cartesian{}", "XYZ"[a]), single), single ? 32U : 64U,
                             [a, single, by = shift[a]](const Cloud& c, std::size_t i) {
                               const double v = static_cast<double>(c.points[i][a]) + by;
                               return single ? bits_of(static_cast<float>(v)) : bits_of(v);
                             }});
    for (int a = 0; a < 3 && cloud_.normals; ++a)
      scan.fields.push_back({float_xml(fmt::format("nor:normal{}", "XYZ"[a]), true), 32,
                             [a](const Cloud& c, std::size_t i) { return bits_of(c.normals[i][a]); }});
    constexpr std::string_view colours[3] = {"colorRed", "colorGreen", "colorBlue"};
    for (std::size_t a = 0; a < 3 && cloud_.colours; ++a)
      scan.fields.push_back({integer_xml(colours[a], 0, 255), 8, [a](const Cloud& c, std::size_t i) {
                               return static_cast<std::uint64_t>(c.colours[i][a]);
                             }});
    if (cloud_.intensities)
      scan.fields.push_back(
          {float_xml("intensity", true), 32, [](const Cloud& c, std::size_t i) { return bits_of(c.intensities[i]); }});
    if (!cloud_.labels) return;
    const auto minimum = static_cast<std::int64_t>(cloud_.lowest_label);
    const auto range = static_cast<std::int64_t>(cloud_.highest_label) - minimum;
    scan.fields.push_back(
        {integer_xml("las:classification", minimum, minimum + range),
         static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(range))),
         [minimum](const Cloud& c, std::size_t i) { return static_cast<std::uint64_t>(c.labels[i] - minimum); }});
  }

  std::string guid(std::size_t i) const {
    const std::uint64_t hash = mix_seed(seed_, i);
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
    xml += scan.bounds;
    if (cloud_.colours) {
      xml += "<colorLimits type=\"Structure\">";
      for (const char* name : {"colorRed", "colorGreen", "colorBlue"})
        xml += fmt::format("<{0}Minimum type=\"Integer\">0</{0}Minimum><{0}Maximum type=\"Integer\">255</{0}Maximum>",
                           name);
      xml += "</colorLimits>\n";
    }
    xml += fmt::format(
        "<points type=\"CompressedVector\" fileOffset=\"{}\" recordCount=\"{}\">\n"
        "<prototype type=\"Structure\">\n",
        E57PageWriter::physical(scan.begin), scan.points);
    for (const auto& field : scan.fields) xml += field.xml + "\n";
    return xml +
           "</prototype>\n<codecs type=\"Vector\" allowHeterogeneousChildren=\"1\"></codecs>\n</points>\n"
           "</vectorChild>\n";
  }

  std::string xml() const {
    std::string xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" "
        "xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\"";
    if (cloud_.normals) xml += " xmlns:nor=\"http://www.libe57.org/E57_EXT_surface_normals.txt\"";
    if (cloud_.labels) xml += " xmlns:las=\"http://www.astm.org/COMMIT/E57/2010-las-v1.0\"";
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

  StreamedCloud cloud_;
  std::vector<WrittenScan> scans_;
  std::string crs_;
  std::uint64_t seed_;
  std::uint64_t xml_begin_ = 0;
  std::string xml_;
};

/// The cloud's points, those of each sensor together.
struct E57Order {
  std::vector<std::uint32_t> points;
  std::vector<std::span<const std::uint32_t>> scans;  ///< in the order of `written`
  std::vector<WrittenScan> written;

  explicit E57Order(const Cloud& cloud) : points(cloud.size()) {
    const std::size_t sensors = cloud.sensors.size();
    const bool several = sensors > 1 && !cloud.source.empty();
    std::vector<std::size_t> begins((several ? sensors : 1) + 1, 0);
    if (several) {
      for (const auto s : cloud.source) ++begins[s + 1U];
      std::partial_sum(begins.begin(), begins.end(), begins.begin());
      auto next = begins;
      for (std::size_t i = 0; i < cloud.size(); ++i) points[next[cloud.source[i]]++] = static_cast<std::uint32_t>(i);
    } else {
      begins[1] = cloud.size();
      std::iota(points.begin(), points.end(), 0U);
    }
    for (std::size_t s = 0; s + 1 < begins.size(); ++s) {
      const auto some = std::span(points).subspan(begins[s], begins[s + 1] - begins[s]);
      if (some.empty() && begins.size() > 2) continue;
      WrittenScan scan;
      scan.points = some.size();
      if (several || sensors == 1) scan.place = cloud.origin + cloud.sensors[s].cast<double>();
      scan.bounds = bounds_xml(cloud, some, cloud.origin - scan.place.value_or(Eigen::Vector3d::Zero()));
      written.push_back(std::move(scan));
      scans.push_back(some);
    }
  }
};

std::uint64_t seed_of(const Cloud& cloud) {
  std::uint64_t hash = cloud.size();
  for (std::size_t p = 0; p < cloud.size(); p += 1 + cloud.size() / 100)
    for (int a = 0; a < 3; ++a) hash = mix_seed(hash, std::bit_cast<std::uint32_t>(cloud.points[p][a]));
  return hash;
}

class E57Stream : public CloudStream {
 public:
  E57Stream(const StreamedCloud& cloud, AtomicFile& file)
      : layout_(cloud, scans_of(cloud), "", mix_seed(cloud.points, cloud.scans.size())), out_(file) {
    layout_.write_head(out_);
  }

  void append(const Cloud& piece) override {
    add_to(pending_, piece);
    write_packets(false);
  }
  void finish() override {
    write_packets(true);
    layout_.write_end(out_);
  }

 private:
  static std::vector<WrittenScan> scans_of(const StreamedCloud& cloud) {
    std::vector<WrittenScan> scans;
    for (const auto& from : cloud.scans) {
      scans.emplace_back();
      scans.back().points = from.points;
      scans.back().place = from.place;
    }
    if (!scans.empty()) return scans;
    scans.emplace_back();
    scans.back().points = cloud.points;
    return scans;
  }

  /// Whole packets; `all`: also those that end a scan before they are full.
  void write_packets(bool all) {
    std::size_t at = 0;
    std::vector<std::uint32_t> order;
    std::string packet;
    const auto& scans = layout_.scans();
    while (scan_ < scans.size()) {
      const WrittenScan& scan = scans[scan_];
      if (!begun_) E57Layout::begin_section(scan, out_);
      begun_ = true;
      const std::size_t records = std::min(scan.packet_records, scan.points - done_);
      if (records > pending_.size() - at) break;  // not there yet
      if (records > 0) {
        order.resize(records);
        std::iota(order.begin(), order.end(), static_cast<std::uint32_t>(at));
        fill_packet(scan, pending_, order, packet);
        out_.text(packet);
        at += records;
        done_ += records;
      }
      if (done_ < scan.points) continue;
      E57Layout::end_section(scan, out_);
      ++scan_;
      done_ = 0;
      begun_ = false;
    }
    drop_first(pending_, at);
    if (all && (scan_ < scans.size() || pending_.size() > 0))
      throw Error("other points were written than were announced");
  }

  E57Layout layout_;
  E57PageWriter out_;
  Cloud pending_;
  std::size_t scan_ = 0, done_ = 0;
  bool begun_ = false;
};

}  // namespace

void write_e57(const Cloud& cloud, const std::string& crs, AtomicFile& file) {
  E57Order order(cloud);
  const E57Layout layout(StreamedCloud::of(cloud), std::move(order.written), crs, seed_of(cloud));
  E57PageWriter out(file);
  layout.write_head(out);
  std::string packet;
  for (std::size_t s = 0; s < layout.scans().size(); ++s) {
    const WrittenScan& scan = layout.scans()[s];
    E57Layout::begin_section(scan, out);
    for (std::size_t first = 0; first < scan.points; first += scan.packet_records) {
      fill_packet(scan, cloud, order.scans[s].subspan(first, std::min(scan.packet_records, scan.points - first)),
                  packet);
      out.text(packet);
    }
    E57Layout::end_section(scan, out);
  }
  layout.write_end(out);
}

std::unique_ptr<CloudStream> e57_stream(const StreamedCloud& cloud, AtomicFile& file) {
  return std::make_unique<E57Stream>(cloud, file);
}

}  // namespace atrium::io
