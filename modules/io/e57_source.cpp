#include "modules/io/e57_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "graph/api/error.hpp"

namespace atrium::io {
namespace {

constexpr std::size_t records_of_block = 8192;
constexpr Role xyz[3] = {Role::x, Role::y, Role::z};
constexpr Role rgb[3] = {Role::red, Role::green, Role::blue};

constexpr std::pair<Role, const char*> field_names[] = {
    {Role::nx, "normalX"},          {Role::ny, "normalY"},          {Role::nz, "normalZ"},
    {Role::red, "colorRed"},        {Role::green, "colorGreen"},    {Role::blue, "colorBlue"},
    {Role::intensity, "intensity"}, {Role::label, "classification"}};

/// Range, azimuth, elevation (metres, radians) to x, y, z.
void to_cartesian(PointBlock& block) {
  auto &x = block.of(Role::x), &y = block.of(Role::y), &z = block.of(Role::z);
  for (std::size_t i = 0; i < block.size; ++i) {
    const double range = x[i], azimuth = y[i], elevation = z[i];
    const double across = range * std::cos(elevation);
    x[i] = across * std::cos(azimuth);
    y[i] = across * std::sin(azimuth);
    z[i] = range * std::sin(elevation);
  }
}

/// Keeps the points for which keep(i) holds; the others are misses.
template <class Keep>
void remove_misses(PointBlock& block, const std::array<bool, role_count>& roles, Keep&& keep) {
  std::vector<std::uint32_t> kept;
  kept.reserve(block.size);
  for (std::size_t i = 0; i < block.size; ++i)
    if (keep(i)) kept.push_back(static_cast<std::uint32_t>(i));
  block.misses += block.size - kept.size();
  if (kept.size() == block.size) return;
  for (std::size_t r = 0; r < role_count; ++r) {
    if (!roles[r]) continue;
    auto& values = block.values[r];
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  }
  block.size = kept.size();
}

bool is_zero(const PointBlock& block, std::size_t i) {
  return block.of(Role::x)[i] == 0 && block.of(Role::y)[i] == 0 && block.of(Role::z)[i] == 0;
}

/// From limits, or else from the range of the field's numbers (given only where that is one of colours: 0 … 255,
/// 0 … 65535).
std::optional<E57Limits> range_of(const E57Scan& scan, int field, const std::optional<E57Limits>& limits) {
  if (limits) return limits;
  const E57Field& f = scan.fields[static_cast<std::size_t>(field)];
  if (f.kind != E57Field::Kind::integer || f.bits == 0 || f.bits > 32) return std::nullopt;
  const E57Limits own{static_cast<double>(f.minimum) * f.scale + f.offset,
                      static_cast<double>(f.maximum) * f.scale + f.offset};
  return own.low < own.high ? std::optional(own) : std::nullopt;
}

void scale_to(std::vector<double>& values, std::size_t size, const E57Limits& limits, double most) {
  const double factor = most / (limits.high - limits.low);
  for (std::size_t i = 0; i < size; ++i) values[i] = (values[i] - limits.low) * factor;
}

}  // namespace

E57Source::E57Source(std::shared_ptr<const MappedFile> file, E57Contents contents, const Context& context)
    : pages_(std::move(file)), contents_(std::move(contents)) {
  for (const auto& scan : contents_.scans) scans_.push_back(prepared(scan, context));
  check_overlap();
  keep_common_roles();
  for (std::size_t s = 0; s < scans_.size(); ++s) {
    const std::uint64_t records = contents_.scans[s].records;
    records_ += records;
    for (std::uint64_t first = 0; first < records; first += records_of_block)
      blocks_.push_back(
          {s, first, static_cast<std::size_t>(std::min<std::uint64_t>(records_of_block, records - first))});
    look_at_first_block(s);
  }
}

E57Source::Scan E57Source::prepared(const E57Scan& scan, const Context& context) const {
  Scan made;
  made.of_role.fill(-1);
  const auto want = [&](Role role, const char* name) {
    const int field = scan.field(name);
    if (field < 0 || scan.fields[static_cast<std::size_t>(field)].kind == E57Field::Kind::text) return false;
    made.of_role[static_cast<std::size_t>(role)] = static_cast<int>(made.wanted.size());
    made.wanted.push_back(field);
    return true;
  };
  const bool cartesian = scan.field("cartesianX") >= 0;
  const char* const names[2][3] = {{"cartesianX", "cartesianY", "cartesianZ"},
                                   {"sphericalRange", "sphericalAzimuth", "sphericalElevation"}};
  for (std::size_t a = 0; a < 3; ++a)
    if (!want(xyz[a], names[cartesian ? 0 : 1][a])) {
      std::string there;
      for (const auto& field : scan.fields) there += (there.empty() ? "" : ", ") + field.name;
      throw Error(fmt::format("{}: {}: the points have no {} (there are: {})", pages_.path(), scan.label,
                              names[cartesian ? 0 : 1][a], there));
    }
  made.spherical = !cartesian;
  for (const auto& [role, name] : field_names) want(role, name);
  if (const int state = scan.field(cartesian ? "cartesianInvalidState" : "sphericalInvalidState");
      state >= 0 && scan.fields[static_cast<std::size_t>(state)].kind != E57Field::Kind::text) {
    made.invalid = static_cast<int>(made.wanted.size());
    made.wanted.push_back(state);
  }
  made.grid = scan.field("rowIndex") >= 0 && scan.field("columnIndex") >= 0;
  made.section = std::make_unique<E57Section>(pages_, scan, made.wanted, context);
  return made;
}

void E57Source::keep_common_roles() {
  for (std::size_t r = 0; r < role_count; ++r) {
    const auto with = std::count_if(scans_.begin(), scans_.end(), [&](const Scan& s) { return s.of_role[r] >= 0; });
    if (with == static_cast<std::ptrdiff_t>(scans_.size()))
      provide(static_cast<Role>(r));
    else if (const auto* name = std::find_if(std::begin(field_names), std::end(field_names),
                                             [&](const auto& n) { return n.first == static_cast<Role>(r); });
             with > 0 && name != std::end(field_names))
      uneven_ += (uneven_.empty() ? "" : ", ") + std::string(name->second);
  }
  for (const auto& group : {std::array{Role::nx, Role::ny, Role::nz}, std::array{Role::red, Role::green, Role::blue}})
    if (!has(group[0]) || !has(group[1]) || !has(group[2]))
      for (const Role role : group) withdraw(role);
  if (scans_.size() > 1) provide(Role::source);
}

void E57Source::check_overlap() const {
  std::vector<std::size_t> order(scans_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return scans_[a].section->begin() < scans_[b].section->begin(); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (scans_[order[i]].section->begin() < scans_[order[i - 1]].section->end())
      throw Error(fmt::format("{}: the points of {} at byte {} lie within those of {}, which begin at byte {}",
                              pages_.path(), contents_.scans[order[i]].label, contents_.scans[order[i]].section,
                              contents_.scans[order[i - 1]].label, contents_.scans[order[i - 1]].section));
}

void E57Source::look_at_first_block(std::size_t index) {
  const E57Scan& scan = contents_.scans[index];
  PointBlock block;
  std::vector<double> invalid;
  read_raw({index, 0, static_cast<std::size_t>(std::min<std::uint64_t>(records_of_block, scan.records))}, block,
           invalid);
  std::size_t zeros = 0;
  for (std::size_t i = 0; i < block.size; ++i) zeros += is_zero(block, i) ? 1 : 0;
  const bool posed = scan.pose && !scan.pose->isApprox(Eigen::Isometry3d::Identity());
  scans_[index].zeros_are_misses =
      scans_[index].grid || scans_[index].spherical || posed || (invalid.empty() && zeros > 1);
  double most = 0;
  for (const Role role : rgb)
    if (has(role)) most = std::max(most, *std::max_element(block.of(role).begin(), block.of(role).end()));
  scans_[index].real_white = most <= 1 ? 1 : most <= 255 ? 255 : 65535;
}

std::size_t E57Source::capacity(std::size_t block) const { return blocks_[block].count; }

void E57Source::read_raw(const Place& place, PointBlock& to, std::vector<double>& invalid) const {
  const Scan& scan = scans_[place.scan];
  std::vector<std::byte> scratch;
  to.resize(place.count, roles());
  to.misses = 0;
  for (std::size_t r = 0; r < role_count; ++r)
    if (roles()[r] && scan.of_role[r] >= 0)
      scan.section->read(static_cast<std::size_t>(scan.of_role[r]), place.first, place.count, to.values[r].data(),
                         scratch);
  if (scan.invalid < 0) return;
  invalid.resize(place.count);
  scan.section->read(static_cast<std::size_t>(scan.invalid), place.first, place.count, invalid.data(), scratch);
}

void E57Source::read(std::size_t block, PointBlock& to) const {
  const Place& at = blocks_[block];
  const Scan& scan = scans_[at.scan];
  std::vector<double> invalid;
  read_raw(at, to, invalid);
  if (!invalid.empty()) remove_misses(to, roles(), [&](std::size_t i) { return invalid[i] == 0; });
  if (scan.spherical) to_cartesian(to);
  if (scan.zeros_are_misses) remove_misses(to, roles(), [&](std::size_t i) { return !is_zero(to, i); });
  place(contents_.scans[at.scan], to);
  to_limits(contents_.scans[at.scan], to);
  if (has(Role::source)) std::fill_n(to.of(Role::source).begin(), to.size, static_cast<double>(at.scan));
}

void E57Source::to_limits(const E57Scan& scan, PointBlock& to) const {
  const Scan& prepared = scans_[static_cast<std::size_t>(&scan - contents_.scans.data())];
  const auto field = [&](Role role) {
    return prepared.wanted[static_cast<std::size_t>(prepared.of_role[static_cast<std::size_t>(role)])];
  };
  for (std::size_t a = 0; a < 3 && has(Role::red); ++a) {
    const bool real = scan.fields[static_cast<std::size_t>(field(rgb[a]))].kind != E57Field::Kind::integer;
    const E57Limits unknown{0, real ? prepared.real_white : 255.0};
    scale_to(to.of(rgb[a]), to.size, range_of(scan, field(rgb[a]), scan.colour_limits[a]).value_or(unknown), 255);
  }
  if (!has(Role::intensity)) return;
  if (const auto limits = range_of(scan, field(Role::intensity), scan.intensity_limits))
    scale_to(to.of(Role::intensity), to.size, *limits, 1);
}

void E57Source::place(const E57Scan& scan, PointBlock& to) const {
  if (!scan.pose) return;
  const Eigen::Matrix3d turn = scan.pose->linear();
  const Eigen::Vector3d shift = scan.pose->translation();
  const auto move = [&](Role rx, Role ry, Role rz, const Eigen::Vector3d& by) {
    auto &x = to.of(rx), &y = to.of(ry), &z = to.of(rz);
    for (std::size_t i = 0; i < to.size; ++i) {
      const double a = x[i], b = y[i], c = z[i];
      x[i] = turn(0, 0) * a + turn(0, 1) * b + turn(0, 2) * c + by.x();
      y[i] = turn(1, 0) * a + turn(1, 1) * b + turn(1, 2) * c + by.y();
      z[i] = turn(2, 0) * a + turn(2, 1) * b + turn(2, 2) * c + by.z();
    }
  };
  move(Role::x, Role::y, Role::z, shift);
  if (has(Role::nx)) move(Role::nx, Role::ny, Role::nz, Eigen::Vector3d::Zero());
}

}  // namespace atrium::io
