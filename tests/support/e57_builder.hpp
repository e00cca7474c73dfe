#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "modules/io/crc32c.hpp"

namespace atrium::test {

/// A field of an E57 scan: its element in the prototype, and the bits of each record.
struct E57Stream {
  std::string xml;
  unsigned bits = 32;
  std::vector<std::uint64_t> values;
};

inline E57Stream f32(const std::string& name, const std::vector<double>& values) {
  E57Stream stream{"<" + name + " type=\"Float\" precision=\"single\"/>", 32, {}};
  for (const double v : values) stream.values.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(v)));
  return stream;
}
inline E57Stream f64(const std::string& name, const std::vector<double>& values) {
  E57Stream stream{"<" + name + " type=\"Float\"/>", 64, {}};
  for (const double v : values) stream.values.push_back(std::bit_cast<std::uint64_t>(v));
  return stream;
}
/// Integers from low to high; `more`: scale and offset.
inline E57Stream integers(const std::string& name, std::int64_t low, std::int64_t high,
                          const std::vector<std::int64_t>& values, const std::string& more = {}) {
  const auto range = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
  E57Stream stream{"<" + name + " type=\"" + (more.empty() ? "Integer" : "ScaledInteger") + "\" minimum=\"" +
                       std::to_string(low) + "\" maximum=\"" + std::to_string(high) + "\" " + more + "/>",
                   static_cast<unsigned>(std::bit_width(range)),
                   {}};
  for (const auto v : values) stream.values.push_back(static_cast<std::uint64_t>(v) - static_cast<std::uint64_t>(low));
  return stream;
}

struct E57TestScan {
  std::vector<E57Stream> streams;
  std::string xml;               ///< pose, limits and so on
  std::size_t packet_bytes = 7;  ///< of the first stream; each further one has one more: values cross packets
  bool other_packets = false;    ///< index and empty packets between those with data
  std::int64_t records = -1;     ///< if it is to be another number than there are
};

/// Makes E57 files as no writer does: any field, any packets, anything wrong.
class E57Builder {
 public:
  std::string before_root, root_attributes, root_xml;

  E57Builder& add(const E57TestScan& scan) {
    const std::uint64_t begin = content_.size();
    content_ += section(scan, begin);
    const std::size_t records = scan.streams.empty() ? 0 : scan.streams.front().values.size();
    scans_ += "<vectorChild type=\"Structure\">" + scan.xml + "<points type=\"CompressedVector\" fileOffset=\"" +
              std::to_string(physical(begin)) + "\" recordCount=\"" +
              std::to_string(scan.records < 0 ? static_cast<std::int64_t>(records) : scan.records) +
              "\"><prototype type=\"Structure\">";
    for (const auto& stream : scan.streams) scans_ += stream.xml;
    scans_ += "</prototype></points></vectorChild>";
    return *this;
  }
  /// A scan whose XML is given whole.
  E57Builder& add_xml(const std::string& xml) {
    scans_ += xml;
    return *this;
  }

  std::string file() const {
    std::string content = content_;
    const std::string xml = before_root + "<?xml version=\"1.0\" encoding=\"UTF-8\"?><e57Root type=\"Structure\" " +
                            root_attributes + ">" + root_xml + "<data3D type=\"Vector\">" + scans_ +
                            "</data3D></e57Root>";
    const std::uint64_t xml_begin = content.size();
    content += xml;
    std::string head = "ASTM-E57";
    number<std::uint32_t>(head, 1);
    number<std::uint32_t>(head, 0);
    number<std::uint64_t>(head, (content.size() + 1019) / 1020 * 1024);
    number<std::uint64_t>(head, physical(xml_begin));
    number<std::uint64_t>(head, xml.size());
    number<std::uint64_t>(head, 1024);
    content.replace(0, head.size(), head);
    return paged(content);
  }

  /// Pages with their checksums.
  static std::string paged(std::string content) {
    content.resize((content.size() + 1019) / 1020 * 1020);
    std::string file;
    for (std::size_t at = 0; at < content.size(); at += 1020) {
      file += content.substr(at, 1020);
      const std::uint32_t sum = io::crc32c(reinterpret_cast<const std::byte*>(content.data() + at), 1020);
      for (int i = 3; i >= 0; --i) file += static_cast<char>(sum >> (8 * i) & 0xFFU);
    }
    return file;
  }
  static std::uint64_t physical(std::uint64_t logical) { return logical / 1020 * 1024 + logical % 1020; }

 private:
  template <class T>
  static void number(std::string& to, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    to.append(raw, sizeof(T));
  }

  static std::string packed(const E57Stream& stream) {
    std::string bytes((stream.bits * stream.values.size() + 7) / 8, '\0');
    std::size_t at = 0;
    for (const auto value : stream.values)
      for (unsigned b = 0; b < stream.bits; ++b, ++at)
        if ((value >> b & 1U) != 0) bytes[at / 8] = static_cast<char>(bytes[at / 8] | 1 << at % 8);
    return bytes;
  }

  static std::string section(const E57TestScan& scan, std::uint64_t begin) {
    std::vector<std::string> streams;
    for (const auto& stream : scan.streams) streams.push_back(packed(stream));
    std::string packets;
    std::vector<std::size_t> done(streams.size(), 0);
    for (bool more = true; more;) {
      more = false;
      std::string lengths, data;
      for (std::size_t s = 0; s < streams.size(); ++s) {
        const std::string some = streams[s].substr(done[s], scan.packet_bytes + s);
        done[s] += some.size();
        more = more || done[s] < streams[s].size();
        number<std::uint16_t>(lengths, static_cast<std::uint16_t>(some.size()));
        data += some;
      }
      const std::size_t size = (6 + lengths.size() + data.size() + 3) / 4 * 4;
      std::string packet("\1\0", 2);
      number<std::uint16_t>(packet, static_cast<std::uint16_t>(size - 1));
      number<std::uint16_t>(packet, static_cast<std::uint16_t>(streams.size()));
      packet += lengths + data;
      packet.resize(size);
      packets += packet;
      if (scan.other_packets)
        packets += std::string("\0\0\x0F\0", 4) + std::string(12, '\7') + std::string("\2\0\7\0aaaa", 8);
    }
    std::string section("\1\0\0\0\0\0\0\0", 8);
    number<std::uint64_t>(section, 32 + packets.size());
    number<std::uint64_t>(section, physical(begin + 32));
    number<std::uint64_t>(section, 0);
    return section + packets;
  }

  std::string content_ = std::string(48, '\0'), scans_;
};

}  // namespace atrium::test
