#include "graph/cache/records.hpp"

#include <algorithm>
#include <functional>

#include "graph/api/error.hpp"
#include "graph/api/files.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;

std::optional<CacheRecord> read_file(const fs::path& file) {
  try {
    return read_record(read_text(file));
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<CacheRecord> record_of(const CachePlaces& places, const std::string& type, const std::string& key) {
  return read_file(places.record(type, key));
}

std::vector<CacheRecord> records_of(const CachePlaces& places, const std::string& type, std::size_t most) {
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(places.records(type), ignored))
    if (entry.path().extension() != ".part") files.emplace_back(entry.last_write_time(ignored), entry.path());
  std::sort(files.begin(), files.end(), std::greater());
  if (files.size() > most) files.resize(most);
  std::vector<CacheRecord> records;
  for (const auto& [used, file] : files)
    if (auto record = read_file(file)) records.push_back(std::move(*record));
  return records;
}

}  // namespace atrium
