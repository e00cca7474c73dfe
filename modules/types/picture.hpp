#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace atrium {

/// One image: 8-bit red, green, blue, rows from the top, without padding.
struct Picture {
  static constexpr auto members() {
    return std::tuple{&Picture::width, &Picture::height, &Picture::caption, &Picture::pixels};
  }
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::string caption;
  std::vector<std::uint8_t> pixels;  ///< 3 · width · height
};

/// Pictures of one thing, for instance from several sides.
struct Pictures {
  static constexpr std::string_view port_type = "Pictures";
  static constexpr auto members() { return std::tuple{&Pictures::pictures}; }
  std::vector<Picture> pictures;
};

}  // namespace atrium
