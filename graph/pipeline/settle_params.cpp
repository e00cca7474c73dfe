#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "graph/api/broken_link.hpp"
#include "graph/api/folder_lock.hpp"
#include "graph/api/suggest.hpp"
#include "graph/api/text.hpp"
#include "graph/api/text_check.hpp"
#include "graph/pipeline/expansion.hpp"
#include "graph/pipeline/files_of.hpp"

namespace atrium {
namespace {

/// Files that the run itself writes into its folder.
constexpr std::string_view reserved_files[] = {"resolved.yaml", "manifest.json", "trace.json", ".written",
                                               lock_file_name};

class ParamReader {
 public:
  ParamReader(Expansion& expansion, Overrides& overrides, Findings& findings)
      : expansion_(expansion), overrides_(overrides), findings_(findings) {}

  void read(std::size_t n) {
    PipelineNode& node = expansion_.graph[n];
    const NodeOrigin& origin = expansion_.origins[n];
    node_ = &node;
    origin_ = &origin;
    for (const auto& param : node.type->params) node.params.push_back(param.initial);
    std::vector<bool> set(node.params.size(), false);
    for (const auto& setting : origin.source->params) {
      const std::size_t index = find(setting.name.text);
      if (index == node.params.size()) {
        report_unknown(setting);
      } else if (overridden(setting.name.text) == nullptr) {
        const Where where = origin.scope->at(setting.place);
        apply(index, settle(setting, *origin.scope, origin.scope->document->source, where, findings_), where);
        set[index] = true;
      }
    }
    read_overrides(set);
    for (std::size_t i = 0; i < set.size(); ++i) {
      const ParamInfo& info = node.type->params[i];
      if (set[i]) continue;
      if (is_required(info))
        findings_.error(origin.where(),
                        fmt::format("the parameter '{}' of '{}' ({}) is missing", info.name, origin.source->id.text,
                                    node.type->type),
                        describe_param(info), origin_->notes());
      else
        place_path(i, origin.where(), {}, {&origin.scope->document->source});
    }
  }

  void check_output_files() {
    for (auto it = written_.begin(); it != written_.end(); ++it) {
      const auto next = std::next(it);
      if (next == written_.end()) break;
      const std::string& path = it->first;
      // The map's order puts "a/b" after "a", with names like "a-x" between them at most.
      for (auto inner = written_.lower_bound(path + "/"); inner != written_.end(); ++inner) {
        if (!inner->first.starts_with(path + "/")) break;
        findings_.error(inner->second.where, fmt::format("'{}' writes '{}', but '{}' writes a file '{}'",
                                                         inner->second.node, inner->first, it->second.node, path));
      }
    }
  }

 private:
  struct Written {
    std::string node;
    Where where;
  };

  std::size_t find(const std::string& name) const {
    const auto& params = node_->type->params;
    const auto same = [&](const ParamInfo& info) { return info.name == name; };
    return static_cast<std::size_t>(std::find_if(params.begin(), params.end(), same) - params.begin());
  }

  const ParsedOverride* overridden(const std::string& name) const {
    for (const auto* set : overrides_.of(node_->path))
      if (set->name == name) return set;
    return nullptr;
  }

  std::pair<std::string, std::string> unknown(const std::string& name) {
    std::vector<std::string> names;
    for (const auto& info : node_->type->params) names.push_back(info.name);
    std::string help = findings_.suggest(name, names);
    if (!help.empty())
      help += fmt::format(" ({})", describe_param(node_->type->params[find(nearest(name, names))]));
    else if (names.empty())
      help = fmt::format("{} has no parameters", node_->type->type);
    else
      help = fmt::format("parameters of {}: {}", node_->type->type, join_words(names, 40));
    return {fmt::format("unknown parameter '{}' of '{}' ({})", name, origin_->source->id.text, node_->type->type),
            help};
  }

