#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "graph/pipeline/pipeline.hpp"
#include "graph/pipeline/yaml_tree.hpp"

namespace atrium {

/// A file as findings name it and as relative paths in it are meant. The command line is one too.
struct SourceFile {
  std::string name;              ///< "pipelines/paper.yaml"
  std::filesystem::path folder;  ///< absolute
  std::size_t order = 0;         ///< findings are sorted by it
  bool picture = false;          ///< the file is a picture that holds the pipeline
};

/// A place in a file.
struct Where {
  const SourceFile* file = nullptr;
  Place place;
};
/// "room.yaml:14:22".
std::string to_string(const Where& where);

/// Collects what is wrong with a pipeline.
class Findings {
 public:
  void error(const Where& where, std::string message, std::string help = {}, std::vector<std::string> notes = {});
  void warning(const Where& where, std::string message, std::string help = {}, std::vector<std::string> notes = {});
  std::size_t error_count() const { return errors_.size(); }
  std::size_t count() const { return errors_.size() + warnings_.size(); }

  /// did_you_mean(), for the first hundred findings: a file full of errors must not take minutes.
  std::string suggest(std::string_view word, const std::vector<std::string>& candidates);
  /// Whether it is worth listing candidates.
  bool may_suggest() const { return suggestions_ < most_suggestions; }

  /// Sorted by place, each finding once (a sub-pipeline that is used twice has its mistakes twice).
  std::vector<Diagnostic> errors() const { return sorted(errors_); }
  std::vector<Diagnostic> warnings() const { return sorted(warnings_); }

 private:
  struct Item {
    std::size_t order;
    Diagnostic diagnostic;
  };
  static Item item(const Where& where, std::string message, std::string help, std::vector<std::string> notes);
  static std::vector<Diagnostic> sorted(std::vector<Item> items);
  static constexpr int most_suggestions = 100;
  std::vector<Item> errors_, warnings_;
  int suggestions_ = 0;
};

}  // namespace atrium
