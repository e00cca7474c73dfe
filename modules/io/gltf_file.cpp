#include "modules/io/gltf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "graph/api/error.hpp"
#include "modules/io/lines.hpp"
#include "modules/io/scalar.hpp"

namespace atrium::io {
namespace {

constexpr bool gltf_swapped = std::endian::native == std::endian::big;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

/// Decodes base 64, with or without padding. False if a character is none of it.
bool decode_base64(std::string_view text, std::vector<std::byte>& to) {
  to.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  for (const char c : text) {
    int value = -1;
    if (c >= 'A' && c <= 'Z') value = c - 'A';
    if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
    if (c >= '0' && c <= '9') value = c - '0' + 52;
    if (c == '+' || c == '-') value = 62;
    if (c == '/' || c == '_') value = 63;
    if (value < 0) return false;
    bits = bits << 6U | static_cast<std::uint32_t>(value);
    if ((count += 6) < 8) continue;
    count -= 8;
    to.push_back(static_cast<std::byte>(bits >> static_cast<unsigned>(count) & 0xFFU));
  }
  return true;
}

/// "%20" is a blank.
std::string without_percents(std::string_view uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    text += coded ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (coded) i += 2;
  }
  return text;
}

}  // namespace

bool begins_as_gltf(std::string_view text) {
  if (text.starts_with("glTF")) return true;
  text = without_mark(text);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text.starts_with('{') && text.find("\"asset\"") != std::string_view::npos;
}

GltfFile::GltfFile(std::shared_ptr<const MappedFile> file, const Context& context)
    : file_(std::move(file)), bytes_(file_->size()) {
  if (file_->text().starts_with("glTF"))
    read_glb(context);
  else
    parse(without_mark(file_->text()), file_->size() - without_mark(file_->text()).size());
  if (!root().has("asset") || !root()["asset"].has("version"))
    throw Error(path() + ": no glTF 2.0: there is no asset.version");
  const std::string version = root()["asset"]["version"].text();
  if (!version.starts_with("2."))
    root()["asset"]["version"].fail("is " + version + ", and 2.x is read", "convert it, for instance with Blender");
  if (root().has("buffers")) buffers_.resize(root()["buffers"].size());
}
GltfFile::~GltfFile() = default;

void GltfFile::read_glb(const Context& context) {
  constexpr std::size_t head = 12, chunk_head = 8;
  const auto number = [&](std::size_t at) -> std::size_t {
    return load<std::uint32_t>(file_->data() + at, gltf_swapped);
  };
  const auto cut = [&](const std::string& what) {
    throw Error(fmt::format("{}: truncated: {}", path(), what), "copy or export it again");
  };
  if (file_->size() < head) cut(fmt::format("a .glb has a head of {} bytes, but the file has {}", head, file_->size()));
  if (number(4) != 2)
    throw Error(fmt::format("{}: byte 4: glTF of version {}, and 2 is read", path(), number(4)),
                "convert it, for instance with Blender");
  const std::size_t length = number(8);
  if (length > file_->size())
    cut(fmt::format("byte 8 says that it has {} bytes, but it has {}", length, file_->size()));
  if (length < file_->size())
    context.warn(fmt::format("{}: {} bytes follow its end at byte {}: these are not read", path(),
                             file_->size() - length, length));
  bool parsed = false;
  for (std::size_t at = head; at < length;) {
    if (length - at < chunk_head) cut(fmt::format("a part's head at byte {} has {} bytes of 8", at, length - at));
    const std::size_t size = number(at), type = number(at + 4), body = at + chunk_head;
    if (size > length - body)
      cut(fmt::format("the part at byte {} is to have {} bytes, but {} follow", at, size, length - body));
    if (!parsed && type != json_chunk)
      throw Error(fmt::format("{}: byte {}: a .glb begins with its JSON, but this part is another", path(), at));
    if (!parsed) parse(file_->text().substr(body, size), body);
    if (parsed && type == binary_chunk && chunk_.data == nullptr)
      chunk_ = {file_->data() + body, size, fmt::format("byte {}", body)};
    parsed = true;
    at = body + size;
  }
  if (!parsed) cut("it has no part with JSON");
}

