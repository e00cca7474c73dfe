#pragma once
#include <memory>
#include <vector>

#include "modules/io/e57_section.hpp"
#include "modules/io/point_source.hpp"

namespace atrium::io {

/// The points of an E57 file. What is kept, and how: read_e57.
class E57Source : public PointSource {
 public:
  E57Source(std::shared_ptr<const MappedFile> file, E57Contents contents, const Context& context);

  std::size_t blocks() const override { return blocks_.size(); }
  std::size_t capacity(std::size_t block) const override;
  void read(std::size_t block, PointBlock& to) const override;

  std::uint64_t records() const { return records_; }
  const std::vector<E57Scan>& scans() const { return contents_.scans; }
  /// Whether the scan's coordinates are those of a scanner that stands in its zero.
  bool around_scanner(std::size_t scan) const { return scans_[scan].grid || scans_[scan].spherical; }
  /// Names of what some scans have and others lack, which is left out; empty if there is none.
  const std::string& uneven() const { return uneven_; }

 private:
  struct Scan {
    std::unique_ptr<E57Section> section;
    std::vector<int> wanted;                // fields
    std::array<int, role_count> of_role{};  // index into wanted, or -1
    int invalid = -1;                       // likewise
    bool spherical = false, grid = false, zeros_are_misses = false;
    double real_white = 1;  // of colours that are real numbers without limits
  };
  struct Place {
    std::size_t scan = 0;
    std::uint64_t first = 0;
    std::size_t count = 0;
  };

  Scan prepared(const E57Scan& scan, const Context& context) const;
  void keep_common_roles();
  void check_overlap() const;
  void look_at_first_block(std::size_t index);
  void read_raw(const Place& place, PointBlock& to, std::vector<double>& invalid) const;
  void to_limits(const E57Scan& scan, PointBlock& to) const;
  void place(const E57Scan& scan, PointBlock& to) const;

  E57Pages pages_;
  E57Contents contents_;
  std::vector<Scan> scans_;
  std::vector<Place> blocks_;
  std::uint64_t records_ = 0;
  std::string uneven_;
};

}  // namespace atrium::io
