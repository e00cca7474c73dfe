// atrium why RUN NODE: why a node was run, or where its result came from.
#include "graph/why/why.hpp"

#include "graph/cli/verbs.hpp"

namespace atrium::cli {

void add_why(CLI::App& app, int& exit_code) {
  struct Options {
    std::string run, node, folder;
    bool json = false;
  };
  auto* verb = app.add_subcommand("why", "Says why a node of a run was computed, or where its result came from.");
  const auto options = std::make_shared<Options>();
  verb->add_option("RUN", options->run, "the folder of a run or of a sweep")->required()->type_name("");
  verb->add_option("NODE", options->node, "the node's address (of a sweep: VARIANT/NODE)")->required()->type_name("");
  verb->add_option("--cache", options->folder, "the cache's folder (default: the one of the run)")->type_name("DIR");
  verb->add_flag("--json", options->json, "as JSON on stdout");
  verb->callback([options, &exit_code] {
    const Reason reason = reason_of(options->run, options->node, options->folder);
    fmt::print("{}", options->json ? as_json(reason) : as_text(reason));
    exit_code = ok;
  });
}

}  // namespace atrium::cli
