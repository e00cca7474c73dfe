// Writes tests/fuzz/corpus anew, with Atrium's own writers: fuzz_seeds tests/fuzz/corpus
#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "graph/cache/blob.hpp"
#include "graph/cache/record.hpp"
#include "modules/io/write_building.hpp"
#include "modules/io/write_cloud.hpp"
#include "modules/io/write_mesh.hpp"
#include "modules/io/write_truth.hpp"
#include "modules/io/write_vg.hpp"
#include "modules/types/adjacency.hpp"
#include "modules/types/cell_complex.hpp"
#include "modules/types/floor_plan.hpp"
#include "modules/types/metrics.hpp"
#include "modules/types/simulated_scene.hpp"
#include "modules/types/textures.hpp"
#include "tests/support/box_building.hpp"
#include "tests/support/e57_builder.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium {
namespace {

namespace fs = std::filesystem;
fs::path corpus;

/// A host that writes into the corpus.
class Host : public ContextHost {
 public:
  explicit Host(fs::path folder) : folder_(std::move(folder)) {}
  void log(Level /*level*/, std::string_view /*text*/) override {}
  fs::path output_folder() override { return folder_; }

 private:
  fs::path folder_;
};

Context writing_to(const std::string& target) {
  fs::create_directories(corpus / target);
  return {1, std::make_shared<Host>(corpus / target)};
}

void write(const std::string& target, const std::string& name, const std::string& text) {
  fs::create_directories(corpus / target);
  test::write_text(corpus / target / name, text);
}

Cloud some_cloud() {
  Cloud cloud;
  for (int i = 0; i < 6; ++i) {
    cloud.points.emplace_back(0.5F * static_cast<float>(i), static_cast<float>(i % 2), 1.0F);
    cloud.normals.emplace_back(0, 0, 1);
    cloud.colours.push_back({static_cast<std::uint8_t>(20 * i), 100, 3});
    cloud.intensities.push_back(0.5F);
    cloud.labels.push_back(i);
  }
  cloud.sensors = {{0.5F, 1, 2}};
  return cloud;
}

Mesh some_mesh() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
  mesh.classes = {SurfaceClass::floor, SurfaceClass::wall, SurfaceClass::wall};
  mesh.primitives = {0, 1, 2};
  return mesh;
}

GroundTruth some_truth() {
  GroundTruth truth;
  truth.rooms = {{"hall", 0, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}}};
  TrueFace floor;
  floor.surface = SurfaceClass::floor;
  floor.room = 0;
  floor.plane.normal = {0, 0, 1};
  floor.outline = truth.rooms[0].outline;
  floor.holes = {{{0.5, 0.5, 0}, {0.5, 1, 0}, {1, 1, 0}, {1, 0.5, 0}}};
  truth.faces = {floor};
  truth.openings = {{"slab", 0, -1, 0, -1, 0.2, {{0.5, 0.5, 0}, {1, 0.5, 0}, {1, 1, 0}, {0.5, 1, 0}}}};
  return truth;
}

/// An E57 file without the checksums of its pages.
std::string without_checksums(const std::string& file) {
  std::string content;
  for (std::size_t page = 0; page < file.size(); page += 1024) content += file.substr(page, 1020);
  return content.substr(0, content.find_last_not_of('\0') + 1);
}

