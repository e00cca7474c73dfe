#include "modules/io/joined_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "graph/api/error.hpp"
#include "modules/io/column_source.hpp"
#include "modules/io/decode.hpp"

namespace atrium::io {
namespace {

std::string file_name(const RawGeometry& part) { return std::filesystem::path(part.path).filename().string(); }

class JoinedSource : public PointSource {
 public:
  /// `places`: whether all scanners' places are known.
  JoinedSource(std::vector<RawGeometry> parts, bool places, const Context& context) : parts_(std::move(parts)) {
    std::size_t sensors = 0;
    for (const auto& part : parts_) {
      Part made;
      made.source = part.source;
      if (!made.source) made.source = std::make_shared<const ColumnSource>(part, context);
      made.first_block = blocks_;
      made.first_sensor = sensors;
      blocks_ += made.source->blocks();
      sensors += part.sensors.size();
      samples_ += made.source->samples();
      sources_.push_back(std::move(made));
    }
    keep_common_roles(context);
    withdraw(Role::source);
    if (places) provide(Role::source);
  }

  std::size_t blocks() const override { return blocks_; }
  std::size_t capacity(std::size_t block) const override {
    const Part& part = part_of(block);
    return part.source->capacity(block - part.first_block);
  }
  void read(std::size_t block, PointBlock& to) const override {
    const Part& part = part_of(block);
    part.source->read(block - part.first_block, to);
    if (!has(Role::source)) return;
    auto& numbers = to.of(Role::source);
    const auto first = static_cast<double>(part.first_sensor);
    const bool own = part.source->has(Role::source);
    numbers.resize(std::max(numbers.size(), to.size));
    for (std::size_t i = 0; i < to.size; ++i) numbers[i] = (own ? numbers[i] : 0) + first;
  }
  std::size_t samples() const override { return samples_; }

 private:
  struct Part {
    std::shared_ptr<const PointSource> source;
    std::size_t first_block = 0, first_sensor = 0;
  };

  const Part& part_of(std::size_t block) const {
    const auto after = std::upper_bound(sources_.begin(), sources_.end(), block,
                                        [](std::size_t b, const Part& part) { return b < part.first_block; });
    return *std::prev(after);
  }

  void keep_common_roles(const Context& context) {
    constexpr std::pair<Role, const char*> named[] = {
        {Role::nx, "normals"}, {Role::red, "colours"}, {Role::intensity, "intensities"}, {Role::label, "labels"}};
    for (std::size_t r = 0; r < role_count; ++r) {
      const auto role = static_cast<Role>(r);
      const auto with = static_cast<std::size_t>(
          std::count_if(sources_.begin(), sources_.end(), [&](const Part& part) { return part.source->has(role); }));
      if (with == sources_.size()) provide(role);
      if (with == 0 || with == sources_.size()) continue;
      for (const auto& [of, name] : named)
        if (of == role)
          context.warn(fmt::format("{} of {} files have no {}: they are left out", sources_.size() - with,
                                   sources_.size(), name));
    }
  }

  std::vector<RawGeometry> parts_;
  std::vector<Part> sources_;
  std::size_t blocks_ = 0, samples_ = 0;
};

void check_frames(const std::vector<RawGeometry>& parts, const Context& context) {
  const RawGeometry& first = parts.front();
  for (const auto& part : parts) {
    if (!part.triangles.empty())
      throw Error(part.path + ": it has faces, and only points are joined with other files",
                  "read it by itself, or its vertices with mesh: vertices");
    if (!part.crs.empty() && !first.crs.empty() && part.crs != first.crs)
      throw Error(fmt::format("{} is in another reference system than {}: '{}', not '{}'", part.path, file_name(first),
                              part.crs.substr(0, 100), first.crs.substr(0, 100)),
                  "bring the files into one system first");
    if (part.crs.empty() != first.crs.empty())
      context.warn(fmt::format("{} names a reference system and {} does not: they are taken to be in the same",
                               file_name(part.crs.empty() ? first : part), file_name(part.crs.empty() ? part : first)));
    if (part.metres_per_unit && first.metres_per_unit && *part.metres_per_unit != *first.metres_per_unit)
      throw Error(fmt::format("{} is in units of {:g} m, and {} in units of {:g} m", part.path, *part.metres_per_unit,
                              file_name(first), *first.metres_per_unit),
                  "bring the files into one unit first");
    if (part.y_up != first.y_up)
      context.warn(fmt::format("{} is of a format that usually has {} up, and {} {}: they are joined as they are",
                               file_name(part), part.y_up ? 'y' : 'z', file_name(first), first.y_up ? 'y' : 'z'));
  }
}

/// The place that the file names as its viewpoint, where it is not the default.
void take_viewpoint(RawGeometry& part) {
  if (part.sensors.empty() && part.viewpoint && part.viewpoint->allFinite() && !part.viewpoint->isZero(0))
    part.sensors = {*part.viewpoint};
}

}  // namespace

RawGeometry joined(std::vector<RawGeometry> parts, const Context& context) {
  constexpr std::size_t most_sensors = 65536;  // a point's source has 16 bits
  check_frames(parts, context);
  RawGeometry all;
  all.path = fmt::format("{} and {} more", parts.front().path, parts.size() - 1);
  all.y_up = parts.front().y_up;
  std::size_t known = 0;
  for (auto& part : parts) {
    take_viewpoint(part);
    const bool told = part.source ? part.source->has(Role::source) : bool(part.column(Role::source));
    if (part.sensors.size() > 1 && !told) part.sensors.clear();  // which saw what is not known
    known += part.sensors.empty() ? 0 : 1;
    all.count += part.count;
    if (all.crs.empty()) all.crs = part.crs;
    all.float_table = all.float_table || has_float_positions(part);
    if (!all.metres_per_unit) all.metres_per_unit = part.metres_per_unit;
    all.sensors.insert(all.sensors.end(), part.sensors.begin(), part.sensors.end());
    all.files.insert(all.files.end(), part.files.begin(), part.files.end());
  }
  if (known < parts.size()) all.sensors.clear();
  if (known > 0 && known < parts.size())
    context.warn(fmt::format("{} of {} files do not say where their scanner stood: no place is used",
                             parts.size() - known, parts.size()));
  if (all.sensors.size() > most_sensors)
    throw Error(fmt::format("{}: {} scanner positions; the most that can be handled are {}", all.path,
                            all.sensors.size(), most_sensors));
  const bool places = all.sensors.size() > 1;
  all.source = std::make_shared<const JoinedSource>(std::move(parts), places, context);
  return all;
}

}  // namespace atrium::io
