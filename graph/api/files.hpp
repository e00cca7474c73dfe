#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace atrium {

/// All bytes of a file. Throws Error (the path and the system's reason) if it cannot be read to its end.
std::string read_text(const std::filesystem::path& file);

/// Makes the folder and those above it; nothing if it is there. Throws Error with the system's reason.
void make_folder(const std::filesystem::path& folder);

/// The file that `listed` names in the folder; nothing if it is not in it: an absolute path, one that leads out with
/// "..", one that goes through a symbolic link out of the folder, the folder itself. Every path that a record, a
/// manifest or a report lists goes through here before a file is read, written or removed: somebody else may have
/// written the list.
std::optional<std::filesystem::path> place_inside(const std::filesystem::path& folder, const std::string& listed);

/// The file name under which AtomicFile writes NAME before it is renamed: ".NAME.MACHINE-PROCESS-NUMBER.part".
/// MACHINE stands for a machine and a set of process numbers on it.
std::string unfinished_file_name(const std::string& name);
/// NAME of such a file name; empty if it is none.
std::string_view name_of_unfinished(std::string_view file_name);
/// Whether the process that writes a file of that name is gone; nothing if that cannot be known here, because it runs,
/// or ran, on another machine.
std::optional<bool> is_writer_gone(std::string_view file_name);

/// Whether a folder holds nothing but unfinished files and a lock.
bool holds_only_unfinished(const std::filesystem::path& folder);

}  // namespace atrium
