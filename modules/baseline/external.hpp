#pragma once
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/mesh.hpp"
#include "modules/types/plane_primitives.hpp"

namespace atrium::baseline {

/// Any program as a node, by its command line: what another group has published joins a comparison.
///
/// `command` is the program and its arguments, one item each, without a shell. In each argument {cloud}, {mesh} and
/// {planes} stand for a file that holds that input in the format of the parameter of that name, {output} for the file
/// that the program is to write, {folder} for the folder that holds them: the program's working folder, which is
/// removed afterwards. {{ and }} stand for plain braces. Coordinates are relative to the inputs' origin (near zero, so
/// that programs of single precision keep their millimetres), and the mesh that comes back has that origin again.
///
/// The program and all that it started, daemons too, are ended when it ends, when the time limit has passed (SIGTERM,
/// two seconds later SIGKILL) or the run is cancelled; the memory limit is the address space that each of its processes
/// can get. What it prints is kept in `log`, also if it fails: the first and the last 8 MiB.
///
/// Errors: no command; a placeholder that does not exist, or without its input; no {output}; inputs with different
/// origins; a program that is missing, ends with another exit code than 0 or by a signal, or runs out of time (all with
/// the end of its log); no output written, or none that can be read.
struct External {
  static constexpr std::string_view type = "baseline.external";
  static constexpr std::string_view summary = "Runs any program by its command line and takes the mesh that it writes.";
  static constexpr bool cached = false;  // the program may change
  static constexpr bool runs_programs = true;
  struct In {
    OptionalInput<Cloud> cloud;
    OptionalInput<Mesh> mesh;
    OptionalInput<PlanePrimitives> planes;
  };
  struct Out {
    Mesh mesh;
  };
  enum class CloudFormat { ply, xyz, pcd };
  enum class MeshFormat { ply, obj, stl };
  enum class PlanesFormat { vg, bvg };
  struct Params {
    std::vector<std::string> command;
    CloudFormat cloud = CloudFormat::ply;
    MeshFormat mesh = MeshFormat::ply;
    PlanesFormat planes = PlanesFormat::vg;
    MeshFormat output = MeshFormat::ply;
    bool binary = true;
    double time_limit = 600;
    double memory_limit = 8192;
    OutputPath log{"external.log"};
  };
  static constexpr auto inputs =
      std::tuple{port<&In::cloud>("Written where the command has {cloud}."),
                 port<&In::mesh>("Written where the command has {mesh}."),
                 port<&In::planes>("Written, with their cloud, where the command has {planes}.")};
  static constexpr auto outputs = std::tuple{port<&Out::mesh>("What the program wrote to {output}.")};
  static constexpr auto params = std::tuple{
      param<&Params::command>("Program and arguments: [polyfit, \"{planes}\", \"{output}\"]."),
      param<&Params::cloud>({{"ply", CloudFormat::ply}, {"xyz", CloudFormat::xyz}, {"pcd", CloudFormat::pcd}},
                            "Format of {cloud}."),
      param<&Params::mesh>({{"ply", MeshFormat::ply}, {"obj", MeshFormat::obj}, {"stl", MeshFormat::stl}},
                           "Format of {mesh}."),
      param<&Params::planes>({{"vg", PlanesFormat::vg}, {"bvg", PlanesFormat::bvg}}, "Format of {planes}."),
      param<&Params::output>({{"ply", MeshFormat::ply}, {"obj", MeshFormat::obj}, {"stl", MeshFormat::stl}},
                             "Format of {output}."),
      param<&Params::binary>("Whether files are binary where their format has both kinds."),
      param<&Params::time_limit>(seconds, within(0, 1e6), "Wall time; 0: any."),
      param<&Params::memory_limit>(unitless, within(0, 1e9), "Address space of each of its processes, MiB; 0: any."),
      param<&Params::log>("Takes what the program prints; in the run's folder."),
  };
  static Out run(const In& in, const Params& params, Context& context);
};

}  // namespace atrium::baseline
