#pragma once
#include <optional>

#include "graph/report/picture.hpp"
#include "graph/report/run_record.hpp"

namespace atrium::report {

/// What differs between two runs, a and b. What is the same is not listed.
struct Difference {
  struct Parameter {
    std::string address;
    std::optional<std::string> a, b;  ///< nothing: that run has no such parameter
  };
  struct Metric {
    std::string name, unit;
    std::optional<Fact> a, b;
    std::optional<double> change;  ///< b − a, of numbers
  };
  struct PictureFile {
    std::string path;
    PixelDifference pixels;
    std::string problem;  ///< it cannot be read
  };
  struct File {
    std::string path;
    bool in_a = true, in_b = true;
    std::uint64_t bytes_a = 0, bytes_b = 0;
  };
  struct Node {
    std::string path, type, port;  ///< the node and its first output that differs; port "": its status
  };

  std::string status_a, status_b;
  std::vector<Parameter> parameters;
  std::vector<Metric> metrics;
  std::vector<PictureFile> pictures;  ///< by pixels: those whose pixels are the same are the same
  std::vector<File> files;            ///< by content
  std::optional<Node> first;          ///< in an order in which the nodes can run, of those that both runs have
  std::size_t different_nodes = 0, compared_nodes = 0, unknown_nodes = 0;  ///< unknown: without hashes

  bool same() const;
};

/// Compares them. With a folder, a picture is written there for each that differs.
Difference compare(const RunRecord& a, const RunRecord& b, const std::filesystem::path& pictures = {});

/// As people read it, and as JSON.
std::string as_text(const Difference& difference);
std::string as_json(const Difference& difference);

}  // namespace atrium::report
