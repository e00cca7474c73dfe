#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace atrium {

/// What is written in an ELF file.
struct ElfNotes {
  std::string build_id;             ///< the linker's hash of what it linked, hexadecimal; empty: none
  std::vector<std::string> needed;  ///< names of the libraries that it is linked with
  std::string search;               ///< folders in which they are looked for first, ':'-separated ($ORIGIN: its own)
};
/// What code a library or program brings with it. Not safe to use from several threads.
class LinkedLibraries {
 public:
  LinkedLibraries();
  /// It and all libraries that it is linked with, directly or through others, as the loader would find them, whatever
  /// this process has loaded; and the drivers that OpenGL's libraries load later. One that cannot be found is listed
  /// by its bare name. Throws Error if a file cannot be read.
  std::vector<std::filesystem::path> of(const std::filesystem::path& file);
  /// Empty if it is no ELF file of this kind of machine. Throws Error if it cannot be read.
  const ElfNotes& notes(const std::filesystem::path& file);

 private:
  std::filesystem::path find(const std::string& name, const std::filesystem::path& from,
                             const std::string& search) const;

  std::map<std::string, std::filesystem::path> system_;
  std::map<std::string, ElfNotes> notes_;  ///< by file
};

}  // namespace atrium
