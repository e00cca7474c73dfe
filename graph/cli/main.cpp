#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "graph/api/standard_streams.hpp"
#include "graph/api/suggest.hpp"
#include "graph/cli/command_table.hpp"
#include "graph/cli/verbs.hpp"
#include "graph/pipeline/registry.hpp"
#include "graph/run/runner.hpp"

namespace atrium::cli {
namespace {

bool stdout_was_open = true;

}  // namespace

bool has_stdout() { return stdout_was_open; }

void print_error(const std::string& message, const std::string& help) {
  std::fprintf(stderr, "atrium: error: %s\n", message.c_str());
  if (!help.empty()) std::fprintf(stderr, "  help: %s\n", help.c_str());
}

}  // namespace atrium::cli

namespace {

constexpr const char* help_for_memory =
    "give it fewer points or variants (a coarser voxel grid, a crop), fewer threads (-j 1), or more memory";

// What no handler has caught, as in a destructor. Without memory nothing better can be done; anything else is a fault
// of the program, which a core file may explain.
[[noreturn]] void on_terminate() noexcept {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "atrium: error: out of memory\n  help: %s\n", help_for_memory);
    std::_Exit(atrium::cli::failed);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "atrium: error: %s (this is a fault of the program)\n", error.what());
  } catch (...) {
    std::fprintf(stderr, "atrium: error: something that is no std::exception (this is a fault of the program)\n");
  }
  if (!std::current_exception()) {  // as libstdc++ ends where memory is refused within a function that must not throw
    std::fprintf(stderr, "atrium: error: a library gave up, as it does when memory ends\n  help: %s\n",
                 help_for_memory);
    std::_Exit(atrium::cli::failed);
  }
  std::abort();
}

// What the system gives to a process, as the program needs it. Before any file is opened.
void secure_process() {
  atrium::cli::stdout_was_open = atrium::secure_standard_streams();
  std::set_terminate(on_terminate);
  std::signal(SIGCHLD, SIG_DFL);  // if it is ignored, a child's end is not told
  std::signal(SIGXFSZ, SIG_IGN);  // a file that gets too large (ulimit -f) is an error of writing then
}

// What was not understood, and whose help says what would be.
int report_usage(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  const CLI::App* verb = &app;
  std::string name = "atrium";
  while (!verb->get_subcommands().empty()) {
    verb = verb->get_subcommands().front();
    name += " " + verb->get_name();
  }
  const auto verbs = verb->get_subcommands([](const CLI::App* v) { return !v->get_group().empty(); });
  const auto word = std::find_if(words.begin(), words.end(), [](const auto& w) { return !w.starts_with("-"); });
  if (verb == &app && word != words.end()) {
    const auto names = atrium::words_of(verbs, [](const CLI::App* v) { return v->get_name(); });
    const std::string meant = atrium::did_you_mean(*word, names);
    atrium::cli::print_error("unknown command '" + *word + "'", meant.empty() ? "atrium --help" : meant);
  } else {
    atrium::cli::print_error(error.what(), name + " --help");
  }
  return atrium::cli::usage;
}

int report(const std::string& message, const std::string& help, int code) {
  atrium::cli::print_error(message, help);
  return code;
}

// Says of an empty word, as a shell variable without a value gives it, where it stands. False if there is none.
bool report_empty(const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool assigned = word.starts_with("--") && word.size() > 2 && word.find('=') == word.size() - 1;
    if (!word.empty() && !assigned) continue;
    std::string what = "argument " + std::to_string(i + 1) + " is empty";
    if (assigned)
      what = "the value of " + word.substr(0, word.size() - 1) + " is empty";
    else if (i > 0 && words[i - 1].starts_with('-'))
      what = "the value of " + words[i - 1] + " is empty";
    atrium::cli::print_error(what, "a variable of the shell without a value? Give one, or leave it out");
    return true;
  }
  return false;
}

// The text of an error of the library in plain words.
std::string text_of(const std::filesystem::filesystem_error& error) {
  std::error_code gone;
  static_cast<void>(std::filesystem::current_path(gone));
  if (gone) return "the working folder is not there any more (" + gone.message() + ")";
  return error.path1().string() + ": " + error.code().message();
}

// The exit code, or that of a failure if what was printed has not reached stdout.
int flushed(int code) {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return code;
  return report("cannot write to stdout: " + std::string(std::strerror(errno)), {}, atrium::cli::failed);
}

}  // namespace

int main(int argc, char** argv) {
  namespace cli = atrium::cli;
  secure_process();
  CLI::App app("Atrium: raw indoor point clouds to light planar models, as a graph of nodes.", "atrium");
  app.require_subcommand(1);
  app.footer(
      "Environment:\n"
      "  ATRIUM_PLUGIN_PATH  folders of more plugins (files libatrium_NAME.so), separated by ':'\n"
      "  ATRIUM_CACHE        folder of the cache, or 'off'");
  app.set_version_flag("--version", "atrium " ATRIUM_VERSION);
  int exit_code = cli::ok;
  cli::add_check(app, exit_code);
  cli::add_nodes(app, exit_code);
  cli::add_run(app, exit_code);
  cli::add_sweep(app, exit_code);
  cli::add_diff(app, exit_code);
  cli::add_graph(app, exit_code);
  cli::add_report(app, exit_code);
  cli::add_view(app, exit_code);
  cli::add_schema(app, exit_code);
  cli::add_cache(app, exit_code);
  cli::add_why(app, exit_code);
  cli::add_generate(app);
  if (report_empty({argv + 1, argv + argc})) return cli::usage;
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {  // --help
    return flushed(app.exit(success));
  } catch (const CLI::ParseError& error) {
    return report_usage(app, error, {argv + 1, argv + argc});
  } catch (const atrium::PluginError& error) {
    return report(error.what(), error.help(), cli::plugin);
  } catch (const atrium::FolderError& error) {
    return report(error.what(), error.help(), cli::usage);
  } catch (const atrium::Error& error) {
    return report(error.what(), error.help(), cli::failed);
  } catch (const std::filesystem::filesystem_error& error) {
    return report(text_of(error), "go to a folder that is there, or give absolute paths", cli::failed);
  } catch (const std::bad_alloc&) {
    return report("out of memory", help_for_memory, cli::failed);
  } catch (const std::exception& error) {
    return report(error.what(), {}, cli::failed);
  }
  return flushed(exit_code);
}