  void report_unknown(const Setting& setting) {
    const Where where = origin_->scope->at(setting.name.place);
    if (origin_->swap != nullptr && node_->type->type != origin_->source->type.text) {
      findings_.warning(
          where,
          fmt::format("the parameter '{}' is ignored: {} has none of that name", setting.name.text, node_->type->type),
          {}, origin_->notes());
      return;
    }
    auto [message, help] = unknown(setting.name.text);
    findings_.error(where, std::move(message), std::move(help));
  }

  void read_overrides(std::vector<bool>& set) {
    for (const auto* override_ : overrides_.of(node_->path)) {
      if (override_->name == "type") continue;
      Where where = origin_->where();
      for (const auto& setting : origin_->source->params)
        if (setting.name.text == override_->name) where.place = setting.place;
      const std::size_t index = find(override_->name);
      if (index == node_->params.size()) {
        auto [message, help] = unknown(override_->name);
        findings_.error(where, std::move(message), std::move(help), {override_->note});
        continue;
      }
      apply(index,
            settle(override_->setting, expansion_.scopes.front(), *override_->source, where, findings_,
                   {override_->note}),
            where);
      set[index] = true;
    }
  }

  void apply(std::size_t index, const SettledValue& value, const Where& where) {
    if (value.broken || !value.missing.empty()) return;
    const ParamInfo& info = node_->type->params[index];
    if (info.kind == ParamKind::input_paths && !value.value.is_list && is_several(value, where, info)) return;
    try {
      node_->params[index] = parse_param(info, value.value);
      if (info.kind == ParamKind::text)
        check_text(node_->type->type, info.name, std::get<std::string>(node_->params[index]));
    } catch (const Error& error) {
      std::vector<std::string> all = value.notes;
      if (origin_->swap != nullptr) all.push_back(origin_->swap->note);
      findings_.error(where, error.what(), error.help(), std::move(all));
      return;
    }
    place_path(index, where, value.notes, value.bases);
  }

  /// A folder or a pattern without brackets: that could be meant as one scene a file, as a sweep's `scenes` are.
  bool is_several(const SettledValue& value, const Where& where, const ParamInfo& info) {
    const std::string& text = value.value.items.front();
    const std::filesystem::path full = value.bases.front()->folder / text;
    std::error_code ignored;
    const bool folder = std::filesystem::is_directory(full, ignored);
    if (!folder && (!is_pattern(text) || std::filesystem::exists(full, ignored))) return false;
    findings_.error(where,
                    fmt::format("'{}' is a {}: which file is '{}'?", text, folder ? "folder" : "pattern", info.name),
                    fmt::format("in brackets all its files are taken together: [{}]; a sweep file's `scenes` makes one "
                                "scene of each",
                                text),
                    value.notes);
    return true;
  }

  /// Puts the files that fit in place of a pattern.
  void expand_patterns(std::vector<std::string>& paths, std::vector<const SourceFile*>& bases, const ParamInfo& info,
                       const Where& where, const std::vector<std::string>& origin) {
    std::vector<std::string> expanded;
    std::vector<const SourceFile*> bases_of_expanded;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const SourceFile* const base = bases[std::min(i, bases.size() - 1)];
      std::error_code ignored;
      std::vector<std::string> found{paths[i]};
      if (is_pattern(paths[i]) && !expansion_.any_files && !std::filesystem::exists(base->folder / paths[i], ignored)) {
        found.clear();
        for (const auto& file : files_of(base->folder, paths[i])) found.push_back(file.string());
        if (found.empty())
          findings_.error(where, fmt::format("no file fits '{}' of '{}'", paths[i], info.name),
                          fmt::format("a pattern such as scans/*.e57; it is relative to {}", base->folder.string()),
                          origin);
      }
      expanded.insert(expanded.end(), found.begin(), found.end());
      bases_of_expanded.insert(bases_of_expanded.end(), found.size(), base);
    }
    paths = std::move(expanded);
    bases = std::move(bases_of_expanded);
  }

