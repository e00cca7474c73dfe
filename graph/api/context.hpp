#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "graph/api/random.hpp"

namespace atrium {

/// What the runner does for a node. Tests use the default, which logs nothing and writes into the working folder.
class ContextHost {
 public:
  virtual ~ContextHost() = default;
  enum class Level { info, warning };
  virtual void log(Level /*level*/, std::string_view /*text*/) {}
  virtual void progress(double /*share*/) {}
  virtual bool cancelled() { return false; }
  virtual std::filesystem::path output_folder() { return "."; }
  virtual void wrote(const std::filesystem::path& /*file*/) {}
  /// CPU seconds that another thread than the loop's own spent on pieces of a loop.
  virtual void helped(double /*cpu_seconds*/) {}
};

/// A node's only way to the outside: randomness, threads, logging, progress, cancellation, files. Safe to use from the
/// node's own loops.
class Context {
 public:
  Context() = default;
  /// `random`: whether the node type says that it draws randomness.
  Context(std::uint64_t seed, std::shared_ptr<ContextHost> host, bool random = true)
      : seed_(seed), random_(random), host_(std::move(host)) {}

  /// The node's seed (run seed and node path). Make one stream per purpose or chunk: random(7) is always the same. Only
  /// for types with `static constexpr bool random = true`: the results of others are kept when the seed changes.
  std::uint64_t seed() const;
  Random random(std::uint64_t stream = 0) const { return Random(mix_seed(seed(), stream)); }

  /// Calls work(chunk, begin, end) for the pieces [0, size), [size, 2·size), … of [0, total), side by side on the run's
  /// threads. The pieces do not depend on the number of threads: a result gathered per chunk and joined in the order of
  /// chunks has the same bytes with any number of them. Throws what work throws, and Cancelled.
  void parallel_chunks(std::size_t total, std::size_t size,
                       const std::function<void(std::size_t chunk, std::size_t begin, std::size_t end)>& work) const;
  /// The same for results that do not depend on the pieces: work(begin, end).
  void parallel_for(std::size_t total, const std::function<void(std::size_t begin, std::size_t end)>& work,
                    std::size_t size = 4096) const;

  /// For what the user should know; a warning is also kept in the run's manifest. Both name the node.
  void info(std::string_view text) const { host_->log(ContextHost::Level::info, text); }
  void warn(std::string_view text) const { host_->log(ContextHost::Level::warning, text); }
  /// Share of the node's work that is done, 0 … 1.
  void progress(double share) const { host_->progress(share); }
  bool cancelled() const { return host_->cancelled(); }
  /// Throws Cancelled when the run is to end; long loops outside parallel_chunks call it.
  void check_cancelled() const;

  /// The absolute place of a file that the node is to write (its folder made), for use with AtomicFile.
  std::filesystem::path output(const std::string& relative) const;
  /// Tells the run that the file is there, complete.
  void wrote(const std::filesystem::path& file) const { host_->wrote(file); }

 private:
  std::uint64_t seed_ = 1;
  bool random_ = true;
  std::shared_ptr<ContextHost> host_ = std::make_shared<ContextHost>();
};

/// Writes beside and renames: the file appears whole or not at all. Throws Error (path and the system's reason).
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();  ///< removes the unfinished file unless commit() was called
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  /// Where to write: a file in the target's folder.
  const std::filesystem::path& path() const { return temporary_; }
  void write(const void* data, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Flushes to the disk, checks, renames.
  void commit() { publish(true); }
  /// The same; without the flush only for what is checked when it is read: after a power failure it may be cut off.
  void publish(bool flush = false);

 private:
  std::filesystem::path target_, temporary_;
  std::FILE* file_ = nullptr;
  bool done_ = false;
};

}  // namespace atrium
