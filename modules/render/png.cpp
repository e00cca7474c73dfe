#include "modules/render/png.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <cstring>

#include "graph/api/context.hpp"
#include "graph/api/error.hpp"

namespace atrium::render {

void write_png(const Picture& picture, const std::filesystem::path& path) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.width, picture.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  for (int y = 0; y < picture.height; ++y)
    std::memcpy(image->GetScalarPointer(0, picture.height - 1 - y, 0), picture.pixels.data() + row * y, row);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  auto* bytes = writer->GetResult();
  if (bytes == nullptr || bytes->GetNumberOfValues() == 0) throw Error("cannot encode the picture " + path.string());
  AtomicFile file(path);
  file.write(bytes->GetVoidPointer(0), static_cast<std::size_t>(bytes->GetNumberOfValues()));
  file.commit();
}

Picture read_png(const std::filesystem::path& path) {
  vtkNew<vtkPNGReader> reader;
  if (reader->CanReadFile(path.c_str()) == 0) throw Error("not a PNG file: " + path.string());
  reader->SetFileName(path.c_str());
  reader->Update();
  auto* image = reader->GetOutput();
  if (image->GetNumberOfScalarComponents() != 3) throw Error(path.string() + " is not an RGB picture of 8 bits");
  Picture picture;
  const int* size = image->GetDimensions();
  picture.width = size[0];
  picture.height = size[1];
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  picture.pixels.resize(row * static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y)
    std::memcpy(picture.pixels.data() + row * y, image->GetScalarPointer(0, picture.height - 1 - y, 0), row);
  return picture;
}

}  // namespace atrium::render
