#include "graph/api/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <system_error>

#include "graph/api/error.hpp"
#include "graph/api/folder_lock.hpp"
#include "graph/api/text.hpp"
#include "graph/api/walk.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view unfinished_end = ".part";

/// Stands for this machine since it was started, and the set of process numbers that this process sees (a container
/// has its own).
std::string machine_token() {
  std::string text;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> text;
  std::error_code ignored;
  text += "\n" + host_name() + "\n" + fs::read_symlink("/proc/self/ns/pid", ignored).string();
  return hash_of_text(text).substr(0, 8);
}

const std::string& this_machine() {
  static const std::string token = machine_token();
  return token;
}

/// Names of two processes never meet, whatever their machines know of each other.
std::uint64_t random_number() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number))
    number = static_cast<std::uint64_t>(::getpid()) << 32U;
  return number;
}

struct Writer {
  std::string_view name, machine;  ///< machine: empty in names of earlier versions
  pid_t process = 0;
};

/// The parts of ".NAME.MACHINE-PROCESS-NUMBER.part", and of ".NAME.PROCESS-NUMBER.part" of earlier versions.
std::optional<Writer> writer_of(std::string_view file_name) {
  if (!file_name.starts_with('.') || !file_name.ends_with(unfinished_end)) return std::nullopt;
  const std::string_view whole = file_name.substr(1, file_name.size() - 1 - unfinished_end.size());
  const std::size_t dot = whole.rfind('.');
  if (dot == std::string_view::npos || dot == 0) return std::nullopt;
  const std::string_view parts = whole.substr(dot + 1);
  if (parts.empty() || parts.find_first_not_of("0123456789abcdef-") != std::string_view::npos) return std::nullopt;
  Writer writer{whole.substr(0, dot), {}};
  const std::size_t first = parts.find('-');
  if (first == std::string_view::npos) return std::nullopt;  // a file of somebody else's, ".talk.7.part"
  const std::size_t second = parts.find('-', first + 1);
  std::string_view process = parts.substr(0, first);
  if (second != std::string_view::npos) {
    writer.machine = parts.substr(0, first);
    process = parts.substr(first + 1, second - first - 1);
    if (writer.machine.size() != this_machine().size() || parts.size() - second - 1 != 16) return std::nullopt;
  }
  const auto [end, problem] = std::from_chars(process.data(), process.data() + process.size(), writer.process);
  if (problem != std::errc{} || end != process.data() + process.size() || writer.process <= 0) return std::nullopt;
  return writer;
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  const int number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  std::string text;
  bool good = number >= 0;
  struct stat info {};
  if (good && ::fstat(number, &info) == 0 && S_ISREG(info.st_mode))
    text.reserve(static_cast<std::size_t>(info.st_size));
  char block[1U << 16U];
  while (good) {
    const ssize_t got = ::read(number, block, sizeof block);
    if (got == 0) break;
    if (got > 0)
      text.append(block, static_cast<std::size_t>(got));
    else
      good = errno == EINTR;
  }
  const int reason = errno;
  if (number >= 0) ::close(number);
  if (!good) throw Error("cannot read " + file.string() + ": " + std::generic_category().message(reason));
  return text;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("cannot make the folder " + folder.string() + ": " + error.message());
}

std::optional<fs::path> place_inside(const fs::path& folder, const std::string& listed) {
  const fs::path relative = fs::path(listed).lexically_normal();
  if (relative.empty() || relative == "." || relative.is_absolute() || *relative.begin() == ".." ||
      listed.find('\0') != std::string::npos)
    return std::nullopt;
  std::error_code error;
  const fs::path top = fs::weakly_canonical(folder, error);
  if (error) return std::nullopt;
  const fs::path real = fs::weakly_canonical(top / relative, error);
  if (error) return std::nullopt;
  const fs::path from_top = real.lexically_relative(top);
  if (from_top.empty() || from_top == "." || *from_top.begin() == "..") return std::nullopt;
  return folder / relative;
}

std::string unfinished_file_name(const std::string& name) {
  static const std::uint64_t own = random_number();
  static std::atomic<std::uint64_t> count = 0;
  return fmt::format(".{}.{}-{}-{:016x}{}", name, this_machine(), ::getpid(), own + ++count, unfinished_end);
}

std::string_view name_of_unfinished(std::string_view file_name) {
  const auto writer = writer_of(file_name);
  return writer ? writer->name : std::string_view();
}

std::optional<bool> is_writer_gone(std::string_view file_name) {
  const auto writer = writer_of(file_name);
  if (!writer || (!writer->machine.empty() && writer->machine != this_machine())) return std::nullopt;
  return ::kill(writer->process, 0) != 0 && errno == ESRCH;
}

bool holds_only_unfinished(const fs::path& folder) {
  const fs::directory_iterator entries(folder);
  return std::all_of(fs::begin(entries), fs::end(entries), [](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name == lock_file_name || !name_of_unfinished(name).empty();
  });
}

}  // namespace atrium
