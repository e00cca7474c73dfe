#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "graph/api/suggest.hpp"
#include "graph/pipeline/expansion.hpp"

namespace atrium {
namespace {

/// What a reference leads to.
struct Endpoint {
  enum class Kind { unknown, node, outside } kind = Kind::unknown;  ///< unknown: reported, or not to be checked
  Source from;
  std::string type;  ///< of the port
  std::vector<std::string> notes;
};

std::vector<std::string> names_of(const std::vector<PortInfo>& ports) {
  return words_of(ports, [](const PortInfo& port) { return port.name; });
}

std::size_t find_port(const std::vector<PortInfo>& ports, const std::string& name) {
  const auto same = [&](const PortInfo& port) { return port.name == name; };
  return static_cast<std::size_t>(std::find_if(ports.begin(), ports.end(), same) - ports.begin());
}

std::string text_of(const Reference& reference) {
  return reference.port.empty() ? reference.node : reference.node + "." + reference.port;
}

class Wirer {
 public:
  Wirer(Expansion& expansion, Findings& findings)
      : expansion_(expansion), graph_(expansion.graph), origins_(expansion.origins), findings_(findings) {}

  void wire() {
    for (const std::size_t n : all_nodes(graph_)) wire_node(n);
    for (auto& scope : expansion_.scopes) {
      if (scope.node != nullptr) check_pipeline_inputs(scope);
      check_defaults(scope);
      export_outputs(scope);
    }
  }

 private:
  void wire_node(std::size_t n) {
    const NodeOrigin& origin = origins_[n];
    const NodeType* type = graph_[n].type;
    if (type == nullptr) {
      for (const auto& wiring : origin.source->inputs)  // the references can be checked all the same
        for (const auto& source : wiring.sources) resolve(*origin.scope, source, true);
      return;
    }
    const auto& ports = type->inputs;
    std::vector<const Wiring*> wired(ports.size(), nullptr);
    for (const auto& wiring : origin.source->inputs) {
      const std::size_t index = find_port(ports, wiring.port.text);
      if (index == ports.size()) {
        report_unknown_input(n, wiring.port, names_of(ports));
        for (const auto& source : wiring.sources) resolve(*origin.scope, source, true);
        continue;
      }
      wired[index] = &wiring;
    }
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (wired[i] != nullptr)
        wire_port(n, i, *wired[i]);
      else if (!ports[i].optional)
        findings_.error(
            origin.where(),
            fmt::format("the input '{}' of '{}' ({}) is not wired", ports[i].name, origin.source->id.text, type->type),
            fmt::format("it takes {}{}: add `in: {{{}: node.port}}`", ports[i].repeated ? "a list of " : "",
                        ports[i].type, ports[i].name),
            origin.notes());
    }
  }

  void report_unknown_input(std::size_t n, const Located& port, const std::vector<std::string>& names) {
    const NodeOrigin& origin = origins_[n];
    const std::string& type = graph_[n].type->type;
    const std::string hint = findings_.suggest(port.text, names);
    findings_.error(origin.scope->at(port.place),
                    fmt::format("unknown input '{}' of '{}' ({})", port.text, origin.source->id.text, type),
                    !hint.empty()   ? hint
                    : names.empty() ? fmt::format("{} has no inputs", type)
                                    : fmt::format("inputs of {}: {}", type, join_words(names)),
                    origin.notes());
  }

  void wire_port(std::size_t n, std::size_t index, const Wiring& wiring) {
    const NodeOrigin& origin = origins_[n];
    const PortInfo& port = graph_[n].type->inputs[index];
    if (wiring.is_list && !port.repeated)
      findings_.error(
          origin.scope->at(wiring.port.place),
          fmt::format("the input '{}' of '{}' takes one edge, not a list", port.name, origin.source->id.text), {},
          origin.notes());
    for (std::size_t place = 0; place < wiring.sources.size(); ++place) {
      const Reference& source = wiring.sources[place];
      Endpoint from = resolve(*origin.scope, source, true);
      if (from.kind == Endpoint::Kind::unknown) continue;
      const Where where = origin.scope->at(source.place);
      if (from.type != port.type) {
        auto notes = std::move(from.notes);
        for (auto& note : origin.notes()) notes.push_back(std::move(note));
        report_type(where, source, from.type, fmt::format("'{}' of '{}'", port.name, origin.source->id.text), port.type,
                    std::move(notes));
      } else if (from.kind == Endpoint::Kind::node) {
        check_layout(where, from.from, n, index);
        connect(from.from, n, index, place, graph_);
      }
    }
  }