  void place_path(std::size_t index, const Where& where, const std::vector<std::string>& origin,
                  const std::vector<const SourceFile*>& bases) {
    const ParamInfo& info = node_->type->params[index];
    ParamValue& value = node_->params[index];
    if (info.kind == ParamKind::input_path) {
      input_path(std::get<std::string>(value), info, where, origin, *bases.front());
    } else if (info.kind == ParamKind::output_path) {
      output_path(std::get<std::string>(value), info, where, origin);
    } else if (info.kind == ParamKind::input_paths) {
      auto& paths = std::get<std::vector<std::string>>(value);
      std::vector<const SourceFile*> of_path = bases;
      expand_patterns(paths, of_path, info, where, origin);
      for (std::size_t i = 0; i < paths.size(); ++i) input_path(paths[i], info, where, origin, *of_path[i]);
    }
  }

  void input_path(std::string& path, const ParamInfo& info, const Where& where, const std::vector<std::string>& origin,
                  const SourceFile& base) {
    if (path.empty()) {
      findings_.error(where, fmt::format("'{}' is an empty path", info.name), describe_param(info), origin);
      return;
    }
    const std::filesystem::path full = (base.folder / path).lexically_normal();
    path = full.string();
    if (first_not_text(path) != std::string::npos)
      findings_.warning(
          where, fmt::format("the path of '{}' is not UTF-8: the run's resolved.yaml cannot be run again", info.name),
          "rename its folder or file (convmv does it for many)", origin);
    std::error_code ignored;
    if (expansion_.any_files || std::filesystem::exists(full, ignored)) return;
    if (const std::string link = broken_link(full); !link.empty()) {
      findings_.error(where, fmt::format("no such file: {} {}", full.string(), link),
                      "fetch what it stands for (dvc pull, git annex get), or give another file", origin);
      return;
    }
    std::vector<std::string> siblings;
    const bool folder = std::filesystem::is_directory(full.parent_path(), ignored);
    for (const auto& entry : std::filesystem::directory_iterator(full.parent_path(), ignored))
      if (siblings.size() < 1000) siblings.push_back(entry.path().filename().string());
    std::sort(siblings.begin(), siblings.end());
    std::vector<std::string> all = origin;
    if (base.picture)
      all.push_back(fmt::format("a picture names files as seen from the folder of its run; -s {}.{}=FILE names another",
                                node_->path, info.name));
    std::string help = "the working folder is not there any more: give an absolute path";
    if (folder)
      help = findings_.suggest(full.filename().string(), siblings);
    else if (!full.parent_path().empty())
      help = fmt::format("there is no folder {}", full.parent_path().string());
    findings_.error(where, fmt::format("no such file: {}", full.string()), std::move(help), std::move(all));
  }

  void output_path(std::string& path, const ParamInfo& info, const Where& where,
                   const std::vector<std::string>& origin) {
    const std::filesystem::path relative = std::filesystem::path(path).lexically_normal();
    const bool escapes = relative.is_absolute() || relative.empty() || *relative.begin() == ".." || relative == "." ||
                         !relative.has_filename();
    if (escapes) {
      findings_.error(where, fmt::format("'{}' cannot be '{}'", info.name, path),
                      "a file within the run's folder: a relative path without '..'", origin);
      return;
    }
    path = (std::filesystem::path(origin_->scope->prefix) / relative).string();
    if (std::find(std::begin(reserved_files), std::end(reserved_files), path) != std::end(reserved_files)) {
      findings_.error(where, fmt::format("'{}' is a file that the run itself writes", path), "take another name",
                      origin);
      return;
    }
    const auto [other, fresh] = written_.try_emplace(path, Written{node_->path, where});
    if (!fresh)
      findings_.error(where, fmt::format("'{}' and '{}' both write '{}'", other->second.node, node_->path, path),
                      "give each its own path", origin);
  }

  Expansion& expansion_;
  Overrides& overrides_;
  Findings& findings_;
  PipelineNode* node_ = nullptr;
  const NodeOrigin* origin_ = nullptr;
  std::map<std::string, Written> written_;
};

}  // namespace

void settle_params(Expansion& expansion, Overrides& overrides, Findings& findings) {
  ParamReader reader(expansion, overrides, findings);
  for (const std::size_t n : all_nodes(expansion.graph))
    if (expansion.graph[n].type != nullptr) reader.read(n);
  reader.check_output_files();
}

}  // namespace atrium
