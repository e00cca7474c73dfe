#include "modules/io/cloud_stream.hpp"

#include <algorithm>

#include "graph/api/error.hpp"
#include "modules/io/cloud_columns.hpp"
#include "modules/io/e57_writer.hpp"
#include "modules/io/las_writer.hpp"

namespace atrium::io {
namespace {

template <class F>
void for_point_columns(F&& f) {
  f(&Cloud::points);
  f(&Cloud::normals);
  f(&Cloud::colours);
  f(&Cloud::labels);
  f(&Cloud::intensities);
  f(&Cloud::source);
}

class PlyStream : public CloudStream {
 public:
  PlyStream(const StreamedCloud& cloud, AtomicFile& file) : cloud_(cloud), out_(file) {
    Cloud sample;  // has the columns that the pieces have
    sample.origin = cloud.origin;
    sample.points.resize(1);
    sample.normals.resize(cloud.normals ? 1 : 0);
    sample.colours.resize(cloud.colours ? 1 : 0);
    sample.intensities.resize(cloud.intensities ? 1 : 0);
    sample.labels.resize(cloud.labels ? 1 : 0);
    sample.source.resize(cloud.scans.size() > 1 ? 1 : 0);
    write_ply_head(columns_of(sample, false), cloud.points, cloud.scans.size(), true, out_);
  }
  void append(const Cloud& piece) override {
    Cloud sourced;
    const Cloud* from = &piece;
    if (cloud_.scans.size() > 1) {
      sourced = piece;
      sourced.source.resize(piece.size());
      for (auto& source : sourced.source) source = next_source();
      from = &sourced;
    }
    write_records(columns_of(*from, false), from->size(), out_);
    written_ += piece.size();
  }
  void finish() override {
    if (written_ != cloud_.points) throw Error("other points were written than were announced");
    for (const auto& scan : cloud_.scans)
      for (int a = 0; a < 3; ++a) out_.number(scan.place[a]);
    out_.flush();
  }

 private:
  std::uint16_t next_source() {
    while (in_scan_ == cloud_.scans[scan_].points) {
      ++scan_;
      in_scan_ = 0;
    }
    ++in_scan_;
    return static_cast<std::uint16_t>(scan_);
  }

  StreamedCloud cloud_;
  ByteBuffer out_;
  std::size_t written_ = 0, scan_ = 0, in_scan_ = 0;
};

}  // namespace

StreamedCloud StreamedCloud::of(const Cloud& cloud) {
  StreamedCloud result;
  result.points = cloud.size();
  result.origin = cloud.origin;
  result.normals = !cloud.normals.empty();
  result.colours = !cloud.colours.empty();
  result.intensities = !cloud.intensities.empty();
  result.labels = !cloud.labels.empty();
  if (!result.labels) return result;
  const auto [low, high] = std::minmax_element(cloud.labels.begin(), cloud.labels.end());
  result.lowest_label = *low;
  result.highest_label = *high;
  return result;
}

std::unique_ptr<CloudStream> cloud_stream(const StreamedCloud& cloud, const std::string& extension, AtomicFile& file,
                                          const Context& context) {
  if (extension == ".ply") return std::make_unique<PlyStream>(cloud, file);
  if (extension == ".e57") return e57_stream(cloud, file);
  if (extension == ".las") return las_stream(cloud, file, context);
  throw Error("a cloud is not written in pieces as '" + extension + "'", "known: .ply, .e57, .las");
}

void add_to(Cloud& cloud, const Cloud& piece) {
  cloud.origin = piece.origin;
  for_point_columns([&](auto column) {
    (cloud.*column).insert((cloud.*column).end(), (piece.*column).begin(), (piece.*column).end());
  });
}

void drop_first(Cloud& cloud, std::size_t points) {
  for_point_columns([&](auto column) {
    auto& values = cloud.*column;
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(std::min(points, values.size())));
  });
}

}  // namespace atrium::io