  /// Two plugins may have been built with different fields of a type of the same name.
  void check_layout(const Where& where, Source from, std::size_t to, std::size_t port) {
    const NodeType& maker = *graph_[from.node].type;
    const NodeType& reader = *graph_[to].type;
    const FlatType* given = maker.outputs[from.output].flat;
    const FlatType* wanted = reader.inputs[port].flat;
    if (given == nullptr || wanted == nullptr || given->layout == wanted->layout) return;
    findings_.error(where,
                    fmt::format("the plugins of {} and {} were built with different fields of the type {}", maker.type,
                                reader.type, maker.outputs[from.output].type),
                    "build both again with the same modules/types");
  }

  void report_type(const Where& where, const Reference& source, const std::string& type, const std::string& target,
                   const std::string& wanted, std::vector<std::string> notes) {
    findings_.error(where, fmt::format("'{}' is {}, but the input {} takes {}", text_of(source), type, target, wanted),
                    {}, std::move(notes));
  }

  /// Follows a reference to the node that makes the value, through sub-pipelines. Only the first step is reported: the
  /// steps inside other files are checked where they stand.
  Endpoint resolve(const Scope& start, const Reference& first, bool report) {
    const Scope* scope = &start;
    const Reference* reference = &first;
    const std::size_t limit = 2 * expansion_.scopes.size() + 2;
    Endpoint result;
    for (std::size_t step = 0; step < limit; ++step) {
      const bool loud = report && step == 0;
      if (reference->node == "inputs") {
        const DocumentInput* input = declared_input(*scope, *reference, loud);
        if (input == nullptr) return result;
        if (result.type.empty()) result.type = input->type.text;
        if (input->default_source && !is_wired(*scope, reference->port)) {
          reference = &*input->default_source;
          continue;
        }
        if (scope->parent == nullptr) {
          result.kind = Endpoint::Kind::outside;
          return result;
        }
        reference = binding(*scope, reference->port);
        scope = scope->parent;
        if (reference == nullptr) return result;
        continue;
      }
      const auto member = scope->members.find(reference->node);
      if (member == scope->members.end()) {
        if (loud) report_unknown_node(*scope, *reference);
        return result;
      }
      if (member->second.node != Member::none) return at_node(*scope, *reference, member->second.node, result, loud);
      if (member->second.scope == nullptr) return result;
      Scope& inner = *member->second.scope;
      inner.used = true;
      reference = pipeline_output(*scope, inner, *reference, loud);
      if (reference == nullptr) return result;
      scope = &inner;
    }
    if (first.node != "inputs")  // the loop is where the sub-pipelines are wired, not in their files
      findings_.error(start.at(first.place),
                      fmt::format("'{}' leads through sub-pipelines back to itself", text_of(first)));
    return {};
  }

  Endpoint at_node(const Scope& scope, const Reference& reference, std::size_t index, Endpoint result, bool loud) {
    NodeOrigin& origin = origins_[index];
    const NodeType* type = graph_[index].type;
    origin.used = true;
    if (type == nullptr) return result;
    const auto& outputs = type->outputs;
    const std::size_t port = find_port(outputs, reference.port);
    if (port == outputs.size()) {
      if (loud)
        report_unknown_output(scope, reference, fmt::format("'{}' ({})", reference.node, type->type), names_of(outputs),
                              origin.notes());
      return result;
    }
    result.kind = Endpoint::Kind::node;
    result.from = {index, port};
    if (result.type.empty()) result.type = outputs[port].type;
    result.notes = origin.notes();
    return result;
  }

  void report_unknown_output(const Scope& scope, const Reference& reference, const std::string& of,
                             const std::vector<std::string>& names, std::vector<std::string> notes) {
    std::string help;
    if (reference.port.empty() && names.size() == 1)
      help = fmt::format("did you mean '{}.{}'?", reference.node, names[0]);
    else if (!reference.port.empty())
      help = findings_.suggest(reference.port, names);
    if (help.empty()) help = names.empty() ? "it has no outputs" : "its outputs: " + join_words(names);
    findings_.error(scope.at(reference.place),
                    reference.port.empty() ? fmt::format("'{}' names no output of {}", reference.node, of)
                                           : fmt::format("unknown output '{}' of {}", reference.port, of),
                    std::move(help), std::move(notes));
  }

  void report_unknown_node(const Scope& scope, const Reference& reference) {
    const auto& nodes = scope.document->nodes;
    const bool is_written = std::any_of(nodes.begin(), nodes.end(),
                                        [&](const DocumentNode& node) { return node.id.text == reference.node; });
    if (is_written && findings_.error_count() > 0) return;  // why it is not there has been said: too many nodes
    std::vector<std::string> names;
    if (findings_.may_suggest()) {
      for (const auto& node : scope.document->nodes) names.push_back(node.id.text);
      if (!scope.document->inputs.empty()) names.emplace_back("inputs");
    }
    std::string help = findings_.suggest(reference.node, names);
    const std::string outer = reference.node.substr(0, reference.node.find('/'));
    if (const auto member = scope.members.find(outer); member != scope.members.end() && member->second.scope != nullptr)
      help = fmt::format("only the outputs of a sub-pipeline can be wired: '{}.OUTPUT'", outer);
    else if (help.empty() && variable_of(text_of(reference)))
      help = "variables stand for values, not for edges";
    else if (help.empty() && !names.empty())
      help = "nodes: " + join_words(names);
    findings_.error(scope.at(reference.place), fmt::format("unknown node '{}'", reference.node), std::move(help));
  }

