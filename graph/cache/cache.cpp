#include "graph/cache/cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <system_error>

#include "graph/api/clocks.hpp"
#include "graph/api/context.hpp"
#include "graph/api/files.hpp"
#include "graph/cache/blob.hpp"
#include "graph/cache/cache_folder.hpp"
#include "graph/cache/read_file.hpp"
#include "graph/cache/upkeep.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
constexpr double first_rate = 200e6;       // bytes per second, until it has been measured
constexpr double seconds_per_file = 0.01;  // of a value, besides its bytes
constexpr std::uint64_t measurable = 1'000'000;
constexpr std::uint64_t most_waiting = 1'000'000'000;  // bytes of values that are kept in memory until they are written

/// Nothing is wrong with a file that cannot be read now: no memory, too many open files, no permission. No Error, which
/// would say that the value which shares it is damaged.
class Passing : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Removes a file that is of no use.
void discard(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

/// In the cache's folder: changed when garbage was last collected.
constexpr std::string_view collected = ".collected";

bool used_since(const fs::path& file, std::chrono::hours time) {
  std::error_code missing;
  const auto then = fs::last_write_time(file, missing);
  return !missing && fs::file_time_type::clock::now() - then < time;
}

void write_bytes(const fs::path& target, const void* data, std::size_t size) {
  AtomicFile out(target);
  out.write(data, size);
  out.publish();
}

}  // namespace

Cache::Cache(CacheOptions options)
    : options_(std::move(options)),
      places_{fs::absolute(options_.folder).lexically_normal()},
      files_(places_.hashes()),
      builds_(files_),
      rate_(first_rate) {
  make_cache_folder(places_);
}

Cache::~Cache() {
  finish();
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  if (writer_.joinable()) writer_.join();
}

NodeKey Cache::key_of(const PipelineNode& node, const std::vector<std::vector<std::string>>& inputs) {
  return make_key(node, inputs, builds_.of(*node.type), files_);
}

std::optional<CacheRecord> Cache::find(const std::string& type, const std::string& key) {
  const fs::path file = places_.record(type, key);
  std::error_code missing;
  if (!fs::exists(file, missing)) return std::nullopt;
  std::string text;
  try {
    text = read_text(file);
  } catch (const Error& error) {
    problem(fmt::format("{}: the node is run again", error.what()));
    return std::nullopt;
  }
  auto record = read_record(text);
  if (!record || record->key != key) {
    discard(file);
    problem(file.string() + " is damaged: the node is run again");
    return std::nullopt;
  }
  touch(file);
  return record;
}

bool Cache::restore(const Artefact& file, const fs::path& target) {
  const fs::path source = places_.file(file.hash);
  std::optional<ReadFile> kept;
  try {
    kept.emplace(source);
  } catch (const Error&) {  // removed
    return false;
  }
  make_folder(target.parent_path());
  if (copy_hashed(*kept, target, file.hash) != file.hash) {
    discard(source);
    problem(source.string() + " is damaged: the node that wrote it is run again");
    return false;
  }
  touch(source);
  return true;
}

std::shared_ptr<const void> Cache::alive(const FlatType& type, const std::string& hash) const {
  const std::lock_guard lock(mutex_);
  const auto found = alive_.find({&type, hash});
  return found == alive_.end() ? nullptr : found->second.lock();
}

void Cache::remember(const FlatType& type, const std::string& hash, const std::shared_ptr<const void>& data) {
  const std::lock_guard lock(mutex_);
  if (alive_.size() >= alive_limit_) {
    std::erase_if(alive_, [](const auto& entry) { return entry.second.expired(); });
    alive_limit_ = std::max<std::size_t>(1024, 2 * alive_.size());
  }
  alive_[{&type, hash}] = data;
}

bool Cache::has_value(const FlatType& type, const std::string& hash) const {
  std::error_code missing;
  return alive(type, hash) != nullptr || fs::exists(places_.value(type, hash), missing);
}

