// atrium view RUN: one HTML file that shows what a run has made.
#include "graph/report/view.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/report/page.hpp"

namespace atrium::cli {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
  std::string folder, file;
  double max_megabytes = 25;
  bool json = false;
};

int view(const ViewArguments& options) {
  const report::RunRecord run = report::read_run(options.folder);
  const fs::path target = options.file.empty() ? fs::path(options.folder) / "view.html" : fs::path(options.file);
  const auto [view, bytes] = report::write_view(target, run, report::page_template("view.html"),
                                                static_cast<std::size_t>(options.max_megabytes * 1e6));
  for (const auto& part : view.parts)
    if (part.path.empty()) say("note: without {}: {}\n", part.part, part.lacking);
  for (const auto& part : view.parts)
    if (!part.note.empty()) say("note: {}\n", part.note);
  if (options.json) {
    nlohmann::ordered_json parts = nlohmann::ordered_json::object();
    nlohmann::ordered_json lacking = nlohmann::ordered_json::object();
    nlohmann::ordered_json notes = nlohmann::ordered_json::array();
    for (const auto& part : view.parts)
      if (!part.note.empty()) notes.push_back(part.note);
    for (const auto& part : view.parts)
      (part.path.empty() ? lacking : parts)[part.part] = part.path.empty() ? part.lacking : part.path;
    const nlohmann::ordered_json json{{"file", fs::absolute(target).lexically_normal().string()},
                                      {"bytes", bytes},
                                      {"parts", std::move(parts)},
                                      {"lacking", std::move(lacking)},
                                      {"notes", std::move(notes)}};
    fmt::print("{}\n", json_text(json, 2));
  } else {
    fmt::print("{}: {} of the run, {:.1f} MB\n", target.string(), counted(view.parts.size() - view.lacking, "file"),
               static_cast<double>(bytes) / 1e6);
  }
  return ok;
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "view", "Writes one HTML file that shows a run: the scan, the model, the plan and the tables side by side.");
  const auto options = std::make_shared<ViewArguments>();
  verb->add_option("RUN", options->folder, "the folder of a run, or of one variant of a sweep")
      ->required()
      ->type_name("");
  verb->add_option("-o,--output", options->file, "the file to write (default: RUN/view.html)")->type_name("FILE");
  verb->add_option("--max-size", options->max_megabytes,
                   "megabytes of the page at most; the scan's points are thinned to it, what has no room is left out")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e6));
  verb->add_flag("--json", options->json, "what was written as JSON on stdout");
  verb->callback([options, &exit_code] { exit_code = view(*options); });
}

}  // namespace atrium::cli