void GltfFile::parse(std::string_view json, std::size_t first_byte) {
  try {
    json_ = std::make_unique<const JsonField::Json>(JsonField::Json::parse(json));
  } catch (const JsonField::Json::parse_error& e) {
    const std::string what = e.what();  // "[json.exception.parse_error.101] parse error at line 1, column 1: …"
    const auto start = what.find("column");
    const auto colon = what.find(": ", start == std::string::npos ? 0 : start);
    throw Error(fmt::format("{}: byte {}: not valid JSON: {}", path(), first_byte + (e.byte > 0 ? e.byte - 1 : 0),
                            colon == std::string::npos ? what : what.substr(colon + 2)));
  } catch (const JsonField::Json::exception& e) {  // a number beyond all doubles
    throw Error(fmt::format("{}: not valid JSON: {}", path(), e.what()));
  }
}

JsonField GltfFile::root() const { return {*json_, path() + ":"}; }

JsonField GltfFile::entry(const char* list, const JsonField& from, const char* key) const {
  const std::uint64_t index = from.natural(key);
  const std::size_t count = root().has(list) ? root()[list].size() : 0;
  if (index >= count) from[key].fail(fmt::format("is {}, but the file has {} {}", index, count, list));
  return root()[list].at(static_cast<std::size_t>(index));
}

GltfFile::Bytes GltfFile::resource(const JsonField& uri) {
  const std::string text = uri.text();
  if (text.starts_with("data:")) {
    const auto comma = text.find(',');
    if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64"))
      uri.fail("is a data: URI without ';base64,'");
    auto decoded = std::make_shared<std::vector<std::byte>>();
    if (!decode_base64(std::string_view(text).substr(comma + 1), *decoded)) uri.fail("is not base 64 to its end");
    kept_.push_back(decoded);
    return {decoded->data(), decoded->size(), "its byte 0"};
  }
  const std::filesystem::path name = without_percents(text);
  if (text.find("://") != std::string::npos || name.is_absolute() || name.empty())
    uri.fail("is '" + text + "': only files beside this one are read", "export it as one .glb");
  const std::filesystem::path full = std::filesystem::path(path()).parent_path() / name;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(full, ignored))
    uri.fail("is '" + text + "': there is no such file beside this one", "copy it there, or export one .glb");
  auto file = std::make_shared<const MappedFile>(full, MappedFile::Kinds::regular);
  kept_.push_back(file);
  bytes_ += file->size();
  return {file->data(), file->size(), full.filename().string() + " byte 0"};
}

const GltfFile::Bytes& GltfFile::buffer(std::size_t index) {
  auto& bytes = buffers_.at(index);
  if (bytes) return *bytes;
  const JsonField field = root()["buffers"].at(index);
  Bytes found = chunk_;
  if (field.has("uri"))
    found = resource(field["uri"]);
  else if (index != 0 || chunk_.data == nullptr)
    field.fail("has no uri, and the file no binary part for it",
               "if the file is compressed by meshopt or Draco, export it without");
  const std::uint64_t size = field.natural("byteLength");
  if (size > found.size)
    field["byteLength"].fail(fmt::format("is {}, but from {} on there are {} bytes", size, found.place, found.size),
                             "the file is cut short: copy or export it again");
  found.size = static_cast<std::size_t>(size);
  bytes = std::make_unique<const Bytes>(std::move(found));
  return *bytes;
}

GltfFile::Bytes GltfFile::view(const JsonField& from, const char* key, std::size_t* stride) {
  constexpr std::uint64_t most_stride = 65536;
  const JsonField field = entry("bufferViews", from, key);
  entry("buffers", field, "buffer");
  const Bytes& whole = buffer(static_cast<std::size_t>(field.natural("buffer")));
  const std::uint64_t offset = field.natural("byteOffset", 0), size = field.natural("byteLength");
  if (offset > whole.size || size > whole.size - offset)
    field.fail(fmt::format("is bytes {} to {} of a buffer that has {} bytes", offset, offset + size, whole.size),
               "the file is cut short or damaged: copy or export it again");
  const std::uint64_t distance = field.natural("byteStride", 0);
  if (distance > most_stride) field["byteStride"].fail("is more than 65536");
  if (stride != nullptr) *stride = static_cast<std::size_t>(distance);
  return {whole.data + offset, static_cast<std::size_t>(size), fmt::format("{} + {}", whole.place, offset)};
}

}  // namespace atrium::io
