#include "graph/cache/linked_libraries.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <set>
#include <sstream>

#include "graph/api/error.hpp"
#include "graph/api/files.hpp"
#include "graph/cache/read_file.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

/// Reads an ELF file's tables; whatever stands in them.
class ElfReader {
 public:
  explicit ElfReader(const fs::path& path) : file_(path) {
    if (file_.size() < sizeof head_) return;
    file_.read(&head_, 0, sizeof head_);
    if (std::memcmp(head_.e_ident, ELFMAG, SELFMAG) != 0 || head_.e_ident[EI_CLASS] != ELFCLASS64 ||
        head_.e_ident[EI_DATA] != ELFDATA2LSB || head_.e_phentsize != sizeof(Elf64_Phdr))
      return;
    for (std::size_t i = 0; i < head_.e_phnum; ++i)
      if (Elf64_Phdr segment{}; read(segment, head_.e_phoff + i * sizeof segment)) segments_.push_back(segment);
  }

  ElfNotes notes() const {
    ElfNotes notes;
    for (const auto& segment : segments_) {
      if (segment.p_type == PT_NOTE && notes.build_id.empty()) notes.build_id = build_id(segment);
      if (segment.p_type == PT_DYNAMIC) read_dynamic(segment, notes);
    }
    return notes;
  }

 private:
  template <class T>
  bool read(T& value, std::uint64_t at) const {
    if (at > file_.size() || sizeof value > file_.size() - at) return false;
    file_.read(&value, at, sizeof value);
    return true;
  }

  std::string bytes(std::uint64_t at, std::uint64_t size) const {
    constexpr std::uint64_t most = 1U << 20U;
    if (at > file_.size() || size > file_.size() - at || size > most) return {};
    std::string text(static_cast<std::size_t>(size), '\0');
    file_.read(text.data(), at, text.size());
    return text;
  }

  std::string build_id(const Elf64_Phdr& segment) const {
    std::uint64_t at = segment.p_offset;
    const auto padded = [](std::uint64_t size) { return (size + 3) / 4 * 4; };
    Elf64_Nhdr note{};
    while (at < segment.p_offset + segment.p_filesz && read(note, at)) {
      const std::uint64_t contents = at + sizeof note + padded(note.n_namesz);
      if (note.n_type == NT_GNU_BUILD_ID && bytes(at + sizeof note, note.n_namesz) == std::string("GNU\0", 4)) {
        std::string text;
        for (const char byte : bytes(contents, note.n_descsz))
          text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
        return text;
      }
      at = contents + padded(note.n_descsz);
    }
    return {};
  }

  /// The place in the file of what is at an address once it is loaded.
  std::uint64_t place_of(std::uint64_t address) const {
    for (const auto& segment : segments_)
      if (segment.p_type == PT_LOAD && address >= segment.p_vaddr && address - segment.p_vaddr < segment.p_filesz)
        return segment.p_offset + (address - segment.p_vaddr);
    return file_.size();
  }

  void read_dynamic(const Elf64_Phdr& segment, ElfNotes& notes) const {
    const std::string section = bytes(segment.p_offset, segment.p_filesz);
    std::vector<Elf64_Dyn> entries(section.size() / sizeof(Elf64_Dyn));
    if (!entries.empty()) std::memcpy(entries.data(), section.data(), entries.size() * sizeof(Elf64_Dyn));
    std::uint64_t texts = file_.size();
    std::uint64_t size = 0;
    for (const auto& e : entries) {
      if (e.d_tag == DT_STRTAB) texts = place_of(e.d_un.d_ptr);
      if (e.d_tag == DT_STRSZ) size = e.d_un.d_val;
    }
    const std::string table = bytes(texts, size);
    for (const auto& e : entries) {
      if (e.d_un.d_val >= table.size()) continue;
      if (e.d_tag == DT_NEEDED) notes.needed.emplace_back(table.c_str() + e.d_un.d_val);
      if (e.d_tag == DT_RUNPATH || e.d_tag == DT_RPATH) notes.search = table.c_str() + e.d_un.d_val;
    }
  }

  ReadFile file_;
  Elf64_Ehdr head_{};
  std::vector<Elf64_Phdr> segments_;
};

