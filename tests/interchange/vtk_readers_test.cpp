// What io.write_mesh and io.write_cloud write, read by VTK's own readers (those of ParaView).
#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkDataArray.h>
#include <vtkGLTFReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <set>

#include "modules/io/write_cloud.hpp"
#include "modules/io/write_mesh.hpp"
#include "modules/types/palette.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::io::vtk_readers_test {
namespace {

using Eigen::Vector3d;

class FolderHost : public ContextHost {
 public:
  explicit FolderHost(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::filesystem::path output_folder() override { return folder_; }

 private:
  std::filesystem::path folder_;
};

struct Surface {
  double area = 0;
  Vector3d vector_area = Vector3d::Zero();
  int triangles = 0;
};

void add(vtkPolyData* data, Surface& surface) {
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    vtkCell* cell = data->GetCell(i);
    ASSERT_EQ(cell->GetNumberOfPoints(), 3);
    Vector3d p[3];
    for (int k = 0; k < 3; ++k) data->GetPoint(cell->GetPointId(k), p[k].data());
    const Vector3d area = (p[1] - p[0]).cross(p[2] - p[0]) / 2;
    surface.area += area.norm();
    surface.vector_area += area;
    ++surface.triangles;
  }
}

class ReadByVtk : public ::testing::Test {
 protected:
  /// Floor, wall and object: 12, 7.5 and 0.5 square metres; colours at the vertices.
  static Mesh mesh() {
    Mesh mesh;
    mesh.vertices = {{0, 0, 0},   {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {0, 3, 2.5},
                     {0, 0, 2.5}, {1, 1, 1}, {2, 1, 1}, {1, 2, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {6, 7, 8}};
    using enum SurfaceClass;
    mesh.classes = {floor, floor, wall, wall, object};
    mesh.storeys = {0, 0, 0, 0, -1};
    mesh.primitives = {3, 3, 8, 8, -1};
    for (int i = 0; i < 9; ++i) mesh.colours.push_back({static_cast<std::uint8_t>(20 * i), 7, 200});
    return mesh;
  }
  std::string write(const std::string& name, bool binary) {
    Context context(1, std::make_shared<FolderHost>(folder.path()));
    WriteMesh::run({input(mesh()), {}}, {{name}, binary}, context);
    return folder / name;
  }
  template <class Reader>
  vtkSmartPointer<vtkPolyData> read(const std::string& path) {
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    EXPECT_EQ(reader->GetErrorCode(), 0U);
    return reader->GetOutput();
  }
  static void expect_mesh(vtkPolyData* data) {
    Surface surface;
    add(data, surface);
    EXPECT_EQ(surface.triangles, 5);
    EXPECT_NEAR(surface.area, 20, 1e-5);
    EXPECT_LT((surface.vector_area - Vector3d(7.5, 0, 12.5)).norm(), 1e-5);
  }
  test::TemporaryFolder folder;
};

TEST_F(ReadByVtk, PlyMeshes) {
  for (const bool binary : {true, false}) {
    const auto data = read<vtkPLYReader>(write("m.ply", binary));
    ASSERT_EQ(data->GetNumberOfPoints(), 9);
    expect_mesh(data);
    auto* points = data->GetPointData()->GetArray("RGB");
    ASSERT_NE(points, nullptr);
    EXPECT_EQ(points->GetComponent(3, 0), 60);
    auto* faces = data->GetCellData()->GetArray("RGB");
    ASSERT_NE(faces, nullptr);
    EXPECT_EQ(faces->GetComponent(0, 0), class_colour(SurfaceClass::floor)[0]);
    EXPECT_EQ(faces->GetComponent(2, 2), class_colour(SurfaceClass::wall)[2]);
  }
}

TEST_F(ReadByVtk, ObjMeshesWithGroups) {
  const auto data = read<vtkOBJReader>(write("m.obj", true));
  expect_mesh(data);
  auto* groups = data->GetCellData()->GetArray("GroupIds");
  ASSERT_NE(groups, nullptr);
  std::set<double> different;
  for (vtkIdType i = 0; i < 5; ++i) different.insert(groups->GetComponent(i, 0));
  EXPECT_EQ(different.size(), 3U);
}

TEST_F(ReadByVtk, StlMeshes) {
  for (const bool binary : {true, false}) expect_mesh(read<vtkSTLReader>(write("m.stl", binary)));
}

TEST_F(ReadByVtk, GlbModels) {
  vtkNew<vtkGLTFReader> reader;
  reader->SetFileName(write("m.glb", true).c_str());
  reader->Update();
  vtkMultiBlockDataSet* output = reader->GetOutput();
  ASSERT_NE(output, nullptr);
  Surface surface;
  vtkSmartPointer<vtkCompositeDataIterator> blocks;
  blocks.TakeReference(output->NewIterator());
  int primitives = 0;
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem(), ++primitives)
    add(vtkPolyData::SafeDownCast(blocks->GetCurrentDataObject()), surface);
  EXPECT_EQ(primitives, 3);
  EXPECT_EQ(surface.triangles, 5);
  EXPECT_NEAR(surface.area, 20, 1e-5);
  EXPECT_LT((surface.vector_area - Vector3d(7.5, 12.5, 0)).norm(), 1e-5);  // y is up
}

TEST_F(ReadByVtk, PlyCloudsWithSensors) {
  Cloud cloud;
  for (int i = 0; i < 50; ++i) {
    cloud.points.emplace_back(0.1F * i, 1, 2);
    cloud.colours.push_back({static_cast<std::uint8_t>(i), 2, 3});
    cloud.source.push_back(static_cast<std::uint16_t>(i % 3));
  }
  cloud.sensors = {{0, 0, 1}, {2, 0, 1}, {4, 0, 1}};
  Context context(1, std::make_shared<FolderHost>(folder.path()));
  for (const bool binary : {true, false}) {
    WriteCloud::run({input(cloud)}, {{"c.ply"}, binary}, context);
    const auto data = read<vtkPLYReader>(folder / "c.ply");
    ASSERT_EQ(data->GetNumberOfPoints(), 50);
    Vector3d p;
    data->GetPoint(49, p.data());
    EXPECT_LT((p - Vector3d(4.9, 1, 2)).norm(), 1e-5);
    auto* colours = data->GetPointData()->GetArray("RGB");
    ASSERT_NE(colours, nullptr);
    EXPECT_EQ(colours->GetComponent(49, 0), 49);
  }
}

}  // namespace
}  // namespace atrium::io::vtk_readers_test
