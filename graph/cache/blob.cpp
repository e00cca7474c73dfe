#include "graph/cache/blob.hpp"

#include <cstring>

#include "graph/api/context.hpp"
#include "graph/cache/read_file.hpp"

namespace atrium {
namespace {

struct Head {
  char magic[8];
  std::uint64_t byte_order, layout;
  char hash[32];
  std::uint64_t reserved;
};
static_assert(sizeof(Head) == 64);
constexpr char magic[8] = {'a', 't', 'r', 'i', 'u', 'm', 'B', '1'};
constexpr std::uint64_t byte_order = 0x0102030405060708;
constexpr std::size_t digest_size = 32;

/// The head of a file that is whole.
Head checked_head(const ReadFile& file) {
  Head head{};
  const auto refuse = [&](const char* why) { throw DamagedFile(file.path().string() + " " + why); };
  if (file.size() < sizeof(Head) + digest_size) refuse("is cut off");
  file.read(&head, 0, sizeof head);
  if (std::memcmp(head.magic, magic, sizeof magic) != 0) refuse("is not a stored value of this version");
  if (head.byte_order != byte_order) refuse("was written on a machine of another byte order");
  const std::size_t whole = file.size() - digest_size;
  std::string digest(digest_size, '\0');
  file.read(digest.data(), whole, digest_size);
  if (file.hash(whole) != digest) refuse("is damaged");
  return head;
}

}  // namespace

std::vector<FlatReference> write_blob(const std::filesystem::path& file, const FlatType& type, const void* value,
                                      const std::string& hash) {
  AtomicFile out(file);
  ContentHash digest;
  const auto write = [&](const void* data, std::size_t size) {
    digest.bytes(data, size);
    out.write(data, size);
  };
  Head head{{}, byte_order, type.layout, {}, 0};
  std::memcpy(head.magic, magic, sizeof magic);
  std::memcpy(head.hash, hash.data(), std::min(hash.size(), sizeof head.hash));
  write(&head, sizeof head);
  FlatWriter writer(write);
  type.write(value, writer);
  writer.finish();
  out.write(digest.hex());
  out.commit();
  return writer.references();
}

std::uint64_t flat_size(const FlatType& type, const void* value) {
  std::uint64_t bytes = 0;
  FlatWriter writer([&](const void* /*data*/, std::size_t size) { bytes += size; });
  type.write(value, writer);
  writer.finish();
  return bytes;
}

std::shared_ptr<const void> read_blob(const std::filesystem::path& file, const FlatType& type, const std::string& hash,
                                      const FlatReader::Resolve& resolve) {
  const ReadFile stored(file);
  const Head head = checked_head(stored);
  if (head.layout != type.layout) throw DamagedFile(file.string() + " holds a value of another layout");
  if (std::string_view(head.hash, sizeof head.hash) != hash) throw DamagedFile(file.string() + " holds another value");
  FlatReader reader([&](void* to, std::uint64_t at, std::size_t size) { stored.read(to, sizeof head + at, size); },
                    static_cast<std::size_t>(stored.size() - sizeof head - digest_size), resolve);
  try {
    auto value = type.read(reader);
    if (!reader.at_end()) throw Error("it is longer than its value");
    return value;
  } catch (const UnreadableFile&) {
    throw;
  } catch (const Error& error) {
    throw DamagedFile(file.string() + ": " + error.what());
  }
}

void check_blob(const std::filesystem::path& file) { checked_head(ReadFile(file)); }

std::string hash_of_file(const std::filesystem::path& file) {
  const ReadFile whole(file);
  return whole.hash(whole.size());
}

std::string hash_if_readable(const std::filesystem::path& file) {
  try {
    return hash_of_file(file);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace atrium