/// What scanners write.
void write_scans() {
  const test::TemporaryFolder folder;
  Context aside(1, std::make_shared<Host>(folder.path()));
  Cloud cloud = some_cloud();
  io::WriteCloud::run({input(cloud)}, {{"one.e57"}, true}, aside);
  cloud.sensors.emplace_back(0, 1, 2);
  for (std::uint16_t i = 0; i < 6; ++i) cloud.source.push_back(i / 3);
  io::WriteCloud::run({input(cloud)}, {{"two.e57"}, true}, aside);
  for (const std::string name : {"one.e57", "two.e57"})
    write("e57", name, without_checksums(test::read_text(folder / name)));
  const test::E57TestScan spherical{
      {test::f64("sphericalRange", {1, 2, 3, 4}), test::f32("sphericalAzimuth", {0, 1, 2, 3}),
       test::integers("sphericalElevation", -9, 9, {0, 1, 2, 9}, "scale=\"0.1\""),
       test::integers("sphericalInvalidState", 0, 2, {0, 0, 0, 1})},
      "<colorLimits/>"};
  write("e57", "spherical.e57", without_checksums(test::E57Builder().add(spherical).file()));
  for (const std::string name : {"cloud.las", "cloud.laz"}) {
    cloud.crs = name == "cloud.las" ? "PROJCS[\"p\",UNIT[\"metre\",1]]" : "EPSG:25832";
    io::WriteCloud::run({input(cloud)}, {{name}, true}, aside);
    write("las", name, test::read_text(folder / name));
  }
  write("ptx", "two.ptx",
        "2\n2\n1 2 3\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n1 2 3 1\n1 0 0 0.5 1 2 3\n0 0 0 0.5 0 0 0\n"
        "0 1 0 0.5 9 9 9\n1 1 0 0.5 7 7 7\n1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n5 5 5 1\n"
        "2 2 2 1 1 1 1\n");
}

/// glTF with nodes, colours, normals, strips and sparse coordinates; as JSON, a zero and the binary part.
void write_gltf() {
  test::GltfBuilder builder;
  builder.add(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
  builder.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
  builder.add(std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 255}, "VEC4", 4,
              R"(,"normalized":true)");
  builder.add(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
  builder.add(std::vector<float>{3, 0, 0}, "VEC3", 3);
  builder.add_accessor(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,"indices":)"
                       R"({"bufferView":1,"byteOffset":2,"componentType":5123},"values":{"bufferView":4}}})");
  builder.primitives = {R"({"attributes":{"POSITION":0,"COLOR_0":2,"NORMAL":3},"indices":1,"material":0})",
                        R"({"attributes":{"POSITION":5},"mode":5})"};
  builder.nodes = R"([{"children":[1,2],"matrix":[2,0,0,0,0,2,0,0,0,0,2,0,9,0,0,1]},)"
                  R"({"mesh":0,"rotation":[1,0,0,0],"translation":[0,0,3]},{"mesh":0,"scale":[1,1,-1]}])";
  builder.more = R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.2,1,1,1]}}])";
  write("glb", "nodes", builder.json() + std::string(1, '\0') + builder.binary);
  write("glb", "whole.glb", builder.glb());
  builder.nodes = R"([{"mesh":0}])";
  builder.primitives = {R"({"attributes":{"POSITION":0},"mode":0})"};
  write("glb", "points.gltf", builder.gltf());
}