/// The system's list of its libraries (ldconfig), by name. Whatever stands in it.
std::map<std::string, fs::path> system_libraries() {
  // Of glibc's sysdeps/generic/dl-cache.h.
  constexpr std::string_view magic = "glibc-ld.so.cache1.1";
  constexpr std::size_t head_size = 48;
  struct Entry {
    std::int32_t flags;
    std::uint32_t name, path, system;
    std::uint64_t capabilities;
  };
  std::map<std::string, fs::path> found;
  std::string text;
  try {
    text = read_text("/etc/ld.so.cache");
  } catch (const Error&) {
    return found;
  }
  const std::size_t begin = text.find(magic);
  if (begin == std::string::npos || text.size() - begin < head_size) return found;
  const std::string_view list = std::string_view(text).substr(begin);
  std::uint32_t entries = 0;
  std::memcpy(&entries, list.data() + magic.size(), sizeof entries);
  const auto word = [&](std::uint32_t at) { return at < list.size() ? std::string(list.data() + at) : std::string(); };
  for (std::size_t i = 0; i < entries && head_size + (i + 1) * sizeof(Entry) <= list.size(); ++i) {
    Entry entry{};
    std::memcpy(&entry, list.data() + head_size + i * sizeof entry, sizeof entry);
    if (entry.capabilities == 0) found.try_emplace(word(entry.name), word(entry.path));
  }
  return found;
}

/// What OpenGL's libraries load when they are used: the drivers that draw without a graphics card.
constexpr std::array<std::string_view, 2> drivers{"libGLX_mesa.so.0", "libEGL_mesa.so.0"};
bool loads_drivers(const std::string& library) {
  return library.starts_with("libGL.so") || library.starts_with("libEGL.so");
}

}  // namespace

LinkedLibraries::LinkedLibraries() : system_(system_libraries()) {}

const ElfNotes& LinkedLibraries::notes(const fs::path& file) {
  const auto [known, fresh] = notes_.try_emplace(file.string());
  if (fresh) known->second = ElfReader(file).notes();
  return known->second;
}

std::vector<fs::path> LinkedLibraries::of(const fs::path& file) {
  std::vector<fs::path> files;
  std::set<std::string> names;
  const auto add = [&](const fs::path& found) {
    if (names.insert(found.filename().string()).second) files.push_back(found);
  };
  add(file);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!files[i].is_absolute()) continue;
    const fs::path from = files[i];
    const ElfNotes& of_from = notes(from);
    for (const auto& name : of_from.needed) add(find(name, from, of_from.search));
    if (!loads_drivers(from.filename().string())) continue;
    for (const auto driver : drivers) add(find(std::string(driver), from, ""));
    std::error_code ignored;
    if (const fs::path rasterizer = from.parent_path() / "dri/swrast_dri.so"; fs::exists(rasterizer, ignored))
      add(rasterizer);
  }
  return files;
}

/// As ld.so(8) does it, but for what DT_RPATH hands down.
fs::path LinkedLibraries::find(const std::string& name, const fs::path& from, const std::string& search) const {
  std::error_code ignored;
  const auto in_list = [&](const std::string& list) -> fs::path {
    std::istringstream stream(list);
    for (std::string folder; std::getline(stream, folder, ':');) {
      if (const auto at = folder.find("$ORIGIN"); at != std::string::npos)
        folder.replace(at, 7, from.parent_path().string());
      if (folder.empty() || !fs::exists(fs::path(folder) / name, ignored)) continue;
      if (auto found = fs::canonical(fs::path(folder) / name, ignored); !ignored) return found;
    }
    return {};
  };
  const char* own = std::getenv("LD_LIBRARY_PATH");  // NOLINT(concurrency-mt-unsafe)
  if (auto found = in_list(own != nullptr ? own : ""); !found.empty()) return found;
  if (auto found = in_list(search); !found.empty()) return found;
  if (const auto listed = system_.find(name); listed != system_.end()) return listed->second;
  if (auto found = in_list("/lib64:/usr/lib64:/lib:/usr/lib"); !found.empty()) return found;
  return name;
}

}  // namespace atrium
