#pragma once
#include <array>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// What the node hands to atrium-pdf-draw on its standard input, and what it gets from it on the standard output.
namespace atrium::pdf {

struct Page {
  std::string svg;
  double width = 0, height = 0;  ///< millimetres
};
struct DrawingRequest {
  std::string title;
  std::vector<std::string> texts;  ///< that are looked up in the fonts
  std::vector<Page> pages;
};
struct DrawingReply {
  std::string problem, help;         ///< why there is no file; empty: there is one
  std::vector<std::string> lacking;  ///< of the texts those that hold a character which no font has
  std::string file;                  ///< the PDF
};

/// Texts of any bytes as bytes: for each its length in digits, a colon, and the text (netstrings, without the comma).
inline std::string to_bytes(const std::vector<std::string>& blocks) {
  std::string bytes;
  for (const auto& block : blocks) bytes += std::to_string(block.size()) + ':' + block;
  return bytes;
}
/// Throws std::runtime_error where bytes lack.
inline std::vector<std::string> blocks_of(std::string_view bytes) {
  std::vector<std::string> blocks;
  while (!bytes.empty()) {
    std::size_t size = 0;
    const auto [end, problem] = std::from_chars(bytes.data(), bytes.data() + bytes.size(), size);
    const auto digits = static_cast<std::size_t>(end - bytes.data());
    if (problem != std::errc{} || digits >= bytes.size() || bytes[digits] != ':' || size > bytes.size() - digits - 1)
      throw std::runtime_error("incomplete message");
    blocks.emplace_back(bytes.substr(digits + 1, size));
    bytes.remove_prefix(digits + 1 + size);
  }
  return blocks;
}

namespace detail {
inline std::string bytes_of(double number) {
  std::array<char, sizeof number> bytes{};
  std::memcpy(bytes.data(), &number, sizeof number);
  return {bytes.data(), bytes.size()};
}
inline double number_of(const std::string& bytes) {
  double number = 0;
  if (bytes.size() != sizeof number) throw std::runtime_error("no number in the message");
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}
/// Takes blocks one after the other.
class Blocks {
 public:
  explicit Blocks(std::string_view bytes) : blocks_(blocks_of(bytes)) {}
  std::string next() {
    if (next_ == blocks_.size()) throw std::runtime_error("incomplete message");
    return std::move(blocks_[next_++]);
  }
  std::vector<std::string> list() {
    const double size = number_of(next());
    if (!(size >= 0 && size <= static_cast<double>(blocks_.size() - next_)))
      throw std::runtime_error("incomplete message");
    std::vector<std::string> texts(static_cast<std::size_t>(size));
    for (auto& text : texts) text = next();
    return texts;
  }

 private:
  std::vector<std::string> blocks_;
  std::size_t next_ = 0;
};
inline void put(std::vector<std::string>& blocks, const std::vector<std::string>& list) {
  blocks.push_back(bytes_of(static_cast<double>(list.size())));
  blocks.insert(blocks.end(), list.begin(), list.end());
}
}  // namespace detail

inline std::string to_bytes(const DrawingRequest& request) {
  std::vector<std::string> blocks{request.title};
  detail::put(blocks, request.texts);
  for (const auto& page : request.pages)
    blocks.insert(blocks.end(), {page.svg, detail::bytes_of(page.width), detail::bytes_of(page.height)});
  blocks.emplace_back();  // no page
  return to_bytes(blocks);
}
inline DrawingRequest request_from(std::string_view bytes) {
  detail::Blocks blocks(bytes);
  DrawingRequest request{blocks.next(), blocks.list(), {}};
  for (std::string svg = blocks.next(); !svg.empty(); svg = blocks.next()) {
    const double width = detail::number_of(blocks.next());
    request.pages.push_back({std::move(svg), width, detail::number_of(blocks.next())});
  }
  return request;
}

inline std::string to_bytes(const DrawingReply& reply) {
  std::vector<std::string> blocks{reply.problem, reply.help};
  detail::put(blocks, reply.lacking);
  blocks.push_back(reply.file);
  return to_bytes(blocks);
}
inline DrawingReply reply_from(std::string_view bytes) {
  detail::Blocks blocks(bytes);
  DrawingReply reply{blocks.next(), blocks.next(), blocks.list(), {}};
  reply.file = blocks.next();
  return reply;
}

}  // namespace atrium::pdf