std::shared_ptr<const void> Cache::load(const FlatType& type, const std::string& hash) {
  const std::lock_guard one_at_a_time(loading_);
  try {
    return load_whole(type, hash);
  } catch (const std::exception& passing) {
    problem(fmt::format("{}: it is computed again", passing.what()));
    return nullptr;
  }
}

/// Null if it is not there (any more). Throws Passing.
std::shared_ptr<const void> Cache::load_whole(const FlatType& type, const std::string& hash) {
  if (auto value = alive(type, hash)) return value;
  if (!is_content_hash(hash)) throw Passing("a value names another by what is no hash");
  const fs::path file = places_.value(type, hash);
  std::error_code missing;
  const std::uint64_t bytes = fs::file_size(file, missing);
  if (missing == std::errc::no_such_file_or_directory) return nullptr;
  if (missing) throw Passing(file.string() + ": " + missing.message());
  bool incomplete = false;
  const auto resolve = [&](const FlatType& shared, const std::string& shared_hash) {
    auto value = load_whole(shared, shared_hash);
    incomplete = incomplete || value == nullptr;
    return value;
  };
  try {
    auto value = read_blob(file, type, hash, resolve);
    touch(file);
    remember(type, hash, value);
    const std::lock_guard lock(mutex_);
    use_.loaded += bytes;
    return value;
  } catch (const DamagedFile& damage) {
    discard(file);  // so that it is kept again, with all its parts
    if (!incomplete) problem(fmt::format("{}: it is computed again", damage.what()));
    return nullptr;
  } catch (const Passing&) {
    throw;
  } catch (const std::exception& error) {
    throw Passing(error.what());
  }
}

bool Cache::works() const {
  const std::lock_guard lock(mutex_);
  return !broken_;
}

void Cache::problem(const std::string& text) {
  const std::lock_guard lock(mutex_);
  use_.problems.push_back("cache: " + text);
}

void Cache::give_up(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (!broken_) use_.problems.push_back(fmt::format("cache: {}; nothing more is kept in this run", why));
  broken_ = true;
}

std::optional<std::string> Cache::keep_file(const fs::path& file) {
  if (!works()) return std::nullopt;
  try {
    const ReadFile written(file);
    if (written.size() > options_.most_bytes / 2) return std::nullopt;  // it would drive out all else
    std::string hash = written.hash(written.size());
    const fs::path target = places_.file(hash);
    std::error_code missing;
    if (fs::file_size(target, missing) == written.size() && !missing) {
      touch(target);
      return hash;
    }
    make_room_for(target);
    if (copy_hashed(written, target, hash) != hash) return std::nullopt;  // it was changed meanwhile
    added(written.size());
    return hash;
  } catch (const std::exception& error) {
    give_up(error.what());
    return std::nullopt;
  }
}

void Cache::keep(const CacheRecord& record) {
  if (!works()) return;
  try {
    const std::string text = record_text(record);
    const fs::path target = places_.record(record.type(), record.key);
    make_room_for(target);
    write_bytes(target, text.data(), text.size());
    added(text.size());
  } catch (const std::exception& error) {
    give_up(error.what());
  }
}

void Cache::forget(const std::string& type, const std::string& key) {
  if (!key.empty()) discard(places_.record(type, key));
}

bool Cache::keep_value(const FlatType& type, std::shared_ptr<const void> data, const std::string& hash,
                       std::uint64_t bytes, double cost) {
  remember(type, hash, data);
  const fs::path file = places_.value(type, hash);
  std::error_code missing;
  if (fs::exists(file, missing)) {
    touch(file);
    return true;
  }
  std::unique_lock lock(mutex_);
  const double writing = seconds_per_file + static_cast<double>(waiting_bytes_ + bytes) / rate_;
  const bool too_much = bytes > options_.most_bytes / 2 || waiting_bytes_ + bytes > most_waiting;
  if (broken_ || too_much || (!options_.keep_all && writing > cost)) return false;
  waiting_bytes_ += bytes;
  jobs_.push_back({&type, std::move(data), hash, bytes});
  try {
    if (options_.in_background && !writer_.joinable()) writer_ = std::thread([this] { work(); });
  } catch (const std::system_error&) {  // no thread to be had: this one writes
  }
  if (writer_.joinable())
    wake_.notify_one();
  else
    while (!jobs_.empty()) write_next(lock);
  return true;
}

