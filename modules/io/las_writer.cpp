#include "modules/io/las_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

#include "graph/api/error.hpp"
#include "modules/io/byte_buffer.hpp"
#include "modules/io/las_point.hpp"
#include "modules/io/laz_writer.hpp"

namespace atrium::io {
namespace {

constexpr std::size_t longest_record = 65535;

template <class T>
void put_number(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void put_text(std::string& bytes, std::string_view text, std::size_t size) {
  bytes += text.substr(0, size);
  bytes.append(size - std::min(size, text.size()), '\0');
}

/// The code of "EPSG:25832", if it is one that GeoTIFF keys hold; else 0.
std::uint16_t epsg_code(const std::string& crs) {
  std::uint16_t code = 0;
  if (!crs.starts_with("EPSG:")) return 0;
  const char* end = crs.data() + crs.size();
  const auto [stop, error] = std::from_chars(crs.data() + 5, end, code);
  return error == std::errc{} && stop == end ? code : std::uint16_t{0};
}

class LasWriter {
 public:
  LasWriter(const Cloud& cloud, const std::string& crs, const std::string& path, bool compressed,
            const Context& context)
      : cloud_(cloud), crs_(crs), compressed_(compressed), context_(context), points_(cloud.size()) {
    choose_labels(path);
    const bool wide = has_labels_ && largest_label_ > 31;
    type_ = wide ? (cloud.colours.empty() ? 6 : 7) : (cloud.colours.empty() ? 0 : 2);
    wkt_ = !crs.empty() && !crs.starts_with("EPSG:") && crs.size() < longest_record;
    minor_ = wide || wkt_ ? 4 : 2;
    if (!cloud.normals.empty()) context.warn(path + ": normals are not kept by this format");
    find_bounds();
    choose_intensity();
    variable_records();
  }

  void write(AtomicFile& file) const {
    ByteBuffer out(file);
    const std::string head = header();
    out.text(head);
    if (compressed_) {
      std::string all;
      all.reserve(cloud_.size() * record_size());
      for (std::size_t i = 0; i < cloud_.size(); ++i) put_record(cloud_, i, all);
      out.text(LazWriter::compressed(all, type_, head.size(), context_));
    } else {
      std::string record;
      for (std::size_t i = 0; i < cloud_.size(); ++i) {
        record.clear();
        put_record(cloud_, i, record);
        out.text(record);
      }
    }
    out.flush();
  }

  std::string header() const {
    const std::uint16_t size = minor_ == 4 ? 375 : 227;
    std::string h = "LASF";
    put_number<std::uint16_t>(h, 0);
    put_number<std::uint16_t>(h, wkt_ ? 16 : 0);
    put_text(h, "", 16);
    put_number<std::uint8_t>(h, 1);
    put_number(h, static_cast<std::uint8_t>(minor_));
    put_text(h, "Atrium", 32);
    put_text(h, "Atrium", 32);
    put_number<std::uint32_t>(h, 0);  // no date: the same cloud gives the same bytes
    put_number(h, size);
    put_number(h, static_cast<std::uint32_t>(size + records_.size()));
    put_number(h, record_count_);
    put_number(h, static_cast<std::uint8_t>(type_ | (compressed_ ? 128 : 0)));
    put_number(h, static_cast<std::uint16_t>(record_size()));
    const std::uint64_t points = points_;
    const bool legacy = type_ < 6;
    put_number(h, static_cast<std::uint32_t>(legacy ? points : 0));
    for (int r = 0; r < 5; ++r) put_number(h, static_cast<std::uint32_t>(legacy && r == 0 ? points : 0));
    for (int a = 0; a < 3; ++a) put_number(h, scale_);
    for (int a = 0; a < 3; ++a) put_number(h, cloud_.origin[a]);
    for (int a = 0; a < 3; ++a) {
      put_number(h, place(high_[a], a));
      put_number(h, place(low_[a], a));
    }
    if (minor_ == 4) {
      for (int i = 0; i < 2; ++i) put_number<std::uint64_t>(h, 0);
      put_number<std::uint32_t>(h, 0);
      put_number(h, points);
      for (int r = 0; r < 15; ++r) put_number<std::uint64_t>(h, r == 0 ? points : 0);
    }
    return h + records_;
  }

  /// A point of the cloud, or of a piece with the same columns.
  void put_record(const Cloud& cloud, std::size_t i, std::string& to) const {
    for (int a = 0; a < 3; ++a) put_number(to, steps(cloud.points[i][a]));
    const double intensity = cloud.intensities.empty() ? 0 : static_cast<double>(cloud.intensities[i]);
    put_number(to, static_cast<std::uint16_t>(std::clamp(std::round(intensity * intensity_factor_), 0.0, 65535.0)));
    const auto label = static_cast<std::uint8_t>(has_labels_ ? cloud.labels[i] : 0);
    if (type_ < 6) {
      put_number<std::uint8_t>(to, 1 | 1 << 3);  // the one return of one
      put_number(to, label);
      put_text(to, "", 4);  // angle, user data, source
    } else {
      put_number<std::uint8_t>(to, 1 | 1 << 4);
      put_number<std::uint8_t>(to, 0);
      put_number(to, label);
      put_text(to, "", 13);  // user data, angle, source, time
    }
    if (type_ == 2 || type_ == 7)
      for (const auto v : cloud.colours[i]) put_number(to, static_cast<std::uint16_t>(v * 257));
  }

  /// For a cloud that comes in pieces: how many points there will be, and how far they reached.
  void announce(std::size_t points) { points_ = points; }
  void extend_bounds(const Cloud& piece, bool first) {
    for (const auto& p : piece.points) {
      low_ = first ? p : low_.cwiseMin(p);
      high_ = first ? p : high_.cwiseMax(p);
      first = false;
    }
  }

 private:
  std::size_t record_size() const {
    return static_cast<std::size_t>(las_records[static_cast<std::size_t>(type_)].size);
  }

  void choose_labels(const std::string& path) {
    if (cloud_.labels.empty()) return;
    const auto [low, high] = std::minmax_element(cloud_.labels.begin(), cloud_.labels.end());
    const std::int32_t most = compressed_ ? 31 : 255;
    has_labels_ = *low >= 0 && *high <= most;
    largest_label_ = *high;
    if (!has_labels_)
      context_.warn(
          fmt::format("{}: labels from {} to {} are not kept: this format has 0 to {}", path, *low, *high, most));
  }

  void find_bounds() {
    if (cloud_.points.empty()) return;
    low_ = high_ = cloud_.points.front();
    for (const auto& p : cloud_.points) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
    constexpr double largest = 2e9;  // steps: a coordinate has 32 bits
    const auto reach = static_cast<double>(std::max(low_.cwiseAbs().maxCoeff(), high_.cwiseAbs().maxCoeff()));
    while (reach / scale_ > largest) scale_ *= 10;
  }

  void choose_intensity() {
    float most = 0;
    for (const float v : cloud_.intensities) most = std::max(most, v);
    if (most <= 1)
      intensity_factor_ = 65535;
    else if (most > 65535)
      intensity_factor_ = 65535 / static_cast<double>(most);
  }

  void variable_records() {
    const auto add = [&](std::string_view user, std::uint16_t id, std::string_view what, const std::string& data) {
      put_number<std::uint16_t>(records_, 0);
      put_text(records_, user, 16);
      put_number(records_, id);
      put_number(records_, static_cast<std::uint16_t>(data.size()));
      put_text(records_, what, 32);
      records_ += data;
      ++record_count_;
    };
    if (wkt_) add("LASF_Projection", 2112, "OGC coordinate system WKT", crs_ + '\0');
    if (const std::uint16_t code = epsg_code(crs_); code != 0) {
      std::string keys;
      constexpr std::uint16_t metre = 9001;
      for (const std::uint16_t v : {1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, int{code}, 3076, 0, 1, int{metre}})
        put_number(keys, static_cast<std::uint16_t>(v));
      add("LASF_Projection", 34735, "GeoTIFF keys", keys);
    }
    if (compressed_) add("laszip encoded", 22204, "LASzip", LazWriter::description(type_));
  }

  /// As a reader will have it.
  double place(float local, int axis) const { return steps(local) * scale_ + cloud_.origin[axis]; }
  std::int32_t steps(float local) const {
    return static_cast<std::int32_t>(std::llround(static_cast<double>(local) / scale_));
  }

  const Cloud& cloud_;
  const std::string& crs_;
  bool compressed_;
  const Context& context_;
  std::size_t points_;
  int type_ = 0, minor_ = 2;
  bool has_labels_ = false, wkt_ = false;
  std::int32_t largest_label_ = 0;
  Eigen::Vector3f low_ = Eigen::Vector3f::Zero(), high_ = Eigen::Vector3f::Zero();
  double scale_ = 1e-4, intensity_factor_ = 1;
  std::string records_;
  std::uint32_t record_count_ = 0;
};

/// A cloud of one point with the columns of the pieces.
Cloud sample_cloud(const StreamedCloud& cloud) {
  Cloud sample;
  sample.origin = cloud.origin;
  sample.points.resize(1, Eigen::Vector3f::Zero());
  sample.normals.resize(cloud.normals ? 1 : 0);
  sample.colours.resize(cloud.colours ? 1 : 0);
  sample.intensities.resize(cloud.intensities ? 1 : 0);
  return sample;
}

/// The header, which has the bounds, is written once more when all points are there.
class LasStream : public CloudStream {
 public:
  LasStream(const StreamedCloud& cloud, AtomicFile& file, const Context& context)
      : path_(file.path()),
        sample_(sample_cloud(cloud)),
        writer_(sample_, crs_, path_.filename().string(), false, context),
        announced_(cloud.points),
        stream_(path_, std::ios::binary) {
    if (cloud.labels) context.warn("labels are not kept in .las files that are written in pieces");
    if (!cloud.scans.empty()) context.warn("the scanners' places are not kept by .las files");
    writer_.announce(announced_);
    put(writer_.header());
  }
  void append(const Cloud& piece) override {
    writer_.extend_bounds(piece, written_ == 0);
    std::string records;
    for (std::size_t i = 0; i < piece.size(); ++i) writer_.put_record(piece, i, records);
    put(records);
    written_ += piece.size();
  }
  void finish() override {
    if (written_ != announced_) throw Error("other points were written than were announced");
    stream_.seekp(0);
    put(writer_.header());
    stream_.close();
    if (!stream_) fail();
  }

 private:
  void put(const std::string& bytes) {
    errno = 0;
    if (!stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()))) fail();
  }
  [[noreturn]] void fail() const {
    throw Error("cannot write " + path_.string() + ": " + std::strerror(errno == 0 ? EIO : errno));
  }

  std::filesystem::path path_;
  std::string crs_;
  Cloud sample_;
  LasWriter writer_;
  std::size_t announced_, written_ = 0;
  std::ofstream stream_;
};

}  // namespace

std::unique_ptr<CloudStream> las_stream(const StreamedCloud& cloud, AtomicFile& file, const Context& context) {
  return std::make_unique<LasStream>(cloud, file, context);
}

void write_las(const Cloud& cloud, const std::string& crs, const std::string& path, bool compressed, AtomicFile& file,
               const Context& context) {
  LasWriter(cloud, crs, path, compressed, context).write(file);
}

}  // namespace atrium::io
