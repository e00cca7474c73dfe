// atrium diff RUN RUN: what differs between two runs, or two variants of a sweep.
#include <fmt/format.h>

#include "graph/cli/verbs.hpp"
#include "graph/report/difference.hpp"

namespace atrium::cli {
namespace {

struct DiffArguments {
  std::string a, b, pictures;
  bool json = false, exit_code = false;
};

int compare(const DiffArguments& options) {
  const report::RunRecord a = report::read_run(options.a);
  const report::RunRecord b = report::read_run(options.b);
  for (const auto* run : {&a, &b})
    for (const auto& path : run->outside)
      say("note: {} is not in the folder {}: it is not compared\n", path, run->folder.string());
  const report::Difference difference = report::compare(a, b, options.pictures);
  fmt::print("{}", options.json ? report::as_json(difference) : report::as_text(difference));
  return options.exit_code && !difference.same() ? failed : ok;
}

/// 1 says that they differ: what goes wrong is another number.
int diff(const DiffArguments& options) {
  try {
    return compare(options);
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const Error*>(&error);
    print_error(error.what(), known == nullptr ? "" : known->help());
    return usage;
  }
}

}  // namespace

void add_diff(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "diff",
      "Says what differs between two runs or variants: parameters, metrics, pictures, files, and the first node.");
  const auto options = std::make_shared<DiffArguments>();
  verb->add_option("RUN", options->a, "the folder of a run, or of a variant (SWEEP/variants/ID)")
      ->required()
      ->type_name("");
  verb->add_option("OTHER", options->b, "the other one")->required()->type_name("");
  verb->add_option("--pictures", options->pictures, "write a picture for each that differs into this folder")
      ->type_name("DIR");
  verb->add_flag("--json", options->json, "as JSON on stdout");
  verb->add_flag("--exit-code", options->exit_code,
                 "end with 1 if they differ, else with 0 (without it: with 0 either way); with 2 if they cannot be "
                 "compared");
  verb->callback([options, &exit_code] { exit_code = diff(*options); });
}

}  // namespace atrium::cli
