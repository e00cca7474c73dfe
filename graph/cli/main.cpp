#include <cstdio>
#include <exception>

#include "graph/cli/verbs.hpp"
#include "graph/pipeline/registry.hpp"

namespace atrium::cli {

void print_error(const std::string& message, const std::string& help) {
  std::fprintf(stderr, "atrium: error: %s\n", message.c_str());
  if (!help.empty()) std::fprintf(stderr, "  help: %s\n", help.c_str());
}

}  // namespace atrium::cli

namespace {

int report(const char* message, const std::string& help, int code) {
  atrium::cli::print_error(message, help);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  namespace cli = atrium::cli;
  CLI::App app("Atrium: raw indoor point clouds to light planar models, as a graph of nodes.", "atrium");
  app.require_subcommand(1);
  int exit_code = cli::ok;
  cli::add_check(app, exit_code);
  cli::add_nodes(app, exit_code);
  cli::add_run(app, exit_code);
  cli::add_sweep(app, exit_code);
  cli::add_diff(app, exit_code);
  cli::add_graph(app, exit_code);
  cli::add_report(app, exit_code);
  cli::add_schema(app, exit_code);
  cli::add_cache(app, exit_code);
  cli::add_why(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return report(error.what(), "atrium --help", cli::usage);
  } catch (const atrium::PluginError& error) {
    return report(error.what(), error.help(), cli::plugin);
  } catch (const atrium::Error& error) {
    return report(error.what(), error.help(), cli::failed);
  } catch (const std::exception& error) {
    return report(error.what(), {}, cli::failed);
  }
  if (std::fflush(stdout) != 0) return report("cannot write to stdout", {}, cli::failed);
  return exit_code;
}
