#include "modules/baseline/external.hpp"

#include <fmt/format.h>
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): mkdtemp is POSIX's

#include <array>
#include <cerrno>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>

#include "modules/baseline/child_process.hpp"
#include "modules/io/read_mesh.hpp"
#include "modules/io/write_cloud.hpp"
#include "modules/io/write_mesh.hpp"
#include "modules/io/write_vg.hpp"

namespace atrium::baseline {
namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "atrium-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw Error(fmt::format("cannot make a folder like '{}': {}", name, std::generic_category().message(errno)));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Lets the writers write into the temporary folder.
class FolderHost : public ContextHost {
 public:
  FolderHost(fs::path folder, const Context& outer) : folder_(std::move(folder)), outer_(outer) {}
  void log(Level level, std::string_view text) override {
    level == Level::warning ? outer_.warn(text) : outer_.info(text);
  }
  bool cancelled() override { return outer_.cancelled(); }
  fs::path output_folder() override { return folder_; }

 private:
  fs::path folder_;
  const Context& outer_;
};

const char* name_of(External::MeshFormat format) {
  return std::array{"ply", "obj", "stl"}[static_cast<std::size_t>(format)];
}
const char* name_of(External::CloudFormat format) {
  return std::array{"ply", "xyz", "pcd"}[static_cast<std::size_t>(format)];
}
const char* name_of(External::PlanesFormat format) { return std::array{"vg", "bvg"}[static_cast<std::size_t>(format)]; }

// An argument in pieces: plain text, and names that stood in braces. Doubled braces are plain ones.
struct Piece {
  std::string text;
  bool placeholder = false;
};
std::vector<Piece> pieces(const std::string& argument) {
  static const std::regex pattern("\\{\\{|\\}\\}|\\{([a-z_]+)\\}");
  std::vector<Piece> result;
  auto from = argument.cbegin();
  for (std::sregex_iterator i(argument.begin(), argument.end(), pattern), end; i != end; ++i) {
    const auto& match = *i;
    result.push_back({std::string(from, match[0].first)});
    result.push_back({match[1].matched ? match[1].str() : match[0].str().substr(1), match[1].matched});
    from = match[0].second;
  }
  result.push_back({std::string(from, argument.cend())});
  return result;
}

// The names in braces that the arguments have.
std::map<std::string, bool> placeholders(const std::vector<std::string>& arguments) {
  std::map<std::string, bool> found;
  for (const auto& argument : arguments)
    for (const auto& piece : pieces(argument))
      if (piece.placeholder) found[piece.text] = true;
  return found;
}

void check_command(const External::In& in, const std::vector<std::string>& command) {
  if (command.empty() || command.front().empty())
    throw Error("there is no command", "set 'command' to a list: the program, then its arguments");
  const std::map<std::string, bool> wired{{"cloud", static_cast<bool>(in.cloud)},
                                          {"mesh", static_cast<bool>(in.mesh)},
                                          {"planes", static_cast<bool>(in.planes)},
                                          {"output", true},
                                          {"folder", true}};
  const auto found = placeholders(command);
  for (const auto& [name, used] : found) {
    const auto known = wired.find(name);
    if (known == wired.end())
      throw Error(fmt::format("the command has {{{}}}, which stands for nothing", name),
                  "there are {cloud}, {mesh}, {planes}, {output} and {folder}; {{ and }} stand for braces");
    if (!known->second) throw Error(fmt::format("the command has {{{}}}, but that input is not wired", name));
  }
  if (found.count("output") == 0)
    throw Error("the command has no {output}", "the program must be told where to write its mesh");
}

// The origin that all inputs have in common.
Eigen::Vector3d common_origin(const External::In& in) {
  std::optional<Eigen::Vector3d> origin;
  const auto meet = [&](const Eigen::Vector3d& other) {
    if (origin && *origin != other)
      throw Error("the inputs have different origins", "they must come from one scan, in one frame");
    origin = other;
  };
  if (in.cloud) meet(in.cloud->origin);
  if (in.mesh) meet(in.mesh->origin);
  if (in.planes) meet(in.planes->cloud->origin);
  return origin.value_or(Eigen::Vector3d::Zero());
}

template <class T>
std::shared_ptr<const T> at_zero(const std::shared_ptr<const T>& value) {
  if (value->origin.isZero(0)) return value;
  auto copy = std::make_shared<T>(*value);
  copy->origin.setZero();
  return copy;
}

// Writes the inputs that the command names; the file of each placeholder.
std::map<std::string, std::string> write_inputs(const External::In& in, const External::Params& params,
                                                const fs::path& folder, Context& inner) {
  std::map<std::string, std::string> files;
  const auto used = placeholders(params.command);
  const auto file = [&](const std::string& name, const char* format) {
    const std::string relative = name + "." + format;
    files[name] = (folder / relative).string();
    return OutputPath{relative};
  };
  if (used.count("cloud") != 0)
    io::WriteCloud::run({at_zero<Cloud>(in.cloud)}, {file("cloud", name_of(params.cloud)), params.binary}, inner);
  if (used.count("mesh") != 0)
    io::WriteMesh::run({at_zero<Mesh>(in.mesh), {}}, {file("mesh", name_of(params.mesh)), params.binary}, inner);
  if (used.count("planes") != 0) {
    auto planes = std::make_shared<PlanePrimitives>(*in.planes);
    planes->cloud = at_zero<Cloud>(planes->cloud);
    io::WriteVg::run({planes}, {file("planes", name_of(params.planes))}, inner);
  }
  file("output", name_of(params.output));
  files["folder"] = folder.string();
  return files;
}

std::string filled(const std::string& argument, const std::map<std::string, std::string>& files) {
  std::string result;
  for (const auto& piece : pieces(argument)) result += piece.placeholder ? files.at(piece.text) : piece.text;
  return result;
}

void keep_log(const ChildLog& log, const std::string& to, const Context& context) {
  const fs::path place = context.output(to);
  std::error_code ignored;
  if (fs::exists(place, ignored) && !fs::is_regular_file(place, ignored))
    throw Error(fmt::format("the log '{}' is no file", place.string()), "set 'log' to another place");
  AtomicFile target(place);
  target.write(log.text());
  target.commit();
  context.wrote(place);
}

Mesh read_output(const std::string& file, const std::string& program, Context& inner) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    throw Error(fmt::format("{} ended well but wrote no output", program),
                "it must write a mesh to the file that {output} stands for, in the format of 'output'");
  try {
    return io::ReadMesh::run({{file}, 1}, inner).mesh;
  } catch (const Error& error) {
    throw Error(fmt::format("the output of {} cannot be read: {}", program, error.what()), error.help());
  }
}

}  // namespace

External::Out External::run(const In& in, const Params& params, Context& context) {
  check_command(in, params.command);
  const Eigen::Vector3d origin = common_origin(in);
  const TemporaryFolder folder;
  Context inner(1, std::make_shared<FolderHost>(folder.path(), context));
  const auto files = write_inputs(in, params, folder.path(), inner);

  ChildProcess child{params.command, folder.path(), params.time_limit, params.memory_limit};
  for (auto& argument : child.arguments) argument = filled(argument, files);
  ChildLog log;
  ChildResult result;
  try {
    result = run_child(child, log, context);
  } catch (...) {
    keep_log(log, params.log.path, context);
    throw;
  }
  keep_log(log, params.log.path, context);
  context.info(
      fmt::format("{} took {:.2f} s and {:.0f} MiB", params.command.front(), result.seconds, result.mebibytes));

  Out out;
  out.mesh = read_output(files.at("output"), params.command.front(), inner);
  out.mesh.origin += origin;
  return out;
}

}  // namespace atrium::baseline