  /// An input of a sub-pipeline as its file declares it.
  const DocumentInput* declared_input(const Scope& scope, const Reference& reference, bool loud) {
    std::vector<std::string> names;
    for (const auto& input : scope.document->inputs) {
      if (input.name.text == reference.port) return &input;
      names.push_back(input.name.text);
    }
    if (!loud) return nullptr;
    const std::string hint = findings_.suggest(reference.port, names);
    findings_.error(scope.at(reference.place), fmt::format("unknown input '{}' of the pipeline", reference.port),
                    !hint.empty()   ? hint
                    : names.empty() ? "declare it: `inputs: {name: Type}`"
                                    : "its inputs: " + join_words(names));
    return nullptr;
  }

  static const Reference* binding(const Scope& scope, const std::string& input) {
    for (const auto& wiring : scope.node->inputs)
      if (wiring.port.text == input) return wiring.sources.size() == 1 ? &wiring.sources.front() : nullptr;
    return nullptr;
  }

  /// The default of an input must have the type that the input is declared with. Where the input is wired, the default
  /// is not looked at.
  void check_defaults(const Scope& scope) {
    for (const auto& input : scope.document->inputs) {
      if (!input.default_source || is_wired(scope, input.name.text)) continue;
      const Endpoint from = resolve(scope, *input.default_source, true);
      if (from.kind != Endpoint::Kind::unknown && from.type != input.type.text)
        findings_.error(scope.at(input.default_source->place),
                        fmt::format("'{}' is {}, but the input '{}' is declared as {}", text_of(*input.default_source),
                                    from.type, input.name.text, input.type.text),
                        {}, from.notes);
    }
  }

  const Reference* pipeline_output(const Scope& scope, const Scope& inner, const Reference& reference, bool loud) {
    std::vector<std::string> names;
    for (const auto& output : inner.document->outputs) {
      if (output.name.text == reference.port) return &output.source;
      names.push_back(output.name.text);
    }
    if (loud)
      report_unknown_output(scope, reference, fmt::format("'{}' ({})", reference.node, inner.document->source.name),
                            names, {});
    return nullptr;
  }

  void check_pipeline_inputs(const Scope& scope) {
    const auto& declared = scope.document->inputs;
    const auto names = words_of(declared, [](const auto& input) { return input.name.text; });
    for (const auto& wiring : scope.node->inputs) {
      const auto place = std::find(names.begin(), names.end(), wiring.port.text);
      if (place == names.end()) {
        const std::string hint = findings_.suggest(wiring.port.text, names);
        findings_.error(scope.parent->at(wiring.port.place),
                        fmt::format("{} has no input '{}'", scope.document->source.name, wiring.port.text),
                        hint.empty() && !names.empty() ? "its inputs: " + join_words(names) : hint);
      }
      if (wiring.is_list)
        findings_.error(scope.parent->at(wiring.port.place),
                        fmt::format("the input '{}' of a sub-pipeline takes one edge, not a list", wiring.port.text));
      for (const auto& source : wiring.sources) {
        Endpoint from = resolve(*scope.parent, source, true);
        if (place == names.end() || from.kind == Endpoint::Kind::unknown) continue;
        const Located& wanted = declared[static_cast<std::size_t>(place - names.begin())].type;
        if (from.type != wanted.text)
          report_type(scope.parent->at(source.place), source, from.type,
                      fmt::format("'{}' of '{}'", wiring.port.text, scope.node->id.text), wanted.text,
                      std::move(from.notes));
      }
    }
    for (const auto& [name, type, default_source] : declared) {
      if (!default_source && !is_wired(scope, name.text))
        findings_.error(scope.parent->at(scope.node->id.place),
                        fmt::format("the input '{}' of '{}' ({}) is not wired", name.text, scope.node->id.text,
                                    scope.document->source.name),
                        fmt::format("it takes {}: add `in: {{{}: node.port}}`", type.text, name.text));
    }
  }

  void export_outputs(const Scope& scope) {
    for (const auto& output : scope.document->outputs) {
      const Endpoint from = resolve(scope, output.source, true);
      if (scope.parent == nullptr && from.kind == Endpoint::Kind::node)
        graph_[whole].outputs.push_back({output.name.text, from.from});
    }
  }

  Expansion& expansion_;
  Dataflow& graph_;
  std::vector<NodeOrigin>& origins_;
  Findings& findings_;
};

}  // namespace

void wire(Expansion& expansion, Findings& findings) { Wirer(expansion, findings).wire(); }

}  // namespace atrium
