#pragma once
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "graph/cache/build_ids.hpp"
#include "graph/cache/places.hpp"
#include "graph/cache/record.hpp"

namespace atrium {

struct CacheOptions {
  std::filesystem::path folder;
  std::uint64_t most_bytes = 20'000'000'000;  ///< what was not used for longest is removed above that
  /// Values are kept only if computing them again would take longer than writing them. True: always (tests).
  bool keep_all = false;
  /// Values are written by a thread of their own, beside the nodes that run. False: by the one that made them.
  bool in_background = true;
};

/// What earlier runs computed, by what it depends on. Two things are kept of a node: its record (small, always), by its
/// key, and the values of its outputs, by the hash of their contents, if they are worth their bytes. So a key tells
/// the hashes of the outputs, which are part of the keys of the nodes that read them: a run whose ends are all known
/// loads nothing. A value that is not there, or is damaged, is computed again.
///
/// Safe to use from several threads; several processes may use one folder. Nothing that goes wrong in it ends a run:
/// what cannot be read counts as not there, what cannot be written is not kept, and `problems` says so.
class Cache {
 public:
  /// Throws NoCacheFolder if the folder holds something else, Error if it cannot be made.
  explicit Cache(CacheOptions options);
  ~Cache();
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;

  const CachePlaces& places() const { return places_; }

  /// What the code of a node type is: asked for before the first node is run, so that it is the code that runs.
  std::string build_of(const NodeType& type) { return builds_.of(type); }
  bool is_build_unchanged(const NodeType& type) { return builds_.unchanged(type); }
  /// Takes the hash of a file's contents for keys to come. Throws Error if it cannot be read.
  void hash_ahead(const std::filesystem::path& file) { files_.of(file); }
  /// The node's key. Throws Error if a file that it depends on cannot be read.
  NodeKey key_of(const PipelineNode& node, const std::vector<std::vector<std::string>>& inputs);
  /// The record of a key, or nothing.
  std::optional<CacheRecord> find(const std::string& type, const std::string& key);
  /// Puts a copy of a kept file to `target`; false if it is not there any more. Throws Error if it cannot be written.
  bool restore(const Artefact& file, const std::filesystem::path& target);
  /// A value, or null. One that is alive in this process, or part of one, is not loaded a second time.
  std::shared_ptr<const void> load(const FlatType& type, const std::string& hash);
  bool has_value(const FlatType& type, const std::string& hash) const;

  /// Keeps the bytes of a file that a node wrote. Nothing: it could not be kept.
  std::optional<std::string> keep_file(const std::filesystem::path& file);
  void keep(const CacheRecord& record);
  /// Removes a record that does not say any more what its node gives.
  void forget(const std::string& type, const std::string& key);
  /// Remembers a value while it lives, and keeps it if making it again would take longer (`cost`, seconds) than writing
  /// it. Returns whether it is, or will be, there.
  bool keep_value(const FlatType& type, std::shared_ptr<const void> data, const std::string& hash, std::uint64_t bytes,
                  double cost);
  /// Waits until all is written; removes what is too much.
  void finish();

  struct Use {
    std::uint64_t loaded = 0, kept = 0;  ///< bytes of values
    std::vector<std::string> problems;
  };
  Use use() const;

 private:
  struct Job {
    const FlatType* type;
    std::shared_ptr<const void> data;
    std::string hash;
    std::uint64_t bytes;
  };
  void work();
  void write_next(std::unique_lock<std::mutex>& lock);
  std::uint64_t write(const Job& job);
  std::uint64_t write_part(const FlatReference& part);
  void make_room_for(const std::filesystem::path& file);
  void collect();
  void problem(const std::string& text);
  void give_up(const std::string& why);
  bool works() const;
  void added(std::uint64_t bytes);
  std::shared_ptr<const void> alive(const FlatType& type, const std::string& hash) const;
  void remember(const FlatType& type, const std::string& hash, const std::shared_ptr<const void>& data);
  std::shared_ptr<const void> load_whole(const FlatType& type, const std::string& hash);

  CacheOptions options_;
  CachePlaces places_;
  FileHashes files_;
  BuildIds builds_;

  mutable std::mutex mutex_;
  Use use_;
  bool broken_ = false;
  std::map<std::pair<const FlatType*, std::string>, std::weak_ptr<const void>> alive_;  ///< by type and hash
  std::size_t alive_limit_ = 1024;
  std::mutex loading_;

  std::condition_variable wake_, idle_;
  std::deque<Job> jobs_;
  bool ending_ = false;
  std::size_t busy_ = 0;  ///< threads that write
  std::uint64_t waiting_bytes_ = 0, new_bytes_ = 0;
  double rate_;  ///< bytes per second that values are written with
  std::thread writer_;
};

}  // namespace atrium