/// The same formats as other programs spell them.
void write_spellings() {
  write("ply", "strips.ply",
        "PLY\r\nformat ascii 1.0\nelement vertex 5\rproperty float x\nproperty float y\nproperty float z\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        "0 0 0 1 0 0 0 1 0 1 1 0 2 0 1\n8 0 1 2 3 -1 4 1 0\n");
  write(
      "pcd", "lines.pcd",
      "\xEF\xBB\xBF# .PCD v0.7\rfields x y z rgb\rsize 4 4 4 4\rtype f f f f\rwidth 3\rheight 2\rpoints 6\r"
      "viewpoint 0 0 0 1 0 0 0\rdata ASCII\r0\r0\r0\r255\r1 0 0 16711680\r1 1 1 -1\r2 2 2 4.2e-39\r0 1 0 9 1 2 0 9\r");
  write("obj", "lines.obj", "v 0 0 0 # one\nv 1 \\\n0 0\nV 0 1 0\nvn 0 0 1\nf 1// \\\r\n2/3/1 -1\nsurf 0 1\n");
  write("stl", "capitals.stl",
        " SOLID a\nFACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0\rVERTEX 0 1 0 END LOOP\nEND FACET\nEND "
        "SOLID\n");
}

void write_files() {
  const auto cloud = input(some_cloud());
  const auto mesh = input(some_mesh());
  for (const std::string format : {"ply", "pcd"}) {
    Context context = writing_to(format);
    io::WriteCloud::run({cloud}, {{"cloud_binary." + format}, true}, context);
    io::WriteCloud::run({cloud}, {{"cloud_text." + format}, false}, context);
  }
  write_gltf();
  for (const std::string format : {"ply", "obj", "stl", "glb"}) {
    Context context = writing_to(format);
    io::WriteMesh::run({mesh}, {{"mesh." + format}, true}, context);
    if (format != "obj" && format != "glb") io::WriteMesh::run({mesh}, {{"mesh_text." + format}, false}, context);
  }
  write_scans();
  write_spellings();
  const test::TemporaryFolder folder;
  Context aside(1, std::make_shared<Host>(folder.path()));
  char choice = 0;  // of tests/fuzz/readers.cpp
  for (const std::string name : {"cloud.xyz", "cloud.txt", "cloud.csv"}) {
    io::WriteCloud::run({cloud}, {{name}, false}, aside);
    write("text", name, std::string(1, choice) + test::read_text(folder / name));
    choice = static_cast<char>(choice == 0 ? 1 : 3);
  }
  write("text", "cloud.pts",
        "\2"
        "3\n0 0 0 12 255 0 7\n1 0 0 -3 1 2 3\n0 1 0.5 0 9 9 9\n");
  write("text", "several.pts",
        "\2"
        "2\n0 0 0 12\n1 0 0 -3\n1\n0 1 0.5 0\n");
  PlanePrimitive plane;
  plane.plane.normal = {0, 0, 1};
  plane.plane.offset = -1;
  plane.inliers = {0, 1, 2, 3, 4, 5};
  const auto planes = input(PlanePrimitives{std::make_shared<const Cloud>(some_cloud()), {plane}});
  for (const std::string format : {"vg", "bvg"}) {
    Context context = writing_to(format);
    io::WriteVg::run({planes}, {{"planes." + format}}, context);
  }
}

void write_json() {
  Context buildings = writing_to("building");
  test::BoxBuilding box;
  box.room(0, 0, 4, 3);
  io::WriteBuilding::run({input(box.building), {}, {}}, {{"one_room.json"}}, buildings);
  io::WriteBuilding::run({input(test::BoxBuilding::two_rooms()), {}, {}}, {{"two_rooms.json"}}, buildings);
  Context layouts = writing_to("layout");
  io::WriteTruth::run({input(some_truth())}, {{"truth.json"}}, layouts);
  write("layout", "rooms.json",
        R"({"rooms": [{"corners": [[0,0],[3,0],[3,2],[0,2]], "name": "hall", "storey": 0, "floor": 0.0, "height": 2.5},
 {"corners": [[3,0,0],[5,0,0],[5,2,0],[3,2,0]]}]})");
  write("layout", "corners.json", "[[[0,0],[3,0],[3,2],[0,2]]]");
  write("layout", "planes.json",
        R"({"planes": [{"label": "FLOOR", "corners": [[0,0,0],[2,0,0],[2,2,0],[0,2,0]], "normal_out": [0,0,-1]},
 {"label": "WALL_FACE", "corners": [[0,0,0],[2,0,0],[2,0,2],[0,0,2]], "normal_out": [0,-1,0]},
 {"label": "WALL_FACE", "corners": [[2,0,0],[2,2,0],[2,2,2],[2,0,2]], "normal_out": [1,0,0]},
 {"label": "WALL_FACE", "corners": [[2,2,0],[0,2,0],[0,2,2],[2,2,2]], "normal_out": [0,1,0]},
 {"label": "WALL_FACE", "corners": [[0,2,0],[0,0,0],[0,0,2],[0,2,2]], "normal_out": [-1,0,0]},
 {"label": "DOOR_FRAME", "corners": [[0.5,0,0],[1,0,0],[1,0,1.9],[0.5,0,1.9]], "normal_out": [0,-1,0]}]})");
}

