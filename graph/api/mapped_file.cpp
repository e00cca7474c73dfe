#include "graph/api/mapped_file.hpp"

#include <fcntl.h>
#include <linux/magic.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>

#include "graph/api/error.hpp"

namespace atrium {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw Error("cannot read " + path + ": " + std::strerror(error));
}

/// Closes at the end of the scope.
struct Descriptor {
  explicit Descriptor(const std::string& path) : number(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number;
};

/// What is mapped, for the signal that comes when a file was cut short by others: what lies behind its new end cannot
/// be read. A handler may neither lock nor allocate.
struct Mapping {
  std::atomic<const char*> path = nullptr;  ///< null: the place is free
  std::atomic<const std::byte*> begin = nullptr;
  std::atomic<std::size_t> size = 0;
};
std::array<Mapping, 256> mappings;
std::mutex mappings_mutex;
struct sigaction earlier_action {};

void say(const char* text) { static_cast<void>(!::write(STDERR_FILENO, text, std::strlen(text))); }

void on_bus_error(int signal, siginfo_t* info, void* /*context*/) {
  const auto* at = static_cast<const std::byte*>(info->si_addr);
  for (const auto& mapping : mappings) {
    const char* path = mapping.path;
    const std::byte* begin = mapping.begin;
    if (path == nullptr || at < begin || at >= begin + mapping.size) continue;
    say("atrium: error: ");
    say(path);
    say(": the file was cut short while it was read\n  help: run again when nothing writes it any more\n");
    ::_exit(1);
  }
  ::sigaction(signal, &earlier_action, nullptr);  // not ours: the fault comes again, to whom it belongs
}

/// Remembers the mapping; where there are too many, those are only not named.
void remember(const std::string& path, const std::byte* data, std::size_t size) {
  const std::lock_guard lock(mappings_mutex);
  static const bool handled = [] {
    struct sigaction action {};
    action.sa_sigaction = on_bus_error;
    action.sa_flags = SA_SIGINFO;
    return ::sigaction(SIGBUS, &action, &earlier_action) == 0;
  }();
  static_cast<void>(handled);
  for (auto& mapping : mappings) {
    if (mapping.path != nullptr) continue;
    mapping.begin = data;
    mapping.size = size;
    mapping.path = path.c_str();
    return;
  }
}

void forget(const std::byte* data) {
  const std::lock_guard lock(mappings_mutex);
  for (auto& mapping : mappings)
    if (mapping.path != nullptr && mapping.begin == data) mapping.path = nullptr;
}

/// Of the machine's, or of what a limit of the process or of its container leaves.
std::size_t half_of_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  std::uint64_t most = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    most = std::min<std::uint64_t>(most, limit.rlim_cur);
  std::uint64_t contained = 0;
  if (std::ifstream file("/sys/fs/cgroup/memory.max"); file >> contained && contained > 0)
    most = std::min(most, contained);
  return static_cast<std::size_t>(most / 2);
}

/// Whether a pipe is in no folder, so that to open its place again is to read on in it.
bool is_unnamed(int descriptor) {
  struct statfs system {};
  return ::fstatfs(descriptor, &system) == 0 && system.f_type == PIPEFS_MAGIC;
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path, Kinds kinds, std::size_t most_of_pipe)
    : path_(path.string()) {
  const Descriptor file(path_);
  if (file.number < 0) fail(path_, errno);
  struct stat status {};
  if (::fstat(file.number, &status) != 0) fail(path_, errno);
  if (S_ISDIR(status.st_mode)) fail(path_, EISDIR);
  if (!S_ISREG(status.st_mode)) {
    if (kinds == Kinds::regular) fail(path_, EINVAL);
    if (!S_ISFIFO(status.st_mode))
      throw Error("cannot read " + path_ + ": it is a device, not a file", "give a file or a pipe");
    const std::size_t most = most_of_pipe > 0 ? most_of_pipe : half_of_memory();
    buffer_ = is_unnamed(file.number) ? read_once(file.number, most) : read_pipe(file.number, most);
    data_ = buffer_->data();
    size_ = buffer_->size();
    return;
  }
  size_ = static_cast<std::size_t>(status.st_size);
  if (size_ == 0) return;
  void* mapping = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.number, 0);
  if (mapping == MAP_FAILED) fail(path_, errno);
  mapping_ = mapping;
  ::madvise(mapping_, size_, MADV_WILLNEED);
  data_ = static_cast<const std::byte*>(mapping_);
  remember(path_, data_, size_);
}

MappedFile::~MappedFile() {
  if (mapping_ == nullptr) return;
  forget(data_);
  ::munmap(mapping_, size_);
}

void MappedFile::drop_pages() const {
  if (mapping_ != nullptr) ::madvise(mapping_, size_, MADV_DONTNEED);
}

std::shared_ptr<const MappedFile::Bytes> MappedFile::read_pipe(int descriptor, std::size_t most) const {
  constexpr std::size_t block = std::size_t{1} << 20U;
  auto bytes = std::make_shared<Bytes>();
  for (std::size_t size = 0;;) {
    bytes->resize(size + block);
    const ssize_t got = ::read(descriptor, bytes->data() + size, block);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path_, errno);
    size += static_cast<std::size_t>(got);
    if (size > most)
      throw Error("cannot read " + path_ + ": more than " + std::to_string(most) +
                      " bytes come through this pipe, which has to fit into memory",
                  "write them to a file, and give that");
    if (got > 0) continue;
    bytes->resize(size);
    return bytes;
  }
}

std::shared_ptr<const MappedFile::Bytes> MappedFile::read_once(int descriptor, std::size_t most) const {
  struct Kept {
    std::mutex reading;
    std::shared_ptr<const Bytes> bytes;
  };
  static std::mutex mutex;
  static std::map<ino_t, std::shared_ptr<Kept>> all;  // by number: they are all in one file system
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail(path_, errno);
  std::shared_ptr<Kept> kept;
  {
    const std::lock_guard lock(mutex);
    auto& place = all[status.st_ino];
    if (!place) place = std::make_shared<Kept>();
    kept = place;
  }
  const std::lock_guard lock(kept->reading);
  if (!kept->bytes) kept->bytes = read_pipe(descriptor, most);
  return kept->bytes;
}

}  // namespace atrium
