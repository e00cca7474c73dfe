#pragma once
#include <deque>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "graph/pipeline/document.hpp"
#include "graph/pipeline/overrides.hpp"
#include "graph/pipeline/registry.hpp"

namespace atrium {

/// A value whose variables are replaced.
struct SettledValue {
  RawValue value;
  std::vector<const SourceFile*> bases;  ///< per item: the file (or command line) that sets it
  std::vector<std::string> notes;        ///< where it was set, when that is not where it stands
  std::vector<std::string> missing;      ///< variables without a value that it needs
  bool broken = false;                   ///< reported already
};

struct Scope;

/// What a name in `nodes` stands for: a node or an opened sub-pipeline; neither when it could not be opened.
struct Member {
  static constexpr std::size_t none = ~std::size_t{0};
  std::size_t node = none;  ///< of the graph
  Scope* scope = nullptr;
};

/// One use of a document: the outermost file, or a sub-pipeline node.
struct Scope {
  const Document* document = nullptr;
  Scope* parent = nullptr;
  const DocumentNode* node = nullptr;  ///< the sub-pipeline node in the parent's document
  std::string prefix;                  ///< "" or "shell/"
  std::unordered_map<std::string, SettledValue> variables;
  std::unordered_map<std::string, Member> members;
  std::unordered_set<std::string> dormant;  ///< nodes that only the defaults of wired inputs need: left out
  bool used = false;                        ///< something reads one of its outputs

  Where at(Place place) const { return {&document->source, place}; }
};

/// Where a node of the dataflow stands in the files.
struct NodeOrigin {
  const Scope* scope = nullptr;
  const DocumentNode* source = nullptr;
  const ParsedOverride* swap = nullptr;  ///< the -s that replaced its type
  bool used = false;                     ///< something reads one of its outputs, or its file exports one

  Where where() const { return scope->at(source->id.place); }
  /// For what is said of the node: by what its type was set.
  std::vector<std::string> notes() const {
    return swap == nullptr ? std::vector<std::string>{} : std::vector{swap->note};
  }
};

/// The pipeline with its sub-pipelines opened, before and while it is checked.
struct Expansion {
  std::vector<std::shared_ptr<const Document>> documents;
  ReadDocuments* read = nullptr;               ///< what reads them
  std::deque<Scope> scopes;                    ///< the outermost first
  std::deque<DocumentNode> swapped;            ///< nodes that a setting made sub-pipelines of another file
  Dataflow graph;                              ///< a node without a type (null) is reported, and not checked further
  std::vector<NodeOrigin> origins;             ///< of the graph's nodes
  bool any_files = false;                      ///< files that nodes read need not exist
  std::vector<std::string> missing_variables;  ///< of the outermost file, without a value
};

/// Opens sub-pipelines (recursively, each file read once), settles variables, finds node types and applies swaps.
class Expander {
 public:
  Expander(Expansion& expansion, Overrides& overrides, Registry& registry, Findings& findings)
      : expansion_(expansion), overrides_(overrides), registry_(registry), findings_(findings) {}
  void expand(const Document& root);

 private:
  void fill(Scope& scope);
  static std::unordered_set<std::string> dormant_nodes(const Scope& scope);
  void settle_variables(Scope& scope);
  void add_node(Scope& scope, const DocumentNode& node);
  const DocumentNode& swapped(const DocumentNode& node, const ParsedOverride& swap);
  /// `swap`: the setting that names the file; null: the node's own file does.
  void open_pipeline(Scope& scope, const DocumentNode& node, const ParsedOverride* swap);
  const Document* document_of(const Scope& scope, const DocumentNode& node, const ParsedOverride* swap);
  bool opens_itself(const Scope& scope, const DocumentNode& node, const std::string& identity, const std::string& name);
  void check_given_variables(const Scope& scope);
  void report_unknown_type(const Where& where, const std::string& type, std::vector<std::string> notes);
  void report_unknown_nodes();

  Expansion& expansion_;
  Overrides& overrides_;
  Registry& registry_;
  Findings& findings_;
  struct Opened {
    std::filesystem::path path;
    bool is_installed = false;
    std::string identity;  ///< its canonical form; empty: there is none
  };
  std::unordered_map<std::string, Opened> opened_;                ///< by folder and the path as it is written
  std::unordered_map<std::string, const Document*> by_identity_;  ///< null: it could not be read
  std::vector<std::string> all_types_, modules_;
};

/// Whether the scope's own input is wired from outside.
bool is_wired(const Scope& scope, const std::string& input);

/// Replaces variables and escapes in a value that stands in `scope`. `from` is what relative paths in it are relative
/// to, `where` and `notes` are for what is wrong with it.
SettledValue settle(const Setting& setting, const Scope& scope, const SourceFile& from, const Where& where,
                    Findings& findings, std::vector<std::string> notes = {});

/// Reads the parameters of every node: bounds, units, files that must exist, files that are written twice.
void settle_params(Expansion& expansion, Overrides& overrides, Findings& findings);

/// Joins the nodes: ports, their types, what is not wired. Makes the edges and the outputs.
void wire(Expansion& expansion, Findings& findings);
/// Nodes, sub-pipelines and inputs that nothing uses; after wire().
void check_use(const Expansion& expansion, Findings& findings);
/// Cycles, with their path.
void check_cycles(const Expansion& expansion, Findings& findings);

}  // namespace atrium