void Cache::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    write_next(lock);
  }
}

/// The first of the values that wait; without the lock meanwhile.
void Cache::write_next(std::unique_lock<std::mutex>& lock) {
  ++busy_;
  Job job = std::move(jobs_.front());
  jobs_.pop_front();
  const bool useful = !broken_;
  lock.unlock();
  const double start = wall_seconds();
  const std::uint64_t written = useful ? write(job) : 0;
  const double took = wall_seconds() - start;
  job.data.reset();
  lock.lock();
  if (written >= measurable) rate_ = 0.5 * (rate_ + static_cast<double>(written) / (took + 1e-6));
  waiting_bytes_ -= job.bytes;
  --busy_;
  idle_.notify_all();
}

/// The value, then what it shares with others: how many bytes were written. A value without its parts is found out when
/// it is loaded.
std::uint64_t Cache::write(const Job& job) {
  std::uint64_t written = 0;
  try {
    const fs::path file = places_.value(*job.type, job.hash);
    std::error_code missing;
    if (fs::exists(file, missing)) return 0;
    make_room_for(file);
    const auto parts = write_blob(file, *job.type, job.data.get(), job.hash);
    const std::uint64_t bytes = fs::file_size(file, missing);
    written = missing ? 0 : bytes;
    {
      const std::lock_guard lock(mutex_);
      use_.kept += written;
    }
    added(written);
    for (const auto& part : parts) written += write_part(part);
  } catch (const std::exception& error) {
    give_up(error.what());
  }
  return written;
}

std::uint64_t Cache::write_part(const FlatReference& part) {
  remember(*part.type, part.hash, part.data);
  std::error_code missing;
  if (fs::exists(places_.value(*part.type, part.hash), missing)) return 0;
  const std::uint64_t bytes = flat_size(*part.type, part.data.get());
  const auto wait_for = [&](std::uint64_t more) {
    const std::lock_guard lock(mutex_);
    waiting_bytes_ += more;
  };
  wait_for(bytes);
  const std::uint64_t written = write({part.type, part.data, part.hash, bytes});
  wait_for(-bytes);
  return written;
}

/// The folder for a new file; of all of the cache if somebody deleted it meanwhile.
void Cache::make_room_for(const fs::path& file) {
  if (!is_cache_folder(places_)) make_cache_folder(places_);
  make_folder(file.parent_path());
}

/// Removes what is too much, now and then.
void Cache::added(std::uint64_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    new_bytes_ += bytes;
    if (new_bytes_ < std::max<std::uint64_t>(options_.most_bytes / 16, 1)) return;
    new_bytes_ = 0;
  }
  collect();
}

/// What cannot be removed now is left for another time.
void Cache::collect() {
  try {
    collect_garbage(places_, options_.most_bytes);
  } catch (const std::exception& error) {
    problem(error.what());
  }
}

void Cache::finish() {
  {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return jobs_.empty() && busy_ == 0; });
    if (new_bytes_ == 0) return;
    // Looking at every file takes a while in a large cache: not after each small run.
    const bool little = new_bytes_ < options_.most_bytes / 1000;
    if (little && used_since(places_.folder / collected, std::chrono::hours(1))) return;
    new_bytes_ = 0;
  }
  collect();
}

Cache::Use Cache::use() const {
  const std::lock_guard lock(mutex_);
  return use_;
}

}  // namespace atrium
