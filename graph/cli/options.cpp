// Options that several verbs take, and what they mean.
#include <fmt/format.h>

#include "graph/cache/cache_folder.hpp"
#include "graph/cache/upkeep.hpp"
#include "graph/cli/verbs.hpp"

namespace atrium::cli {
namespace {

namespace fs = std::filesystem;

void add_settings(CLI::App& verb, std::vector<std::string>& settings) {
  verb.add_option("-s,--set", settings,
                  "NODE.PARAMETER=VALUE, NODE.type=TYPE, NODE.pipeline=FILE or VARIABLE=VALUE; may be repeated")
      ->type_name("ADDRESS=VALUE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

}  // namespace

void add_pipeline(CLI::App& verb, std::string& file, std::vector<std::string>& settings) {
  verb.add_option("FILE", file,
                  "the pipeline file, the name of an installed one, or a picture that a run has made (PNG)")
      ->required()
      ->type_name("");
  add_settings(verb, settings);
}

void add_sweep_file(CLI::App& verb, std::string& file, std::vector<std::string>& settings) {
  verb.add_option("FILE", file, "the sweep file, or the name of an installed one")->required()->type_name("");
  add_settings(verb, settings);
}

std::vector<Override> to_overrides(const std::vector<std::string>& texts) {
  std::vector<Override> overrides;
  overrides.reserve(texts.size());
  for (const auto& text : texts) overrides.push_back({text, "-s " + text});
  return overrides;
}

CLI::Option* add_threads(CLI::App& verb, int& threads, const std::string& text) {
  return verb.add_option("-j,--threads", threads, text)->check(CLI::Range(1, 1024));
}

CLI::Option* add_timeout(CLI::App& verb, double& timeout, const std::string& text) {
  return verb.add_option("--timeout", timeout, text)->check(CLI::Range(0.0, 1e9));
}

void add_run_options(CLI::App& verb, RunChoice& choice) {
  add_threads(verb, choice.threads, "threads; 1: one node after the other (default: one per core)");
  verb.add_flag("-q,--quiet", choice.quiet, "no progress and no warnings on stderr, errors only");
  verb.add_flag("--json", choice.json, "results as JSON on stdout");
  verb.add_flag("--no-hashes", choice.no_hashes, "leave the content hashes of outputs out of manifest.json");
  add_cache_options(verb, choice.cache);
}

void add_cache_options(CLI::App& verb, CacheChoice& choice) {
  verb.add_option("--cache", choice.folder,
                  "the folder of what earlier runs computed (default: ATRIUM_CACHE, or atrium in the user's cache; "
                  "ATRIUM_CACHE=off: none)")
      ->type_name("DIR");
  verb.add_flag("--no-cache", choice.off, "compute everything, keep nothing");
  add_size(verb, "--cache-size", choice.size, "what is not used for longest is removed above this size")
      ->capture_default_str();
}

CLI::Option* add_size(CLI::App& verb, const std::string& name, std::string& size, const std::string& text) {
  const auto problem = [](const std::string& given) -> std::string {
    try {
      read_size(given);
      return {};
    } catch (const Error& error) {
      return std::string(error.what()) + " (" + error.help() + ")";
    }
  };
  return verb.add_option(name, size, text)->type_name("SIZE")->check(CLI::Validator(problem, ""));
}

std::unique_ptr<Cache> open_cache(const RunChoice& run) {
  const CacheChoice& choice = run.cache;
  const fs::path folder = choice.folder.empty() ? default_cache_folder() : fs::path(choice.folder);
  if (choice.off || folder.empty()) return nullptr;
  CacheOptions options;
  options.folder = folder;
  options.most_bytes = read_size(choice.size);
  options.in_background = run.threads != 1;
  try {
    return std::make_unique<Cache>(options);
  } catch (const NoCacheFolder& error) {
    const std::string problem = fmt::format("{} ({})", error.what(), error.help());
    if (!choice.folder.empty()) throw CLI::ValidationError("--cache", problem);
    say("warning: without a cache: {}\n", problem);
  } catch (const Error& error) {
    say("warning: without a cache: {}\n", error.what());
  }
  return nullptr;
}

std::vector<std::string> worker_arguments(const RunChoice& choice, const Cache* cache) {
  std::vector<std::string> arguments;
  if (cache != nullptr) arguments = {"--cache", cache->places().folder.string(), "--cache-size", choice.cache.size};
  if (choice.no_hashes) arguments.emplace_back("--no-hashes");
  return arguments;
}

void limit_openmp(int threads) {
  ::setenv("OMP_NUM_THREADS", std::to_string(std::max(threads, 1)).c_str(),
           threads > 0 ? 1 : 0);  // NOLINT(concurrency-mt-unsafe)
}

std::string own_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) throw Error("cannot find this program: " + error.message());
  return program.string();
}

}  // namespace atrium::cli
