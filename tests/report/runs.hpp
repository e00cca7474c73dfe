#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace atrium::test {

/// The folder of a run whose one node, of the type a.b, wrote these files; the texts are their contents.
inline void make_run(const std::filesystem::path& folder, const std::map<std::string, std::string>& files,
                     const std::string& status = "ok") {
  std::filesystem::create_directories(folder);
  nlohmann::json artefacts = nlohmann::json::array();
  for (const auto& [name, text] : files) {
    std::filesystem::create_directories((folder / name).parent_path());
    write_text(folder / name, text);
    artefacts.push_back({{"path", name}, {"bytes", text.size()}});
  }
  nlohmann::json node{{"node", "n"}, {"type", "a.b"}, {"version", 1}, {"status", status}, {"artefacts", artefacts}};
  if (status == "failed") node["message"] = "no disk </script>";
  if (status == "ok")
    node.update({{"wall_seconds", 1}, {"cpu_seconds", 1}, {"peak_memory", 1}, {"outputs", nlohmann::json::array()}});
  write_text(folder / "manifest.json",
             nlohmann::json{{"status", status}, {"nodes", {node}}, {"outputs", nlohmann::json::object()}}.dump());
  write_text(folder / "resolved.yaml", "atrium: 1\nnodes:\n  n:\n    type: a.b\n    params:\n      unit: ft\n");
}

/// A GLB file of points: places and colours, each of three 16-bit numbers in rows of 8 bytes; in two tiles.
inline std::string glb_of_points(std::size_t first, std::size_t second, const std::string& more = {}) {
  std::string bytes;
  const auto number = [](std::string& to, std::size_t value, int size) {
    for (int i = 0; i < size; ++i) to += static_cast<char>((value >> (8 * i)) & 255U);
  };
  std::uint32_t state = 1;
  for (const std::size_t what : {0, 1})  // a colour says which place is its own
    for (std::size_t i = 0; i < first + second; ++i) {
      for (int k = 0; k < 2; ++k)
        number(bytes, what == 0 ? (state = state * 1664525U + 1013904223U) >> 16U : i >> (8 * k), 2);
      number(bytes, i, 2);
      number(bytes, 0, 2);
    }
  const auto accessor = [&](int view, std::size_t from, std::size_t count) {
    return nlohmann::json{
        {"bufferView", view}, {"byteOffset", 8 * from}, {"componentType", 5123}, {"type", "VEC3"}, {"count", count}};
  };
  const std::size_t half = 8 * (first + second);
  nlohmann::json description{
      {"asset", {{"version", "2.0"}}},
      {"nodes", {{{"mesh", 0}}, {{"mesh", 1}}}},
      {"meshes",
       {{{"primitives", {{{"mode", 0}, {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}}}}},
        {{"primitives", {{{"mode", 0}, {"attributes", {{"POSITION", 2}, {"COLOR_0", 3}}}}}}}}},
      {"accessors",
       {accessor(0, 0, first), accessor(1, 0, first), accessor(0, first, second), accessor(1, first, second)}},
      {"bufferViews",
       {{{"buffer", 0}, {"byteLength", half}, {"byteStride", 8}},
        {{"buffer", 0}, {"byteOffset", half}, {"byteLength", half}, {"byteStride", 8}}}},
      {"buffers", {{{"byteLength", 2 * half}}}}};
  if (!more.empty()) description["meshes"][0]["primitives"][0].merge_patch(nlohmann::json::parse(more));
  std::string text = description.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string glb;
  for (const std::size_t n :
       {std::size_t{0x46546c67}, std::size_t{2}, 28 + text.size() + bytes.size(), text.size(), std::size_t{0x4e4f534a}})
    number(glb, n, 4);
  glb += text;
  number(glb, bytes.size(), 4);
  number(glb, 0x004e4942, 4);
  return glb + bytes;
}

}  // namespace atrium::test
