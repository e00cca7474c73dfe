#pragma once
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <vector>

namespace atrium::fuzz {

/// What is fuzzed, by name. `run` gives the bytes to the code under test; it throws nothing but what is a finding.
struct Target {
  std::string_view name;
  void (*run)(std::string_view bytes);
  std::size_t memory_per_byte = 20;  ///< that an input's size justifies
};
const std::vector<Target>& targets();

/// A folder in memory of this process, removed at its end.
const std::filesystem::path& folder();
/// Puts the bytes into the folder's file of that name, in place of what it held, and gives its path.
std::filesystem::path put(const char* name, std::string_view bytes);

// Files of modules/io:
void read_ply(std::string_view bytes);
void read_pcd(std::string_view bytes);
void read_obj(std::string_view bytes);
void read_stl(std::string_view bytes);
void read_glb(std::string_view bytes);  ///< .glb, .gltf, or JSON, a zero and the binary part of a .glb
void read_e57(std::string_view bytes);  ///< without the pages' checksums, which are added
void read_las(std::string_view bytes);  ///< LAZ as well
void read_ptx(std::string_view bytes);
void read_text_cloud(std::string_view bytes);  ///< the first byte chooses the extension
void read_vg(std::string_view bytes);
void read_bvg(std::string_view bytes);
void read_building(std::string_view bytes);
void read_layout(std::string_view bytes);
// Files of graph/:
void check_pipeline(std::string_view bytes);
void plan_sweep_file(std::string_view bytes);
void read_cache_record(std::string_view bytes);  ///< without its first line, the hash of the rest
void read_cache_blob(std::string_view bytes);    ///< the first byte chooses the type, the others are the flat form

}  // namespace atrium::fuzz