void write_texts() {
  write("pipeline", "all.yaml", R"(atrium: 1
summary: Planes of a cloud.
seed: 7
vars: {unit: 3 cm}
nodes:
  cloud: {type: test.make}
  planes: {type: test.find, in: {cloud: cloud.cloud}, params: {distance: "${unit}", method: hough, box: [1, 2, 30 cm]}}
  sub: {pipeline: sub.yaml, in: {cloud: planes.rest}, vars: {unit: 4 cm}}
  joined: {type: test.join, in: {clouds: [cloud.cloud, planes.rest]}, params: {names: [a, b], weights: [1]}}
  write: {type: test.write, in: {planes: sub.planes}, params: {path: p.vg}}
outputs: {planes: planes.planes, all: joined.cloud}
)");
  write("sweep", "all.yaml", R"(atrium: 1
sweep: base.yaml
summary: Many.
set: {planes.refit: false}
scenes: {near: {unit: 1 cm}, far: {unit: 1 m}}
seeds: [1, 2]
grid: {planes.angle: [10, 20 deg]}
list: {hough: {planes.method: hough}, growing: {planes.type: test.grow}}
exclude: [{scene: near, planes.angle: 10}]
)");
  write("sweep", "random.yaml", R"(atrium: 1
sweep: base.yaml
zip: {planes.angle: [1, 2], planes.share: [0.1, 0.2]}
ablate: {all: {planes.refit: false}}
random: {samples: 3, seed: 7, of: {planes.distance: {uniform: [1 cm, 4 cm]}}}
)");
  CacheRecord record;
  record.fields = {{"type", "test.find"}, {"version", "1"}, {"distance", "0.5 m"}};
  record.key = NodeKey{record.fields}.hex();
  record.node = "shell/planes";
  record.made = "2024-02-03T04:05:06Z";
  record.outputs = {
      {"planes", "Planes", 12, std::string(32, 'a'), {{"planes", std::int64_t{3}, ""}, {"area", 2.5, "m2"}}}};
  record.warnings = {"few points"};
  record.files = {{"planes.vg", 5, std::string(32, 'b')}};
  record.growth = 1000;
  const std::string text = record_text(record);
  write("record", "record.json", text.substr(text.find('\n') + 1));
}

template <class T>
void write_blob_of(int choice, const char* name, const T& value) {
  constexpr std::size_t head = 64, digest = 32;
  const test::TemporaryFolder folder;
  write_blob(folder / "blob", *flat_type<T>(), &value, content_hash(value));
  const std::string bytes = test::read_text(folder / "blob");
  write("blob", name, static_cast<char>(choice) + bytes.substr(head, bytes.size() - head - digest));
}

void write_blobs() {
  int choice = 0;  // in the order of tests/fuzz/graph.cpp
  Adjacency adjacency(3);
  adjacency.connect(0, 1, 0.5);
  write_blob_of(choice++, "adjacency", adjacency);
  write_blob_of(choice++, "building", test::BoxBuilding::two_rooms());
  write_blob_of(choice++, "cell_complex", CellComplex{});
  write_blob_of(choice++, "cloud", some_cloud());
  write_blob_of(choice++, "floor_plan", FloorPlan{});
  write_blob_of(choice++, "ground_truth", some_truth());
  write_blob_of(choice++, "metrics", Metrics{});
  write_blob_of(choice++, "simulated_scene", SimulatedScene{});
  write_blob_of(choice++, "textures", Textures{});
}

}  // namespace
}  // namespace atrium

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  atrium::corpus = argv[1];
  atrium::write_files();
  atrium::write_json();
  atrium::write_texts();
  atrium::write_blobs();
}
