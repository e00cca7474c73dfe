#pragma once
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "graph/api/text.hpp"
#include "graph/cache/cache.hpp"
#include "graph/pipeline/pipeline.hpp"

namespace atrium::cli {

/// What the program returns.
enum Exit : int { ok = 0, failed = 1, usage = 2, invalid = 3, some_failed = 4, plugin = 5 };

/// Each verb stands in its own file and adds its subcommand here: options, help, and a callback that does the work and
/// leaves the exit code. stdout carries results only. Error and PluginError may be thrown: main prints them.
void add_check(CLI::App& app, int& exit_code);
void add_nodes(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);
void add_sweep(CLI::App& app, int& exit_code);
void add_sweep_submit(CLI::App& sweep, int& exit_code);
void add_sweep_gather(CLI::App& sweep, int& exit_code);
void add_sweep_work(CLI::App& sweep, int& exit_code);
void add_diff(CLI::App& app, int& exit_code);
void add_graph(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_view(CLI::App& app, int& exit_code);
void add_schema(CLI::App& app, int& exit_code);
void add_cache(CLI::App& app, int& exit_code);
void add_why(CLI::App& app, int& exit_code);

/// The pipeline's or sweep's file, and the option -s.
void add_pipeline(CLI::App& verb, std::string& file, std::vector<std::string>& settings);
void add_sweep_file(CLI::App& verb, std::string& file, std::vector<std::string>& settings);
std::vector<Override> to_overrides(const std::vector<std::string>& texts);
/// The options --cache, --no-cache and --cache-size.
struct CacheChoice {
  std::string folder, size = "20 GB";
  bool off = false;
};
void add_cache_options(CLI::App& verb, CacheChoice& choice);
/// An option that takes a size ("20 GB"); what is none ends the program as any wrong use does.
CLI::Option* add_size(CLI::App& verb, const std::string& name, std::string& size, const std::string& text);
/// What `run` and `sweep run` take alike.
struct RunChoice {
  int threads = 0;
  bool quiet = false, json = false, no_hashes = false;
  CacheChoice cache;
};
void add_run_options(CLI::App& verb, RunChoice& choice);
CLI::Option* add_threads(CLI::App& verb, int& threads, const std::string& text);
CLI::Option* add_timeout(CLI::App& verb, double& timeout, const std::string& text);
/// Null if there is to be none, or if it cannot be used: that is said on stderr. A folder that --cache names and that
/// holds something else is an error of use (CLI::ParseError).
std::unique_ptr<Cache> open_cache(const RunChoice& choice);
/// As they were chosen. The cache must outlive them.
template <class Options>
Options run_options(const RunChoice& choice, Cache* cache, const std::filesystem::path& out) {
  Options options;
  options.out = out;
  options.threads = choice.threads;
  options.hashes = !choice.no_hashes;
  options.cache = cache;
  options.keep_outputs = false;
  return options;
}

/// What the processes of a sweep are told of its cache (null: none) and of hashes.
std::vector<std::string> worker_arguments(const RunChoice& choice, const Cache* cache);
/// Libraries that bring OpenMP use as many threads as the run (without -j: one, or what OMP_NUM_THREADS says); they
/// read this when their plugin is loaded.
void limit_openmp(int threads);
/// The path of this program.
std::string own_program();

/// Whether there was a standard output when the program began. Where there was none (a daemon), what a command prints
/// for a person beside its other results is left out; what is asked for as JSON cannot be written.
bool has_stdout();

/// Prints on stderr. That it cannot be printed (closed, full) is no reason to end otherwise than by what was done.
template <class... Arguments>
void say(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  const std::string whole = fmt::format(text, std::forward<Arguments>(arguments)...);
  std::fwrite(whole.data(), 1, whole.size(), stderr);
}

/// "atrium: error: …" on stderr, and below it what would help.
void print_error(const std::string& message, const std::string& help);
/// Warnings and errors, on stderr.
void print_findings(const LoadResult& result);

}  // namespace atrium::cli
