#include "modules/io/las_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <stdexcept>

#include "graph/api/error.hpp"
#include "modules/io/laz_decoder.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

constexpr std::size_t records_of_run = 8192;
constexpr std::uint32_t own_numbers = std::numeric_limits<std::uint32_t>::max();
/// A scan takes 2 bytes a point and more; a file of a few bytes must not fill the memory.
constexpr std::size_t most_points_of_byte = 16;

}  // namespace

LasSource::LasSource(std::shared_ptr<const MappedFile> file, const LasHeader& header, const Context& context)
    : file_(std::move(file)), header_(header), type_(las_records[static_cast<std::size_t>(header.type)]) {
  if (header_.compressed) {
    find_chunks();
  } else {
    for (std::uint64_t first = 0; first < header_.points; first += records_of_run) {
      const auto points = static_cast<std::size_t>(std::min<std::uint64_t>(records_of_run, header_.points - first));
      runs_.push_back(
          {header_.data + static_cast<std::size_t>(first) * header_.record, points * header_.record, points});
    }
  }
  for (const Role role : {Role::x, Role::y, Role::z, Role::intensity, Role::label}) provide(role);
  if (type_.rgb < 0) return;
  for (const Role role : {Role::red, Role::green, Role::blue}) provide(role);
  find_white(context);
}

void LasSource::find_chunks() {
  const auto fail = [&](std::size_t at, const std::string& what) {
    throw Error(fmt::format("{}: byte {}: {}", file_->path(), at, what), "copy or export the file again");
  };
  if (header_.points == 0) return;
  const std::size_t first = header_.data + 8, size = file_->size();
  if (size < first + 8) fail(header_.data, "truncated: no compressed points follow");
  auto table = load<std::int64_t>(file_->data() + header_.data);
  if (table == -1) table = load<std::int64_t>(file_->data() + size - 8);
  if (table < static_cast<std::int64_t>(first) || static_cast<std::uint64_t>(table) > size - 8)
    fail(header_.data,
         fmt::format("LASzip's table of chunks is to be at byte {}, but the file has {} (truncated?)", table, size));
  const auto end = static_cast<std::size_t>(table);
  runs_ = chunk_table(end, size);
  std::size_t at = first;
  std::uint64_t left = header_.points;
  for (auto& run : runs_) {
    run.begin = at;
    if (run.size > end - at || run.size < header_.record)
      fail(end, fmt::format("a chunk of {} bytes at byte {}, before the table", run.size, at));
    at += run.size;
    if (header_.chunk_points != own_numbers) run.points = header_.chunk_points;
    run.points = static_cast<std::size_t>(std::min<std::uint64_t>(run.points, left));
    left -= run.points;
    if (run.points > most_points_of_byte * run.size)
      fail(run.begin, fmt::format("{} points in a chunk of {} bytes: damaged", run.points, run.size));
  }
  if (left > 0)
    fail(end, fmt::format("the header promises {} points, but the {} chunks have {} less", header_.points, runs_.size(),
                          left));
  std::erase_if(runs_, [](const Run& run) { return run.points == 0; });
}

std::vector<LasSource::Run> LasSource::chunk_table(std::size_t at, std::size_t end) const {
  const auto count = load<std::uint32_t>(file_->data() + at + 4);
  // Each chunk has its first record as it is: there are no more than fit into the bytes before the table.
  if (count > (at - header_.data) / header_.record)
    throw Error(fmt::format("{}: byte {}: {} chunks before the table, in {} bytes", file_->path(), at, count,
                            at - header_.data),
                "copy or export the file again");
  LazDecoder decoder(file_->data() + at + 8, end - at - 8);
  LazInteger integer(32, 2);
  std::vector<Run> runs(count);
  std::int32_t points = 0, size = 0;
  for (auto& run : runs) {
    if (header_.chunk_points == own_numbers) points = integer.decode(decoder, points, 0);
    size = integer.decode(decoder, size, 1);
    run.points = static_cast<std::uint32_t>(points);
    run.size = static_cast<std::uint32_t>(size);
  }
  if (decoder.exhausted())
    throw Error(fmt::format("{}: byte {}: LASzip's table of chunks is cut short", file_->path(), at),
                "copy or export the file again");
  return runs;
}

template <class F>
void LasSource::for_points(std::size_t block, F&& take) const {
  const Run& run = runs_[block];
  const std::byte* data = file_->data() + run.begin;
  if (!header_.compressed) {
    for (std::size_t i = 0; i < run.points; ++i, data += header_.record) take(las_point(data, type_));
    return;
  }
  try {
    const auto chunk = header_.compressor == 3 ? layered_chunk(data, run.size, header_.type, header_.extra, run.points)
                                               : pointwise_chunk(data, run.size, header_.type, header_.extra);
    for (std::size_t i = 0; i < run.points; ++i) take(chunk->next());
    if (chunk->exhausted()) throw std::out_of_range("it ends before its last point");
  } catch (const std::out_of_range& error) {
    throw Error(fmt::format("{}: the chunk of {} points in {} bytes at byte {} is damaged: {}", file_->path(),
                            run.points, run.size, run.begin, error.what()),
                "copy or export the file again");
  }
}

void LasSource::read(std::size_t block, PointBlock& to) const {
  to.resize(runs_[block].points, roles());
  double* const x = to.of(Role::x).data();
  double* const y = to.of(Role::y).data();
  double* const z = to.of(Role::z).data();
  double* const intensity = to.of(Role::intensity).data();
  double* const label = to.of(Role::label).data();
  const bool coloured = has(Role::red);
  double* const rgb[3] = {to.of(Role::red).data(), to.of(Role::green).data(), to.of(Role::blue).data()};
  const double factor = 255 / white_;
  const Eigen::Vector3d scale = header_.scale, offset = header_.offset;
  std::size_t kept = 0;
  for_points(block, [&](const LasPoint& p) {
    x[kept] = p.x * scale.x() + offset.x();
    y[kept] = p.y * scale.y() + offset.y();
    z[kept] = p.z * scale.z() + offset.z();
    intensity[kept] = p.intensity;
    label[kept] = p.classification;
    for (std::size_t c = 0; coloured && c < 3; ++c) rgb[c][kept] = p.rgb[c] * factor;
    kept += p.withheld ? 0 : 1;
  });
  to.misses = to.size - kept;
  to.size = kept;
}

bool LasSource::is_wide(std::size_t block) const {
  std::uint16_t most = 0;
  for_points(block, [&](const LasPoint& p) { most = std::max({most, p.rgb[0], p.rgb[1], p.rgb[2]}); });
  return most > 255;
}

void LasSource::find_white(const Context& context) {
  // Most files have 16 bits, and the first block says so; only those of 8 bits are looked through to their end.
  std::atomic<bool> wide = !runs_.empty() && (is_wide(0) || is_wide(runs_.size() / 2));
  context.parallel_for(
      runs_.size(),
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end && !wide; ++b)
          if (is_wide(b)) wide = true;
      },
      1);
  white_ = wide ? 65535 : 255;
}

}  // namespace atrium::io
