#pragma once
#include <cstdint>
#include <vector>

#include "graph/api/context.hpp"
#include "modules/io/e57_pages.hpp"
#include "modules/io/e57_xml.hpp"

namespace atrium::io {

/// Where the byte streams of a scan's fields lie, packet by packet: any run of records can be read on its own.
class E57Section {
 public:
  /// Walks the packets. `wanted`: the fields to be read. Throws Error, with the byte offset, for packets that
  /// contradict the section or each other, and if the streams of the wanted fields hold fewer than scan.records.
  E57Section(const E57Pages& pages, const E57Scan& scan, std::vector<int> wanted, const Context& context);

  /// The numbers of records first … first+count-1 of the wanted field with that index (in `wanted`), scaled. `scratch`
  /// is used again from call to call.
  void read(std::size_t which, std::uint64_t first, std::size_t count, double* to,
            std::vector<std::byte>& scratch) const;

  std::uint64_t begin() const { return begin_; }  ///< logical
  std::uint64_t end() const { return end_; }

 private:
  void add_packet(std::uint64_t at, std::uint64_t length);
  void check_lengths() const;
  void gather(std::size_t which, std::uint64_t begin, std::size_t size, std::byte* to) const;
  std::size_t streams() const { return wanted_.size(); }

  const E57Pages& pages_;
  const E57Scan& scan_;
  std::vector<int> wanted_;
  std::uint64_t begin_ = 0, end_ = 0;
  // For packet p and stream s at p · streams + s: where its bytes begin, and how many the stream has up to their end.
  std::vector<std::uint64_t> places_, ends_;
};

}  // namespace atrium::io
