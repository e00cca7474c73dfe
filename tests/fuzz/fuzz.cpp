// libFuzzer's entry: the environment's ATRIUM_FUZZ names the target (targets.hpp). A finding is a crash, whatever a
// sanitizer says, an exception that the target does not expect, more than a second of CPU time, or more memory than 20
// times the input and what is needed for any input (of packed formats: what targets() says).
#include <sanitizer/allocator_interface.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "tests/fuzz/targets.hpp"

namespace atrium::fuzz {
namespace {

constexpr std::size_t memory_for_any_input = std::size_t{4} << 20U;
constexpr double most_seconds = 1;

std::atomic<std::size_t> allowed = 0;  ///< 0: nothing is counted
std::atomic<std::size_t> in_use = 0;

[[noreturn]] void finding(const char* what) {
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

void allocated(const volatile void* /*block*/, std::size_t size) {
  const std::size_t limit = allowed;
  if (limit == 0) return;
  if (in_use.fetch_add(size) + size <= limit) return;
  allowed = 0;
  finding("the input takes more memory than its size justifies");
}

void freed(const volatile void* block) {
  if (allowed == 0) return;
  const std::size_t size = __sanitizer_get_allocated_size(block);
  std::size_t before = in_use;
  while (!in_use.compare_exchange_weak(before, before - std::min(before, size))) {
  }
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

const Target& chosen() {
  const char* name = std::getenv("ATRIUM_FUZZ");
  for (const auto& target : targets())
    if (name != nullptr && target.name == name) return target;
  std::fprintf(stderr, "ATRIUM_FUZZ is to be one of:");
  for (const auto& target : targets()) std::fprintf(stderr, " %s", std::string(target.name).c_str());
  std::fprintf(stderr, "\n");
  std::exit(2);
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all{{"ply", read_ply},
                                       {"pcd", read_pcd},
                                       {"obj", read_obj},
                                       {"stl", read_stl},
                                       {"glb", read_glb, 8000},  // nodes may repeat a mesh
                                       {"e57", read_e57, 60},
                                       {"las", read_las, 3000},
                                       {"ptx", read_ptx, 40},
                                       {"text", read_text_cloud},
                                       {"vg", read_vg},
                                       {"bvg", read_bvg},
                                       {"building", read_building},
                                       {"layout", read_layout},
                                       {"pipeline", check_pipeline},
                                       {"sweep", plan_sweep_file},
                                       {"record", read_cache_record},
                                       {"blob", read_cache_blob}};
  return all;
}

/// Names of files are compared with inputs, and what is compared guides the fuzzer: runs that are to be the same say
/// where.
static std::filesystem::path place() {
  const char* said = std::getenv("ATRIUM_FUZZ_FOLDER");
  return said != nullptr ? said : "/dev/shm/atrium-fuzz-" + std::to_string(::getpid());
}

const std::filesystem::path& folder() {
  static const struct Folder {
    std::filesystem::path path = place();
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
  } folder;
  return folder.path;
}

std::filesystem::path put(const char* name, std::string_view bytes) {
  const std::filesystem::path file = folder() / name;
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

}  // namespace atrium::fuzz

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  atrium::fuzz::chosen();
  __sanitizer_install_malloc_and_free_hooks(atrium::fuzz::allocated, atrium::fuzz::freed);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace atrium::fuzz;
  static const Target& target = chosen();
  static bool warm = false;  // what is made once, by the first input, belongs to none
  const double start = cpu_seconds();
  in_use = 0;
  allowed = warm ? memory_for_any_input + target.memory_per_byte * size : 0;
  target.run({reinterpret_cast<const char*>(data), size});
  allowed = 0;
  if (warm && cpu_seconds() - start > most_seconds) finding("the input takes more than a second");
  warm = true;
  return 0;
}
