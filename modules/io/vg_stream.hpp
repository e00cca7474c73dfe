#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "graph/api/mapped_file.hpp"

namespace atrium::io {

/// The values of a vertex group file in their order, from text (.vg) or binary (.bvg). All throw Error with line or
/// byte when the file ends or does not hold what is asked for. `what` names the value in messages.
class VgStream {
 public:
  virtual ~VgStream() = default;
  /// A count: checked to be whole, not negative, and of things that the rest of the file can hold at `numbers` numbers
  /// each, so that memory for it may be taken.
  virtual std::uint64_t count(std::string_view what, std::size_t numbers) = 0;
  /// A whole number without a name in front in text: an item of a list.
  virtual std::int64_t index(std::string_view what) = 0;
  virtual double number(std::string_view what) = 0;
  /// Passes the name that stands in front of a list or value in text; nothing in binary.
  virtual void name(std::string_view what) = 0;
  virtual void label() = 0;
  /// "FILE:LINE" or "FILE: byte N".
  virtual std::string where() const = 0;
};

std::unique_ptr<VgStream> vg_text_stream(const MappedFile& file);
std::unique_ptr<VgStream> vg_binary_stream(const MappedFile& file);

}  // namespace atrium::io
