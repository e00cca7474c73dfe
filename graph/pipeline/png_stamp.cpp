#include "graph/pipeline/png_stamp.hpp"

#include <fmt/format.h>

#include <boost/crc.hpp>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"
#include "graph/api/files.hpp"
#include "graph/api/value.hpp"

namespace atrium {
namespace {

// Names as in the PNG specification (W3C, second edition): section 5.3 chunk layout, 11.3.4.5 iTXt.
constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
constexpr std::string_view run_keyword = "atrium:run";
constexpr std::string_view resolved_keyword = "atrium:resolved";
constexpr std::size_t frame = 12;  // length, type and CRC of a chunk

struct Chunk {
  std::string_view type, data, whole;
};

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xffU);
  return bytes;
}

std::uint32_t crc_of(std::string_view type_and_data) {
  boost::crc_32_type crc;
  crc.process_bytes(type_and_data.data(), type_and_data.size());
  return crc.checksum();
}

/// All chunks from IHDR to IEND, each checked. What follows IEND is left out.
std::vector<Chunk> chunks_of(std::string_view bytes, const std::filesystem::path& file) {
  if (!bytes.starts_with(signature)) throw Error(file.string() + " is not a PNG file");
  std::vector<Chunk> chunks;
  std::size_t at = signature.size();
  while (chunks.empty() || chunks.back().type != "IEND") {
    const std::string_view rest = bytes.substr(at);
    if (rest.size() < frame || big_endian(rest) > rest.size() - frame)
      throw Error(fmt::format("{} is not whole: it ends within the chunk that begins at byte {}", file.string(), at),
                  "copy the picture again");
    const std::size_t size = big_endian(rest);
    if (crc_of(rest.substr(4, size + 4)) != big_endian(rest.substr(size + 8)))
      throw Error(fmt::format("{} is damaged: the checksum of the chunk at byte {} is wrong", file.string(), at),
                  "copy the picture again");
    chunks.push_back({rest.substr(4, 4), rest.substr(8, size), rest.substr(0, size + frame)});
    at += size + frame;
  }
  if (chunks.front().type != "IHDR") throw Error(file.string() + " is not a PNG file: it does not begin with IHDR");
  return chunks;
}

/// The text of an iTXt chunk with this keyword.
std::optional<std::string> text_of(const Chunk& chunk, std::string_view keyword, const std::filesystem::path& file) {
  if (chunk.type != "iTXt" || !chunk.data.starts_with(keyword)) return std::nullopt;
  std::string_view rest = chunk.data.substr(keyword.size());
  if (rest.size() < 5 || rest[0] != '\0') return std::nullopt;
  if (rest[1] != '\0')
    throw Error(fmt::format("another program has compressed the text '{}' in {}", keyword, file.string()),
                "take the picture as the run has written it");
  rest.remove_prefix(3);
  for (int skipped = 0; skipped < 2; ++skipped) {  // language, translated keyword
    const std::size_t end = rest.find('\0');
    if (end == std::string_view::npos) return std::nullopt;
    rest.remove_prefix(end + 1);
  }
  return std::string(rest);
}

bool is_stamp(const Chunk& chunk) {
  const auto has = [&](std::string_view keyword) {
    return chunk.data.starts_with(keyword) && chunk.data.size() > keyword.size() && chunk.data[keyword.size()] == '\0';
  };
  return chunk.type == "iTXt" && (has(run_keyword) || has(resolved_keyword));
}

std::string text_chunk(std::string_view keyword, std::string_view text) {
  std::string content = "iTXt";
  content += keyword;
  content += std::string(5, '\0');  // end of keyword; not compressed, method 0; no language, no translated keyword
  content += text;
  return big_endian(static_cast<std::uint32_t>(content.size() - 4)) + content + big_endian(crc_of(content));
}

}  // namespace

PngStamp stamp_of(const Pipeline& pipeline) {
  std::error_code ignored;
  const std::string resolved = resolved_yaml(pipeline, std::filesystem::current_path(ignored));
  return {hash_of_text(resolved).substr(0, 16), resolved};
}

bool is_png(const std::filesystem::path& file) {
  std::string start(signature.size(), '\0');
  std::ifstream in(file, std::ios::binary);
  return in.read(start.data(), static_cast<std::streamsize>(start.size())) && start == signature;
}

void stamp_png(const std::filesystem::path& file, const PngStamp& stamp) {
  const std::string bytes = read_text(file);
  AtomicFile result(file);
  result.write(signature);
  bool first = true;
  for (const Chunk& chunk : chunks_of(bytes, file)) {
    if (!is_stamp(chunk)) result.write(chunk.whole);
    if (first) result.write(text_chunk(run_keyword, stamp.run) + text_chunk(resolved_keyword, stamp.resolved));
    first = false;
  }
  result.commit();
}

bool is_png_text(std::string_view bytes) { return bytes.starts_with(signature); }

PngStamp read_png_stamp(const std::filesystem::path& file) { return read_png_stamp(read_text(file), file); }

PngStamp read_png_stamp(std::string_view bytes, const std::filesystem::path& file) {
  std::optional<std::string> run;
  std::optional<std::string> resolved;
  for (const Chunk& chunk : chunks_of(bytes, file)) {
    if (!run) run = text_of(chunk, run_keyword, file);
    if (!resolved) resolved = text_of(chunk, resolved_keyword, file);
  }
  if (!resolved)
    throw Error(file.string() + " does not say what made it: it has no text 'atrium:resolved'",
                "pictures that a run of Atrium has written have it, until another program saves them without it");
  return {run.value_or(""), *resolved};
}

}  // namespace atrium
