#include "modules/io/las_header.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "graph/api/error.hpp"
#include "modules/io/las_point.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

constexpr std::size_t shortest_header = 227, header_1_4 = 375;
const char* const export_again = "copy or export the file again";

class LasHeaderReader {
 public:
  explicit LasHeaderReader(const MappedFile& file) : file_(file) {}

  LasHeader read() {
    if (file_.size() < shortest_header)
      fail(fmt::format("truncated: {} bytes are less than the header of a LAS file", file_.size()), export_again);
    if (!file_.text().starts_with("LASF")) fail("not a LAS file: it does not begin with LASF");
    const auto major = number<std::uint8_t>(24);
    header_.minor = number<std::uint8_t>(25);
    if (major != 1 || header_.minor > 4)
      fail(fmt::format("version {}.{} of LAS; 1.0 to 1.4 are known", major, header_.minor));
    read_records();
    read_scale();
    read_variable_records();
    if (header_.compressed) check_compressed();
    return header_;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& help = {}) const {
    throw Error(file_.path() + ": " + what, help);
  }
  template <class T>
  T number(std::size_t at) const {
    return load<T>(file_.data() + at);
  }

  void read_records() {
    const auto type = number<std::uint8_t>(104);
    header_.compressed = (type & 128U) != 0;
    header_.type = type & 63U;
    if (header_.type >= static_cast<int>(las_records.size()))
      fail(fmt::format("byte 104: records of type {}; 0 to 10 are known", header_.type));
    header_.record = number<std::uint16_t>(105);
    const auto least = static_cast<std::size_t>(las_records[static_cast<std::size_t>(header_.type)].size);
    if (header_.record < least)
      fail(fmt::format("byte 105: records of {} bytes, but type {} has {}", header_.record, header_.type, least));
    header_.extra = header_.record - least;
    header_.points = number<std::uint32_t>(107);
    const bool has_1_4 = header_.minor >= 4 && number<std::uint16_t>(94) >= header_1_4 && file_.size() >= header_1_4;
    if (has_1_4)
      if (const auto points = number<std::uint64_t>(247); points > 0) header_.points = points;
    header_.data = number<std::uint32_t>(96);
    if (header_.data < shortest_header || header_.data > file_.size())
      fail(fmt::format("byte 96: the points are to begin at byte {}, but the file has {}", header_.data, file_.size()),
           export_again);
    if (!header_.compressed && header_.points > (file_.size() - header_.data) / header_.record)
      fail(fmt::format("truncated: {} × {} bytes are to follow byte {}, but the file has {} bytes", header_.points,
                       header_.record, header_.data, file_.size()),
           "the header promises more than the file holds: copy or export it again");
  }

  void read_scale() {
    for (int a = 0; a < 3; ++a) {
      header_.scale[a] = number<double>(131 + 8 * static_cast<std::size_t>(a));
      header_.offset[a] = number<double>(155 + 8 * static_cast<std::size_t>(a));
      if (!std::isfinite(header_.scale[a]) || header_.scale[a] == 0 || !std::isfinite(header_.offset[a]))
        fail(fmt::format("bytes 131 and 155: a scale of {} and an offset of {} for {}", header_.scale[a],
                         header_.offset[a], "xyz"[a]));
    }
  }

  void read_variable_records() {
    constexpr std::size_t head = 54, extended_head = 60;
    std::size_t at = number<std::uint16_t>(94);
    const auto count = number<std::uint32_t>(100);
    for (std::uint32_t i = 0; i < count && at + head <= header_.data; ++i) {
      const std::size_t length = number<std::uint16_t>(at + 20);
      if (length > header_.data - at - head) break;  // some writers count wrong; the points are where the header says
      take_record(at, at + head, length);
      at += head + length;
    }
    if (header_.minor < 4 || number<std::uint16_t>(94) < header_1_4 || file_.size() < header_1_4) return;
    std::uint64_t place = number<std::uint64_t>(235);
    for (std::uint32_t i = 0; i < number<std::uint32_t>(243); ++i) {
      if (place > file_.size() || file_.size() - place < extended_head) break;
      const auto length = number<std::uint64_t>(place + 20);
      if (length > file_.size() - place - extended_head) break;
      take_record(place, place + extended_head, length);
      place += extended_head + length;
    }
  }

  void take_record(std::size_t at, std::size_t data, std::size_t length) {
    const std::string_view all = file_.text().substr(at + 2, 16);
    const std::string_view user = all.substr(0, all.find('\0'));
    const auto id = number<std::uint16_t>(at + 18);
    if (user == "LASF_Projection" && id == 2112 && length > 0)
      header_.crs = crs_of_wkt(file_.text().substr(data, length));  // goes before the keys
    else if (user == "LASF_Projection" && id == 34735 && header_.crs.text.empty())
      header_.crs = crs_of_geotiff(file_.data() + data, length);
    else if (user == "laszip encoded" && id == 22204 && length >= 34)
      take_laszip(data, length);
  }

  void take_laszip(std::size_t data, std::size_t length) {
    header_.compressor = number<std::uint16_t>(data);
    header_.chunk_points = number<std::uint32_t>(data + 12);
    const std::size_t items = number<std::uint16_t>(data + 32);
    if (length < 34 + 6 * items) fail(fmt::format("byte {}: the record of LASzip is cut short", data));
    std::size_t size = 0;
    for (std::size_t i = 0; i < items; ++i) {
      const auto type = number<std::uint16_t>(data + 34 + 6 * i);
      const auto version = number<std::uint16_t>(data + 38 + 6 * i);
      size += number<std::uint16_t>(data + 36 + 6 * i);
      const int expected = header_.type >= 6 ? 3 : 2;
      // Version 4 of layered items differs from 3 only in what is not read here.
      if (version != expected && !(expected == 3 && version == 4))
        fail(fmt::format("byte {}: item {} of LASzip in version {}; {} is known", data + 38 + 6 * i, type, version,
                         expected));
    }
    if (size != header_.record)
      fail(fmt::format("byte {}: LASzip's items have {} bytes, but the records have {}", data, size, header_.record));
  }

  void check_compressed() const {
    const bool known = header_.type <= 3 || (header_.type >= 6 && header_.type <= 8);
    if (!known)
      fail(fmt::format("compressed records of type {}, with waveforms", header_.type),
           "uncompress the file to LAS, for example with laszip; known of LAZ: types 0 to 3 and 6 to 8");
    if (header_.compressor == 0)
      fail("compressed points without a record 'laszip encoded' that says how", export_again);
    if (header_.compressor != (header_.type >= 6 ? 3 : 2))
      fail(fmt::format("LASzip's compressor {} for records of type {}", header_.compressor, header_.type),
           "known: 2 (pointwise, in chunks) for types 0 to 3, 3 (layers) for types 6 to 8; compress the file again");
    if (header_.chunk_points == 0 && header_.points > 0) fail("LASzip's chunks are to have 0 points");
  }

  const MappedFile& file_;
  LasHeader header_;
};

}  // namespace

LasHeader read_las_header(const MappedFile& file) { return LasHeaderReader(file).read(); }

}  // namespace atrium::io
