// atrium report DIR: one HTML file about a sweep or a run.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/report/page.hpp"

namespace atrium::cli {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string folder, file;
  std::vector<std::string> models;
  std::size_t most_models = 1'000'000;
  double max_megabytes = 150;
  bool json = false;
};

int report(const ReportArguments& options) {
  const report::SweepRecord record = report::read_sweep_folder(options.folder);
  report::AttachmentOptions attach_options;
  attach_options.models = options.models;
  attach_options.most_models = options.most_models;
  attach_options.max_bytes = static_cast<std::size_t>(options.max_megabytes * 1e6);
  const report::Attachments attachments = report::attach(record, attach_options);
  const fs::path target = options.file.empty() ? fs::path(options.folder) / "report.html" : fs::path(options.file);
  const std::size_t bytes = report::write_page(target, record, attachments, report::page_template());
  auto notes = record.notes;
  notes.insert(notes.end(), attachments.notes.begin(), attachments.notes.end());
  for (const auto& note : notes) say("note: {}\n", note);
  if (options.json) {
    const nlohmann::ordered_json json{{"file", fs::absolute(target).lexically_normal().string()},
                                      {"bytes", bytes},
                                      {"variants", record.variants.size()},
                                      {"pictures", attachments.pictures},
                                      {"models", attachments.models},
                                      {"notes", notes}};
    fmt::print("{}\n", json_text(json, 2));
  } else {
    fmt::print("{}: {}, {}, {}, {:.1f} MB\n", target.string(), counted(record.variants.size(), "variant"),
               counted(attachments.pictures, "picture"), counted(attachments.models, "model"),
               static_cast<double>(bytes) / 1e6);
  }
  return ok;
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "report", "Writes one HTML file about a sweep or a run: table, plots, pictures, models in 3D, times.");
  const auto options = std::make_shared<ReportArguments>();
  verb->add_option("FOLDER", options->folder, "the folder of a sweep or of a run")->required()->type_name("");
  verb->add_option("-o,--output", options->file, "the file to write (default: FOLDER/report.html)")->type_name("FILE");
  verb->add_option(
          "--model", options->models,
          "a model that the variants have written, by its path in their folders; may be repeated (default: the "
          "smallest .glb, or .ply with faces, that most variants have)")
      ->type_name("FILE");
  verb->add_option("--most-models", options->most_models, "include the models of at most so many variants");
  verb->add_option("--max-size", options->max_megabytes, "megabytes of pictures and models at most")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e6));
  verb->add_flag("--json", options->json, "what was written as JSON on stdout");
  verb->callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace atrium::cli
