#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"

namespace atrium::io {

/// A folder of its own for a test, removed at its end, and a context that writes there and keeps the warnings.
class Files : public ::testing::Test {
 protected:
  class Host : public ContextHost {
   public:
    explicit Host(std::filesystem::path folder) : folder_(std::move(folder)) {}
    void log(Level level, std::string_view text) override {
      const std::lock_guard lock(mutex_);
      if (level == Level::warning) warnings.emplace_back(text);
    }
    std::filesystem::path output_folder() override { return folder_; }
    std::vector<std::string> warnings;

   private:
    std::filesystem::path folder_;
    std::mutex mutex_;
  };

  static std::string safe(std::string name) {
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
  }

  Files() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder =
        std::filesystem::temp_directory_path() / ("atrium_io_" + std::to_string(::getpid()) + "_" + safe(info->name()));
    std::filesystem::create_directories(folder);
    host = std::make_shared<Host>(folder);
    context = Context(1, host);
  }
  ~Files() override { std::filesystem::remove_all(folder); }

  std::string path(const std::string& name) const { return (folder / name).string(); }
  /// Writes a file and gives its path.
  std::string file(const std::string& name, const std::string& content) const {
    std::filesystem::remove(folder / name);  // ext4 flushes a file that is cut and written again
    std::ofstream(folder / name, std::ios::binary) << content;
    return path(name);
  }
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder / name, std::ios::binary).rdbuf();
    return text.str();
  }
  bool warned(const std::string& part) const {
    for (const auto& w : host->warnings)
      if (w.find(part) != std::string::npos) return true;
    return false;
  }
  std::string warnings() const {
    std::string all;
    for (const auto& w : host->warnings) all += w + "\n";
    return all;
  }

  std::filesystem::path folder;
  std::shared_ptr<Host> host;
  Context context;
};

/// The message of the Error that f throws; "" if it throws none.
template <class F>
std::string error_of(F&& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

#define EXPECT_CONTAINS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << (text)

template <class T>
void put(std::string& bytes, T value, bool swapped = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (swapped) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

}  // namespace atrium::io
