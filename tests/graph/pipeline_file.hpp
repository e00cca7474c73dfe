#pragma once
#include <gtest/gtest.h>

#include <stdexcept>

#include "graph/pipeline/pipeline.hpp"
#include "tests/graph/folder.hpp"
#include "tests/graph/test_nodes.hpp"

namespace atrium::test {

/// Loads pipeline files that a test writes, with the node types of test_nodes.hpp.
class PipelineFile : public testing::Test {
 protected:
  PipelineFile() { test::add_test_nodes(registry); }

  LoadResult load(const std::filesystem::path& file, const std::vector<std::string>& settings = {},
                  LoadOptions options = {}) {
    std::vector<Override> overrides;
    for (const auto& text : settings) overrides.push_back({text, "-s " + text});
    return load_pipeline(file, overrides, registry, options);
  }
  LoadResult load_text(const std::string& text, const std::vector<std::string>& settings = {}) {
    return load(folder.write("p.yaml", text), settings);
  }
  static std::string messages(const LoadResult& result) {
    std::string text;
    for (const auto& error : result.errors) text += to_string(error) + "\n";
    return text;
  }
  static std::vector<std::string> paths(const Pipeline& pipeline) {
    std::vector<std::string> result;
    for (const std::size_t n : all_nodes(pipeline)) result.push_back(pipeline[n].path);
    return result;
  }
  static const PipelineNode& node(const Pipeline& pipeline, const std::string& path) {
    return pipeline[index(pipeline, path)];
  }
  static std::size_t index(const Pipeline& pipeline, const std::string& path) {
    for (const std::size_t n : all_nodes(pipeline))
      if (pipeline[n].path == path) return n;
    throw std::runtime_error("no node " + path);
  }
  static ParamValue value(const Pipeline& pipeline, const std::string& path, const std::string& name) {
    const auto& n = node(pipeline, path);
    for (std::size_t i = 0; i < n.params.size(); ++i)
      if (n.type->params[i].name == name) return n.params[i];
    throw std::runtime_error("no parameter " + name);
  }
  static std::string text(const std::filesystem::path& path) { return path.string(); }

  Folder folder;
  Registry registry{std::vector<std::filesystem::path>{}};
};

}  // namespace atrium::test
