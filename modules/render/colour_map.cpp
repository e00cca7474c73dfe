#include "modules/render/colour_map.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "graph/api/error.hpp"
#include "graph/api/plugin_data.hpp"

namespace atrium::render {
namespace {

namespace fs = std::filesystem;

/// The folder of the maps: beside the folders in which this library lies, as built or as installed.
fs::path map_folder() {
  Dl_info library{};
  if (::dladdr(reinterpret_cast<const void*>(&load_colour_map), &library) == 0 || library.dli_fname == nullptr)
    throw Error("the library of render.* does not know where it lies");
  if (fs::path folder = data_folder(library.dli_fname, "colormaps"); !folder.empty()) return folder;
  throw Error(fmt::format("the colour maps (share/colormaps) are not beside {}", library.dli_fname),
              "install Atrium again, as a whole");
}

std::string names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".txt") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return fmt::format("colour maps are {}", fmt::join(names, ", "));
}

}  // namespace

Colour ColourMap::at(double share) const {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), colours.size() - 1);
  const auto above = std::min(below + 1, colours.size() - 1);
  const double part = place - static_cast<double>(below);
  Colour colour{};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = static_cast<std::uint8_t>(std::lround((1 - part) * colours[below][k] + part * colours[above][k]));
  return colour;
}

ColourMap load_colour_map(const std::string& name) {
  const fs::path folder = map_folder();
  const fs::path path = folder / (name + ".txt");
  std::ifstream file(path);
  if (name.find('/') != std::string::npos || !file)
    throw Error(fmt::format("there is no colour map '{}'", name), names_in(folder));
  ColourMap map;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    int red = -1;
    int green = -1;
    int blue = -1;
    std::string rest;
    const bool three = static_cast<bool>(words >> red >> green >> blue) && !(words >> rest);
    if (!three || std::min({red, green, blue}) < 0 || std::max({red, green, blue}) > 255)
      throw Error(fmt::format("{}:{}: not a colour: {}", path.string(), number, line),
                  "three whole numbers from 0 to 255");
    map.colours.push_back(
        {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green), static_cast<std::uint8_t>(blue)});
  }
  if (file.bad()) throw Error("cannot read " + path.string());
  if (map.colours.size() < 2) throw Error(path.string() + " holds fewer than two colours");
  return map;
}

}  // namespace atrium::render
