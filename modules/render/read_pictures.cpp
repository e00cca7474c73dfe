#include "modules/render/read_pictures.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "graph/api/text.hpp"
#include "modules/render/png.hpp"

namespace atrium::render {

ReadPictures::Out ReadPictures::run(const Params& params, Context& context) {
  if (params.files.empty()) throw Error("no picture is named", "set `files` to a list of PNG files");
  if (params.captions.size() > params.files.size())
    throw Error(
        fmt::format("{} for {}", counted(params.captions.size(), "caption"), counted(params.files.size(), "file")));
  Out out;
  const Picture* shape = nullptr;
  out.pictures.pictures.reserve(params.files.size());
  for (std::size_t i = 0; i < params.files.size(); ++i) {
    const std::filesystem::path file = params.files[i];
    const bool there = std::filesystem::is_regular_file(file);
    Picture picture = there ? read_png(file) : Picture{};
    picture.caption = i < params.captions.size() ? params.captions[i] : file.filename().string();
    if (!there) {
      picture.caption += " (no picture)";
      context.info(fmt::format("there is no picture {}", file.string()));
    }
    out.pictures.pictures.push_back(std::move(picture));
    if (there && shape == nullptr) shape = &out.pictures.pictures.back();
  }
  if (shape == nullptr) throw Error(fmt::format("none of the {} pictures is there", params.files.size()));
  for (auto& picture : out.pictures.pictures) {
    if (picture.width > 0) continue;
    picture.width = shape->width;
    picture.height = shape->height;
    picture.pixels.assign(shape->pixels.size(), 235);
  }
  return out;
}

}  // namespace atrium::render
